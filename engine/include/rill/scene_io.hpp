#pragma once
// Reading a scene file into a Scene (of the library rill::scene). See assets/scenes/scene.schema.json for the format.
//
//   const rill::Override finer[] = {{"fluid.spacing", "0.02"}};
//   auto scene = rill::loadScene("dam-break.json", finer);
//   if (!scene) return fail(scene.error().message);
//   auto particles = rill::makeParticles(*scene);
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rill/environment.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

/// `key` is a path as in the file ("fluid.viscosity", "solver.time_step", "fill[0].jitter"), `value` is JSON, or a bare word taken as a
/// string. A relative path of a file in it is relative to the current directory.
struct Override {
  std::string key = {}, value = {};
};

/// "key=value". BadInput where there is no '=' or no key.
RILL_API Expected<Override> parseOverride(std::string_view text);

/// Reads, applies the overrides and checks everything. BadInput with one message naming file, line or key path, what was found and what was
/// expected.
RILL_API Expected<Scene> loadScene(const std::filesystem::path& file, std::span<const Override> overrides = {});
/// The same from text; `name` stands for the file in messages, relative paths in the text are resolved against `folder`.
RILL_API Expected<Scene> parseScene(std::string_view text, std::string_view name, const std::filesystem::path& folder,
                                    std::span<const Override> overrides = {});

/// Reads a Radiance picture (.hdr), or a PNG or JPEG, which is taken as sRGB. BadInput with one message naming the file, what was found and
/// what was expected; OutOfMemory, Io.
RILL_API Expected<EnvironmentPicture> loadEnvironment(const std::filesystem::path& file);

/// The scene file's JSON Schema (draft-07), made from the same table of fields as the parser.
RILL_API std::string sceneSchema();
/// Keys, units, ranges and defaults in Markdown, a table for each kind of object: the generated part of docs/scene-format.md.
RILL_API std::string sceneKeyTables();

}  // namespace rill
