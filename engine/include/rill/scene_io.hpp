#pragma once
// Reads scene files (library rill::scene). The format is described by assets/scenes/scene.schema.json.
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

/// Sets one value of a scene file. `key` is a path ("fluid.viscosity", "fill[0].jitter", or by an entry's name "fluids.oil.density"),
/// `value` is JSON or a bare word, which is read as a string. File names in `value` are relative to the current directory.
struct Override {
  std::string key = {}, value = {};
};

/// Parses "key=value". BadInput without '=' or key.
RILL_API Expected<Override> parseOverride(std::string_view text);

/// Loads a scene file, applies the overrides and validates the result. BadInput with one message that names the file, the line or key path,
/// what was found and what was expected; OutOfMemory, Io.
RILL_API Expected<Scene> loadScene(const std::filesystem::path& file, std::span<const Override> overrides = {});
/// Parses a scene from text. `name` is the file name in messages; relative paths in the text are resolved against `folder`.
RILL_API Expected<Scene> parseScene(std::string_view text, std::string_view name, const std::filesystem::path& folder,
                                    std::span<const Override> overrides = {});

/// Loads an environment map: Radiance (.hdr), or PNG or JPEG in sRGB. BadInput with one message that names the file, what was found and
/// what was expected; OutOfMemory, Io.
RILL_API Expected<EnvironmentPicture> loadEnvironment(const std::filesystem::path& file);

/// The JSON Schema (draft-07) of scene files, generated from the parser's field table.
RILL_API std::string sceneSchema();
/// Markdown tables of all keys with units, ranges, defaults and help, one for each kind of object: the generated part of
/// docs/scene-format.md.
RILL_API std::string sceneKeyTables();

}  // namespace rill
