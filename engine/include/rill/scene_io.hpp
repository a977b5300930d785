#pragma once
// Reading a scene file into a Scene, and a Scene into particles. See assets/scenes/scene.schema.json for the format.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rill/expected.hpp"
#include "rill/scene.hpp"

namespace rill {

/// `key` is a path as in the file ("fluid.viscosity", "solver.time_step", "fill[0].jitter"), `value` is JSON, or a bare word taken as a
/// string. A relative path of a file in it is relative to the current directory.
struct Override {
  std::string key, value;
};

/// "key=value". BadInput where there is no '=' or no key.
Expected<Override> parseOverride(std::string_view text);

/// Reads, applies the overrides and checks everything. BadInput with one message naming file, line or key path, what was found and what was
/// expected.
Expected<Scene> loadScene(const std::filesystem::path& file, std::span<const Override> overrides = {});
/// The same from text; `name` stands for the file in messages, relative paths in the text are resolved against `folder`.
Expected<Scene> parseScene(std::string_view text, std::string_view name, const std::filesystem::path& folder,
                           std::span<const Override> overrides = {});

/// The scene's fills as particles (see ParticleSet), PLY files read. The spacing follows from `fluid.particles` where that is given
/// (`scene.fluid.spacing` is set then). BadInput where a file cannot be read, or a fill was given and no particle is left.
/// Counts are computed in 64 bits and checked against `maxParticles` before anything is allocated.
Expected<ParticleSet> makeParticles(Scene& scene, uint64_t maxParticles);

/// The scene file's JSON Schema (draft-07), made from the same table of fields as the parser.
std::string sceneSchema();
/// The table of keys, units, ranges and defaults in Markdown, for README.
std::string sceneKeyTable();

}  // namespace rill
