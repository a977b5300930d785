#include "fill/fill_messages.hpp"

#include <algorithm>
#include <cmath>

#include "core/words.hpp"
#include "fill/flow_warnings.hpp"
#include "fill/host_memory.hpp"

namespace rill {
namespace {

constexpr size_t kMaxWarnings = 20;

}  // namespace

std::string scenePrefix(const Scene& scene) {
  const std::string name = scene.file.empty() ? scene.name : scene.file.string();
  return name.empty() ? "" : name + ": ";
}

Error fillError(const Scene& scene, const std::string& why) { return {ErrorKind::BadInput, scenePrefix(scene) + why}; }

std::string countText(double count) { return count < 1e15 ? grouped(static_cast<uint64_t>(count)) : "about " + roundedNumber(count); }

Error fillFileError(const Scene& scene, size_t fill, const Error& error) {
  return {error.kind, scenePrefix(scene) + elementPath("fill", fill) + ".particles.file: " + error.message};
}

Error fillMemoryError(const Scene& scene, std::span<const FillSource> sources) {
  double count = 0, bytes = 0;
  for (const FillSource& s : sources) {
    count += s.count;
    bytes += s.count * (2 * sizeof(Float3) + (s.file ? sizeof(Double3) : 0));
  }
  const auto mebibytes = [](double b) { return roundedNumber(b / (1 << 20)) + " MiB"; };
  const uint64_t available = availableHostBytes();
  return {ErrorKind::OutOfMemory, scenePrefix(scene) + "not enough memory for the " + countText(count) +
                                      " particles of the scene's fills: they need at least " + mebibytes(bytes) +
                                      (available > 0 ? ", at most " + mebibytes(static_cast<double>(available)) + " are available" : "")};
}

void addFillWarnings(const Scene& scene, std::span<const FillSource> sources, std::vector<std::string>& warnings) {
  uint64_t suppressed = 0;
  const auto warn = [&](size_t fill, const std::string& text) {
    if (warnings.size() >= kMaxWarnings) {
      ++suppressed;
    } else {
      warnings.push_back(scenePrefix(scene) + "fill[" + std::to_string(fill) + "]: " + text);
    }
  };
  for (size_t i = 0; i < sources.size(); ++i) {
    const FillSource& s = sources[i];
    const std::string of = " of " + countText(s.count) + " particles ";
    if (s.count < 1) {
      warn(i, s.file ? "yields no particles: the file has none"
                     : "yields no particles: it is too thin for a spacing of " + roundedNumber(scene.fluid.spacing) + " m");
      continue;
    }
    if (const auto* mesh = std::get_if<MeshShape>(&scene.fill[i].shape))
      for (const std::string& text : mesh->mesh->warnings()) warn(i, text);
    if (s.domain > 0) warn(i, grouped(s.domain) + of + "start outside the domain's walls and are left out");
    if (s.solid > 0) warn(i, grouped(s.solid) + of + "start inside a solid and are left out");
    if (s.overlap > 0)
      warn(i, grouped(s.overlap) + of + (s.file ? "coincide, or are" : "are") +
                  " closer than 0.9 spacings to earlier fills, and are left out");
    if (s.kept == 0) warn(i, "yields no particles: all are left out");
  }
  if (suppressed > 0) warnings.push_back("and " + grouped(suppressed) + " more warnings about fills");
}

void addPrecisionWarning(const Scene& scene, const ParticleSet& set, const FillBounds& all, std::vector<std::string>& warnings) {
  constexpr double kFloatStep = 0x1p-24, kDoubleStep = 0x1p-53, kTooCoarse = 1e-3;
  if (all.empty()) return;
  double far = 0, step = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = std::max(std::abs(all.low[axis] - set.origin[axis]), std::abs(all.high[axis] - set.origin[axis]));
    const double place = std::max(std::abs(all.low[axis]), std::abs(all.high[axis]));
    far = std::max(far, reach);
    step = std::max({step, reach * kFloatStep, place * kDoubleStep});
  }
  if (step <= kTooCoarse * scene.fluid.spacing) return;
  warnings.push_back(scenePrefix(scene) + "fluid starts " + roundedNumber(far) +
                     " m from the domain's minimum (or the fluid's center), where positions are rounded to multiples of " +
                     roundedNumber(step) + " m, more than a thousandth of the spacing " + roundedNumber(scene.fluid.spacing) + " m");
}

void addFlowWarnings(const Scene& scene, ParticleSet& set) {
  Scene spaced = scene;  // by a number of particles it has no spacing
  spaced.fluid.spacing = set.spacing;
  const std::vector<std::string> all = flowWarnings(spaced, set.positions.size());
  const size_t shown = std::min(all.size(), kMaxWarnings);
  for (size_t i = 0; i < shown; ++i) set.warnings.push_back(scenePrefix(scene) + all[i]);
  if (shown < all.size()) set.warnings.push_back("and " + grouped(all.size() - shown) + " more warnings about emitters and drains");
}

}  // namespace rill
