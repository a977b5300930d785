// makeParticles(): turns the fills of a scene into particles.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <optional>

#include "core/shares.hpp"
#include "core/words.hpp"
#include "fill/fill_messages.hpp"
#include "fill/fill_source.hpp"
#include "fill/lattice.hpp"
#include "fill/mouth.hpp"
#include "fill/placer.hpp"
#include "rill/scene_io.hpp"

namespace rill {
namespace {

/// Places every source at the scene's spacing.
Expected<ParticleSet> placeAll(const Scene& scene, std::vector<FillSource>& sources, uint64_t maxParticles) {
  constexpr double kExactRows = 4e6;  // with more rows there are more points than 32 bits count
  const double spacing = scene.fluid.spacing;
  double total = 0;
  for (size_t i = 0; i < sources.size(); ++i) {
    FillSource& s = sources[i];
    s.overlap = s.solid = s.domain = s.kept = 0;
    if (!s.file) {
      s.lattice = latticeOf(scene.fill[i], spacing);
      if (const double rows = s.lattice.size[1] * s.lattice.size[2]; s.lattice.mesh && rows > kExactRows)
        return fillError(scene, elementPath("fill", i) + ".mesh: its bounds have " + countText(rows) +
                                    " rows of particles at a spacing of " + roundedNumber(spacing) + " m; expected at most " +
                                    countText(kExactRows));
      s.count = countPoints(s.lattice, kExactRows);
    }
    total += s.count;
  }
  if (total > static_cast<double>(maxParticles)) {
    return fillError(scene, "fluid.spacing: " + shortestNumber(spacing) + " m makes " + countText(total) + " particles; expected at most " +
                                grouped(maxParticles) + ", which a spacing of about " +
                                roundedNumber(spacing * std::cbrt(total / static_cast<double>(maxParticles)) * 1.01) + " m gives");
  }
  FillBounds all;
  std::vector<FillBounds> bounds;
  for (size_t i = 0; i < sources.size(); ++i) {
    FillSource& s = sources[i];
    if (s.file && s.particles.positions.empty()) {
      auto read = s.file->read();
      if (!read) return fillFileError(scene, i, read.error());
      s.particles = std::move(*read);
    }
    const FillBounds& own = bounds.emplace_back(boundsOf(s));
    if (own.empty()) continue;
    all.add(own.low[0], own.low[1], own.low[2]);
    all.add(own.high[0], own.high[1], own.high[2]);
  }

  if (all.empty()) {
    for (const Emitter& emitter : scene.emitters) {
      const Double3 p = centerOf(mouthAt(emitter, 0));
      all.add(p.x, p.y, p.z);
    }
  }

  ParticleSet set;
  for (int axis = 0; axis < 3; ++axis) {
    if (scene.domain) {
      set.origin[axis] = scene.domain->min[axis];
    } else if (!all.empty()) {
      set.origin[axis] = std::round(0.5 * (all.low[axis] + all.high[axis]) / spacing) * spacing;
    }
  }
  const auto expected = static_cast<uint64_t>(total);
  set.positions.reserve(expected);
  set.velocities.reserve(expected);
  if (!scene.fluids.empty()) set.fluids.reserve(expected);
  std::optional<PointHash> placed;
  if (mayOverlap(sources, bounds, kFillOverlap * spacing)) placed.emplace(kFillOverlap * spacing, expected);
  const bool mixes = std::ranges::any_of(sources, [](const FillSource& s) { return !s.particles.concentrations.empty(); });
  if (mixes) set.concentrations.reserve(expected);
  ParticlePlacer placer(scene, set, placed ? &*placed : nullptr, mixes);
  for (size_t i = 0; i < sources.size(); ++i) {
    placeFill(scene, i, sources[i], placer);
    set.leftOutOverlap += sources[i].overlap;
    set.leftOutSolid += sources[i].solid;
    set.leftOutDomain += sources[i].domain;
  }
  addFillWarnings(scene, sources, set.warnings);
  addPrecisionWarning(scene, set, all, set.warnings);
  return set;
}

/// placeAll(), with the bytes needed and available where memory runs out.
Expected<ParticleSet> place(const Scene& scene, std::vector<FillSource>& sources, uint64_t maxParticles) {
  try {
    return placeAll(scene, sources, maxParticles);
  } catch (const std::bad_alloc&) { return fillMemoryError(scene, sources); }
}

/// Finds the spacing that makes about scene.fluid.particles particles, not counting those left out, and places them.
Expected<ParticleSet> placeByCount(const Scene& given, std::vector<FillSource>& sources, uint64_t maxParticles) {
  Scene scene = given;
  const auto wanted = static_cast<double>(scene.fluid.particles);
  double from_files = 0;
  for (const FillSource& s : sources) from_files += s.file ? s.count : 0;
  const auto bad = [&](const std::string& why) { return fillError(scene, "fluid.particles: " + why); };
  if (scene.fluid.particles > maxParticles)
    return bad("found " + grouped(scene.fluid.particles) + ", expected at most " + grouped(maxParticles));
  if (from_files >= wanted && from_files > 0) {
    return bad("files already contain " + countText(from_files) + " particles; expected a larger number, or fluid.spacing instead");
  }
  ParticleSet best;
  double best_miss = std::numeric_limits<double>::infinity(), target = wanted - from_files;
  constexpr int kAttempts = 4;     // the number left out depends on the spacing
  constexpr double kMaxTried = 3;  // largest count tried, over the count wanted
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    scene.fluid.spacing = spacingFor(scene.fill, target);
    if (scene.fluid.spacing <= 0)
      return bad("no fill is a box, a sphere or a mesh, so the spacing cannot be computed; expected fluid.spacing instead");
    auto set = place(scene, sources, std::max(maxParticles, static_cast<uint64_t>(2 * kMaxTried * wanted)));
    if (!set) return set;
    const auto kept = static_cast<double>(set->positions.size());
    const bool complete = set->leftOutOverlap + set->leftOutSolid + set->leftOutDomain == 0;
    const double miss = std::abs(kept - wanted);
    if (miss < best_miss) {
      best = std::move(*set);
      best.spacing = scene.fluid.spacing;
      best_miss = miss;
    }
    const double kept_of_lattices = kept - from_files;
    if (complete || miss <= 0.005 * wanted || kept_of_lattices <= 0) break;
    target = std::min(target * (wanted - from_files) / kept_of_lattices, kMaxTried * wanted);
  }
  if (best.positions.size() > maxParticles)
    return bad("the closest spacing makes " + grouped(best.positions.size()) + " particles; expected at most " + grouped(maxParticles));
  if (best_miss > 0.05 * wanted) {
    best.warnings.push_back(scenePrefix(scene) + "fluid.particles: " + grouped(best.positions.size()) + " particles instead of " +
                            grouped(scene.fluid.particles) + ": no spacing gives a closer count");
  }
  return best;
}

Expected<ParticleSet> make(const Scene& scene, uint64_t maxParticles) {
  if (auto possible = checkScene(scene); !possible) return possible.error();
  constexpr uint64_t kIds = std::numeric_limits<uint32_t>::max();  // ids have 32 bits, and one value marks "no particle"
  const uint64_t limit = std::min(maxParticles, kIds);
  std::vector<FillSource> sources(scene.fill.size());
  const std::vector<size_t> diffusing = diffusingFluids(scene);
  for (size_t i = 0; i < sources.size(); ++i) {
    const auto* particles = std::get_if<ParticleFile>(&scene.fill[i].shape);
    if (particles == nullptr) continue;
    const bool several = scene.fill[i].fluid.empty() && !scene.fluids.empty();
    auto file = PlyFile::open(particles->file, several ? scene.fluids.size() : 0, several ? diffusing : std::vector<size_t>{});
    if (!file) return fillFileError(scene, i, file.error());
    sources[i].count = static_cast<double>(file->count());
    sources[i].file = std::move(*file);
  }
  const bool by_count = scene.fluid.particles > 0;
  auto set = by_count ? placeByCount(scene, sources, limit) : place(scene, sources, limit);
  if (!set) return set;
  if (!by_count) set->spacing = scene.fluid.spacing;
  if (set->positions.empty() && !scene.fill.empty()) {
    return fillError(scene, "fill: no particles are left (" + grouped(set->leftOutDomain) + " outside the walls, " +
                                grouped(set->leftOutSolid) + " inside solids); expected at least one" +
                                (set->warnings.empty() ? "" : ". " + set->warnings.front().substr(scenePrefix(scene).size())));
  }
  if (const uint64_t capacity = scene.fluid.capacity, filled = set->positions.size(); capacity > 0 && filled > capacity)
    return fillError(scene, "fluid.capacity: found " + grouped(capacity) + ", but the fills make " + grouped(filled) +
                                " particles; expected at least as many");
  addFlowWarnings(scene, *set);
  return set;
}

}  // namespace

Expected<ParticleSet> makeParticles(const Scene& scene, uint64_t maxParticles) {
  try {
    return make(scene, maxParticles);
  } catch (const std::bad_alloc&) {
    Error error = fillError(scene, "not enough memory for the particles of the scene's fills");
    error.kind = ErrorKind::OutOfMemory;
    return error;
  } catch (const std::exception& trouble) {
    Error error = fillError(scene, std::string("making particles failed: ") + trouble.what());
    error.kind = ErrorKind::Failed;
    return error;
  }
}

}  // namespace rill
