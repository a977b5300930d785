// makeParticles(): turns the fills of a scene into particles.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <span>

#include "core/shares.hpp"
#include "core/words.hpp"
#include "fill/blocked_mouths.hpp"
#include "fill/host_memory.hpp"
#include "fill/inside_solids.hpp"
#include "fill/lattice.hpp"
#include "fill/mouth.hpp"
#include "fill/ply_reader.hpp"
#include "fill/point_hash.hpp"
#include "fill/walls.hpp"
#include "rill/scene_io.hpp"

namespace rill {
namespace {

constexpr double kOverlap = 0.9;      // spacings: smallest distance between particles of two fills
constexpr double kCoincident = 1e-3;  // spacings: closer particles of one file are coincident
constexpr double kSlack = kWallSlack;
constexpr size_t kMaxWarnings = 20;

/// A fill and the particles that it describes.
struct Source {
  std::optional<PlyFile> file;
  PlyParticles particles;  ///< of the file; empty until it is read
  Lattice lattice;
  double count = 0;  ///< including those left out later
  uint64_t overlap = 0, solid = 0, domain = 0, kept = 0;
};

/// Prefix of messages: the file or name of the scene.
std::string prefixOf(const Scene& scene) {
  const std::string name = scene.file.empty() ? scene.name : scene.file.string();
  return name.empty() ? "" : name + ": ";
}

Error badInput(const Scene& scene, const std::string& why) { return {ErrorKind::BadInput, prefixOf(scene) + why}; }

std::string countText(double count) { return count < 1e15 ? grouped(static_cast<uint64_t>(count)) : "about " + roundedNumber(count); }

/// A deterministic pseudorandom number in [-1, 1): the finalizer of splitmix64 (Steele et al. 2014) over its arguments.
double randomSigned(uint64_t seed, uint64_t fill, uint64_t particle, uint64_t axis) {
  uint64_t h = seed;
  for (const uint64_t part : {fill, particle, axis}) {
    h += 0x9E3779B97F4A7C15ULL + part;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
}

/// Axis-aligned bounds of particles; empty if low > high.
struct Bounds {
  Double3 low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Double3 high = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};

  bool empty() const { return low[0] > high[0]; }
  void add(double x, double y, double z) {
    const Double3 p = {x, y, z};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  bool near(const Bounds& other, double distance) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (low[axis] - other.high[axis] > distance || other.low[axis] - high[axis] > distance) return false;
    }
    return !empty() && !other.empty();
  }
};

Bounds boundsOf(const Source& source) {
  Bounds bounds;
  if (source.file) {
    for (const Double3& p : source.particles.positions) bounds.add(p.x, p.y, p.z);
  } else if (source.count > 0) {
    const Lattice& l = source.lattice;
    bounds.add(l.first[0], l.first[1], l.first[2]);
    bounds.add(l.first[0] + (l.size[0] - 1) * l.spacing, l.first[1] + (l.size[1] - 1) * l.spacing,
               l.first[2] + (l.size[2] - 1) * l.spacing);
  }
  return bounds;
}

/// Whether particles of different fills, or of one file, may be closer than allowed. Conservative.
bool mayOverlap(const std::vector<Source>& sources, const std::vector<Bounds>& bounds, double distance) {
  constexpr size_t kMaxPairTests = 64;
  if (std::any_of(sources.begin(), sources.end(), [](const Source& s) { return s.file.has_value(); })) return true;
  if (sources.size() > kMaxPairTests) return true;
  for (size_t a = 0; a < sources.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      if (bounds[a].near(bounds[b], distance)) return true;
    }
  }
  return false;
}

/// Adds particles to a set, leaving out those outside the domain, inside solids, or overlapping others.
class Placer {
 public:
  /// `mixes`: some particles start with a mixture.
  Placer(const Scene& scene, ParticleSet& out, PointHash* placed, bool mixes)
      : scene_(scene),
        out_(out),
        solids_(scene.solids, scene.fluid.spacing),
        placed_(placed),
        spacing_(scene.fluid.spacing),
        mixes_(mixes),
        diffusing_(diffusingFluids(scene)) {}

