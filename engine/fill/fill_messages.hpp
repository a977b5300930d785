#pragma once
// Errors and warnings about the fills of a scene.
#include <span>
#include <string>
#include <vector>

#include "fill/fill_source.hpp"
#include "rill/expected.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

/// Prefix of messages: the file or name of the scene.
std::string scenePrefix(const Scene& scene);
/// BadInput.
Error fillError(const Scene& scene, const std::string& why);
/// "1,234", or "about 1.23e+20".
std::string countText(double count);
/// An error about the file of a fill, with the scene and the key that name it.
Error fillFileError(const Scene& scene, size_t fill, const Error& error);
/// The host has not enough memory for the particles of these sources.
Error fillMemoryError(const Scene& scene, std::span<const FillSource> sources);
void addFillWarnings(const Scene& scene, std::span<const FillSource> sources, std::vector<std::string>& warnings);
/// Warns if 32-bit positions relative to the origin are too coarse for the spacing.
void addPrecisionWarning(const Scene& scene, const ParticleSet& set, const FillBounds& all, std::vector<std::string>& warnings);
/// Adds flowWarnings(), the first ones.
void addFlowWarnings(const Scene& scene, ParticleSet& set);

}  // namespace rill