  /// `p`: position in scene coordinates, m. `number`: index within the fill. `fluid`: index among the scene's fluids.
  /// `mixed`: what of each diffusing fluid is in it; null: it has not mixed.
  void add(const Double3& p, const Float3& velocity, size_t fill, uint64_t number, uint8_t fluid, Source& source,
           const Float4* mixed = nullptr) {
    const double jitter = scene_.fill[fill].jitter * spacing_;
    Double3 at, lattice;
    for (int axis = 0; axis < 3; ++axis) {
      lattice[axis] = p[axis] - out_.origin[axis];
      at[axis] = jitter > 0 ? p[axis] + jitter * randomSigned(scene_.seed, fill, number, static_cast<uint64_t>(axis)) : p[axis];
    }
    if (beyondWall(scene_.domain, at, kSlack * spacing_)) {
      ++source.domain;
    } else if (solids_.contain(at, kSlack * spacing_)) {
      ++source.solid;
    } else if (placed_ != nullptr &&
               placed_->overlaps(lattice, static_cast<uint32_t>(fill), kOverlap * spacing_ * (1 - kSlack), kCoincident * spacing_)) {
      ++source.overlap;
    } else {
      if (placed_ != nullptr) placed_->insert(lattice, static_cast<uint32_t>(fill));
      ++source.kept;
      out_.positions.push_back(relative(at));
      out_.velocities.push_back(velocity);
      if (!scene_.fluids.empty()) out_.fluids.push_back(fluid);
      if (mixes_) out_.concentrations.push_back(mixed != nullptr ? *mixed : unmixed(std::span<const size_t>(diffusing_), fluid));
    }
  }

 private:
  /// Position relative to the origin, clamped to closed walls against rounding.
  Float3 relative(const Double3& p) const {
    float r[3];
    for (int axis = 0; axis < 3; ++axis) {
      r[axis] = static_cast<float>(p[axis] - out_.origin[axis]);
      if (!scene_.domain) continue;
      if (isClosed(*scene_.domain, 2 * axis)) r[axis] = std::max(r[axis], 0.0F);
      if (isClosed(*scene_.domain, 2 * axis + 1))
        r[axis] = std::min(r[axis], static_cast<float>(scene_.domain->max[axis] - scene_.domain->min[axis]));
    }
    return {r[0], r[1], r[2]};
  }

  const Scene& scene_;
  ParticleSet& out_;
  InsideSolids solids_;
  PointHash* placed_;
  double spacing_;
  bool mixes_;
  std::vector<size_t> diffusing_;
};

void placeFill(const Scene& scene, size_t index, Source& source, Placer& placer) {
  const Fill& fill = scene.fill[index];
  const Float3 velocity{static_cast<float>(fill.velocity[0]), static_cast<float>(fill.velocity[1]), static_cast<float>(fill.velocity[2])};
  const auto fluid = static_cast<uint8_t>(fluidIndex(scene, fill.fluid));
  if (source.file) {
    const PlyParticles& from = source.particles;
    for (size_t i = 0; i < from.positions.size(); ++i) {
      const Float3 own = from.velocities.empty() ? Float3{} : from.velocities[i];
      placer.add({from.positions[i].x, from.positions[i].y, from.positions[i].z},
                 {own.x + velocity.x, own.y + velocity.y, own.z + velocity.z}, index, i, from.fluids.empty() ? fluid : from.fluids[i],
                 source, from.concentrations.empty() ? nullptr : &from.concentrations[i]);
    }
    return;
  }
  const Lattice& lattice = source.lattice;
  const auto nx = static_cast<uint64_t>(lattice.size[0]), ny = static_cast<uint64_t>(lattice.size[1]),
             nz = static_cast<uint64_t>(lattice.size[2]);
  for (uint64_t k = 0; k < nz; ++k) {
    for (uint64_t j = 0; j < ny; ++j) {
      for (const Run& run : rowOf(lattice, j, k)) {
        for (uint64_t i = run.begin; i < run.end; ++i) {
          const Double3 p = {lattice.first[0] + static_cast<double>(i) * lattice.spacing,
                             lattice.first[1] + static_cast<double>(j) * lattice.spacing,
                             lattice.first[2] + static_cast<double>(k) * lattice.spacing};
          placer.add(p, velocity, index, (k * ny + j) * nx + i, fluid, source);
        }
      }
    }
  }
}

void addFillWarnings(const Scene& scene, const std::vector<Source>& sources, std::vector<std::string>& warnings) {
  uint64_t suppressed = 0;
  const auto warn = [&](size_t fill, const std::string& text) {
    if (warnings.size() >= kMaxWarnings) {
      ++suppressed;
    } else {
      warnings.push_back(prefixOf(scene) + "fill[" + std::to_string(fill) + "]: " + text);
    }
  };
  for (size_t i = 0; i < sources.size(); ++i) {
    const Source& s = sources[i];
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

/// Warns if 32-bit positions relative to the origin are too coarse for the spacing.
void addPrecisionWarning(const Scene& scene, const ParticleSet& set, const Bounds& all, std::vector<std::string>& warnings) {
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
  warnings.push_back(prefixOf(scene) + "fluid starts " + roundedNumber(far) +
                     " m from the domain's minimum (or the fluid's center), where positions are rounded to multiples of " +
                     roundedNumber(step) + " m, more than a thousandth of the spacing " + roundedNumber(scene.fluid.spacing) + " m");
}

/// An error about the file of a fill, with the scene and the key that name it.
Error aboutFile(const Scene& scene, size_t fill, const Error& error) {
  return {error.kind, prefixOf(scene) + elementPath("fill", fill) + ".particles.file: " + error.message};
}

/// The host has not enough memory for the particles of these sources.
Error outOfMemory(const Scene& scene, const std::vector<Source>& sources) {
  double count = 0, bytes = 0;
  for (const Source& s : sources) {
    count += s.count;
    bytes += s.count * (2 * sizeof(Float3) + (s.file ? sizeof(Double3) : 0));
  }
  const auto mebibytes = [](double b) { return roundedNumber(b / (1 << 20)) + " MiB"; };
  const uint64_t available = availableHostBytes();
  return {ErrorKind::OutOfMemory, prefixOf(scene) + "not enough memory for the " + countText(count) +
                                      " particles of the scene's fills: they need at least " + mebibytes(bytes) +
                                      (available > 0 ? ", at most " + mebibytes(static_cast<double>(available)) + " are available" : "")};
}

/// Places every source at the scene's spacing.
Expected<ParticleSet> placeAll(const Scene& scene, std::vector<Source>& sources, uint64_t maxParticles) {
  constexpr double kExactRows = 4e6;  // with more rows there are more points than 32 bits count
  const double spacing = scene.fluid.spacing;
  double total = 0;
  for (size_t i = 0; i < sources.size(); ++i) {
    Source& s = sources[i];
    s.overlap = s.solid = s.domain = s.kept = 0;
    if (!s.file) {
      s.lattice = latticeOf(scene.fill[i], spacing);
      if (const double rows = s.lattice.size[1] * s.lattice.size[2]; s.lattice.mesh && rows > kExactRows)
        return badInput(scene, elementPath("fill", i) + ".mesh: its bounds have " + countText(rows) +
                                   " rows of particles at a spacing of " + roundedNumber(spacing) + " m; expected at most " +
                                   countText(kExactRows));
      s.count = countPoints(s.lattice, kExactRows);
    }
    total += s.count;
  }
  if (total > static_cast<double>(maxParticles)) {
    return badInput(scene, "fluid.spacing: " + shortestNumber(spacing) + " m makes " + countText(total) + " particles; expected at most " +
                               grouped(maxParticles) + ", which a spacing of about " +
                               roundedNumber(spacing * std::cbrt(total / static_cast<double>(maxParticles)) * 1.01) + " m gives");
  }
  Bounds all;
  std::vector<Bounds> bounds;
  for (size_t i = 0; i < sources.size(); ++i) {
    Source& s = sources[i];
    if (s.file && s.particles.positions.empty()) {
      auto read = s.file->read();
      if (!read) return aboutFile(scene, i, read.error());
      s.particles = std::move(*read);
    }
    const Bounds& own = bounds.emplace_back(boundsOf(s));
    if (own.empty()) continue;
    all.add(own.low[0], own.low[1], own.low[2]);
    all.add(own.high[0], own.high[1], own.high[2]);
  }

  if (all.empty()) {
    for (const Emitter& emitter : scene.emitters) {
      const Double3 p = mouthPose(emitter, 0).center;
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
  if (mayOverlap(sources, bounds, kOverlap * spacing)) placed.emplace(kOverlap * spacing, expected);
  const bool mixes = std::ranges::any_of(sources, [](const Source& s) { return !s.particles.concentrations.empty(); });
  if (mixes) set.concentrations.reserve(expected);
  Placer placer(scene, set, placed ? &*placed : nullptr, mixes);
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
Expected<ParticleSet> place(const Scene& scene, std::vector<Source>& sources, uint64_t maxParticles) {
  try {
    return placeAll(scene, sources, maxParticles);
  } catch (const std::bad_alloc&) { return outOfMemory(scene, sources); }
}

/// Finds the spacing that makes about scene.fluid.particles particles, not counting those left out, and places them.
Expected<ParticleSet> placeByCount(const Scene& given, std::vector<Source>& sources, uint64_t maxParticles) {
  Scene scene = given;
  const auto wanted = static_cast<double>(scene.fluid.particles);
  double from_files = 0;
  for (const Source& s : sources) from_files += s.file ? s.count : 0;
  const auto bad = [&](const std::string& why) { return badInput(scene, "fluid.particles: " + why); };
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
    best.warnings.push_back(prefixOf(scene) + "fluid.particles: " + grouped(best.positions.size()) + " particles instead of " +
                            grouped(scene.fluid.particles) + ": no spacing gives a closer count");
  }
  return best;
}

/// Warns of blocked mouths, the first ones.
void addMouthWarnings(const Scene& scene, ParticleSet& set) {
  const std::vector<std::string> all = blockedMouths(scene, set.spacing);
  const size_t shown = std::min(all.size(), kMaxWarnings);
  for (size_t i = 0; i < shown; ++i) set.warnings.push_back(prefixOf(scene) + all[i]);
  if (shown < all.size()) set.warnings.push_back("and " + grouped(all.size() - shown) + " more warnings about emitters");
}

Expected<ParticleSet> make(const Scene& scene, uint64_t maxParticles) {
  if (auto possible = checkScene(scene); !possible) return possible.error();
  constexpr uint64_t kIds = std::numeric_limits<uint32_t>::max();  // ids have 32 bits, and one value marks "no particle"
  const uint64_t limit = std::min(maxParticles, kIds);
  std::vector<Source> sources(scene.fill.size());
  const std::vector<size_t> diffusing = diffusingFluids(scene);
  for (size_t i = 0; i < sources.size(); ++i) {
    const auto* particles = std::get_if<ParticleFile>(&scene.fill[i].shape);
    if (particles == nullptr) continue;
    const bool several = scene.fill[i].fluid.empty() && !scene.fluids.empty();
    auto file = PlyFile::open(particles->file, several ? scene.fluids.size() : 0, several ? diffusing : std::vector<size_t>{});
    if (!file) return aboutFile(scene, i, file.error());
    sources[i].count = static_cast<double>(file->count());
    sources[i].file = std::move(*file);
  }
  const bool by_count = scene.fluid.particles > 0;
  auto set = by_count ? placeByCount(scene, sources, limit) : place(scene, sources, limit);
  if (!set) return set;
  if (!by_count) set->spacing = scene.fluid.spacing;
  if (set->positions.empty() && !scene.fill.empty()) {
    return badInput(scene, "fill: no particles are left (" + grouped(set->leftOutDomain) + " outside the walls, " +
                               grouped(set->leftOutSolid) + " inside solids); expected at least one" +
                               (set->warnings.empty() ? "" : ". " + set->warnings.front().substr(prefixOf(scene).size())));
  }
  if (const uint64_t capacity = scene.fluid.capacity, filled = set->positions.size(); capacity > 0 && filled > capacity)
    return badInput(scene, "fluid.capacity: found " + grouped(capacity) + ", but the fills make " + grouped(filled) +
                               " particles; expected at least as many");
  addMouthWarnings(scene, *set);
  return set;
}

}  // namespace

Expected<ParticleSet> makeParticles(const Scene& scene, uint64_t maxParticles) {
  try {
    return make(scene, maxParticles);
  } catch (const std::bad_alloc&) {
    Error error = badInput(scene, "not enough memory for the particles of the scene's fills");
    error.kind = ErrorKind::OutOfMemory;
    return error;
  } catch (const std::exception& trouble) {
    Error error = badInput(scene, std::string("making particles failed: ") + trouble.what());
    error.kind = ErrorKind::Failed;
    return error;
  }
}

}  // namespace rill
