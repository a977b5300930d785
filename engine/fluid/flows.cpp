#include "fluid/flows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/overloaded.hpp"
#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "fill/fill_messages.hpp"
#include "fill/mesh_mouth.hpp"
#include "fill/mouth.hpp"
#include "fluid/numbers.hpp"
#include "shape/records.hpp"

namespace rill {
namespace {

/// Where a mouth less than half a spacing off a wall, which faces away from it, is taken to be: half a spacing off, as the first layer is.
Double3 offWalls(const Scene& scene, Double3 center, const Double3& normal) {
  constexpr double kFaces = 0.999, kOn = 1e-6;
  if (!scene.domain) return center;
  const Domain& domain = *scene.domain;
  for (size_t a = 0; a < 3; ++a) {
    const bool low = normal[a] > 0;
    if (std::abs(normal[a]) < kFaces || (domain.open & ((low ? 1u : 2u) << (2 * a)))) continue;
    const double off = low ? center[a] - domain.min[a] : domain.max[a] - center[a], least = 0.5 * scene.fluid.spacing;
    if (off > -kOn * least && off < least) center[a] = low ? domain.min[a] + least : domain.max[a] - least;
  }
  return center;
}

float secondsOrNever(const std::optional<double>& time) { return time ? f(std::min(*time, double{kNever})) : kNever; }

/// Substeps move particles by cfl spacings at most, and there are max_substeps of them in 1/60 s.
double fastestFollowed(const Scene& scene) { return scene.solver.cfl * scene.fluid.spacing * scene.solver.max_substeps * 60; }

Error badEmitter(const Scene& scene, const std::string& key, const std::string& what) {
  return {ErrorKind::BadInput, scenePrefix(scene) + key + ": " + what};
}

Expected<void> checkEmitter(const Scene& scene, const Emitter& emitter, const std::string& key, FluidSetup& setup) {
  constexpr double kMaxPoints = 1 << 20, kMaxSpeed = 1e9;
  const double spacing = scene.fluid.spacing, area = areaOf(emitter.mouth), points = area / (spacing * spacing);
  const auto bad = [&](const std::string& what) { return badEmitter(scene, key, what); };
  if (!(points + static_cast<double>(setup.mouthPoints.size()) <= kMaxPoints))
    return bad("its mouth takes " + roundedNumber(points) + " particles of fluid.spacing a layer; expected at most, of all emitters, " +
               grouped(static_cast<uint64_t>(kMaxPoints)));
  if (const auto* mesh = std::get_if<MeshMouth>(&emitter.mouth)) {
    constexpr double kMaxRows = 1 << 18;
    const double rows = rowsOf(flatMouth(*mesh), std::min(spacing, std::sqrt(area)));
    if (!(rows <= kMaxRows))
      return bad("the triangles of its mesh lie in " + roundedNumber(rows) + " rows of a lattice of fluid.spacing, rows that several are " +
                 "in counted for each; expected at most " + grouped(static_cast<uint64_t>(kMaxRows)));
    for (const std::string& warning : mesh->mesh->warnings()) setup.warnings.push_back(key + ".mesh: " + warning);
  }
  const double speed = flowOf(emitter) / area, own = fastestMouth(emitter);
  const bool byFlow = emitter.flow > 0;
  const auto found = [&](double limit) {  // of a speed above the limit, in terms of the key that is given
    return std::string(byFlow ? ".flow" : ".speed") + ": found " + roundedNumber(byFlow ? emitter.flow : speed) +
           (byFlow ? " m^3/s, expected at most " : " m/s, expected at most ") + roundedNumber(byFlow ? limit * area : limit) +
           (byFlow ? " m^3/s" : " m/s");
  };
  if (!(speed <= kMaxSpeed))
    return badEmitter(scene, key + found(kMaxSpeed), "fluid would leave its mouth at " + roundedNumber(speed) + " m/s");
  if (!(own <= kMaxSpeed))
    return bad("its mouth moves at " + roundedNumber(own) + " m/s; expected at most " + roundedNumber(kMaxSpeed) + " m/s");
  const double most = fastestFollowed(scene);
  if (own > most)
    setup.warnings.push_back(key + ": its mouth moves at " + roundedNumber(own) + " m/s; expected at most " + roundedNumber(most) +
                             " m/s, which solver.cfl and solver.max_substeps can follow: time is dropped");
  if (speed > most) setup.warnings.push_back(key + found(most) + ", which solver.cfl and solver.max_substeps can follow: time is dropped");
  return {};
}

void addMotion(const Emitter& emitter, EmitterRecord& record, std::vector<float>& keyframes) {
  record.firstKey = static_cast<uint32_t>(keyframes.size() / kKeyframeNumbers);
  record.keyCount = static_cast<uint32_t>(emitter.motion.size());
  record.motionSpeed = f(fastestMouth(emitter));
  for (const KeyframeRecord& key : keyframeRecords(emitter.motion)) {
    const auto numbers = std::bit_cast<std::array<float, kKeyframeNumbers>>(key);
    keyframes.insert(keyframes.end(), numbers.begin(), numbers.end());
  }
}

DrainRecord recordOf(const Drain& drain, const Double3& origin) {
  DrainRecord r{};
  const auto* sphere = std::get_if<SphereShape>(&drain.shape);
  const auto* box = std::get_if<BoxShape>(&drain.shape);
  const Double3 low = minus(sphere ? sphere->center : box->min, origin);
  const Double3 high = sphere ? Double3{sphere->radius, 0, 0} : minus(box->max, origin);
  r.lowX = f(low.x), r.lowY = f(low.y), r.lowZ = f(low.z);
  r.highX = f(high.x), r.highY = f(high.y), r.highZ = f(high.z);
  r.from = f(drain.from);
  r.until = secondsOrNever(drain.until);
  r.sphere = sphere ? 1 : 0;
  return r;
}

}  // namespace

double fastestEmitter(const Scene& scene) {
  double fastest = 0;
  for (const Emitter& emitter : emittersOf(scene))
    fastest = std::max(fastest, flowOf(emitter) / areaOf(emitter.mouth) + fastestMouth(emitter));
  return fastest;
}

void place(EmitterRecord& r, const Double3& center) { r.centerX = f(center.x), r.centerY = f(center.y), r.centerZ = f(center.z); }

void setAxes(EmitterRecord& r, const Double3& normal, const Double3& across, const Double3& up) {
  r.normalX = f(normal.x), r.normalY = f(normal.y), r.normalZ = f(normal.z);
  r.acrossX = f(across.x), r.acrossY = f(across.y), r.acrossZ = f(across.z);
  r.upX = f(up.x), r.upY = f(up.y), r.upZ = f(up.z);
}

void setFlow(EmitterRecord& r, const MouthSize& size, double flow) {
  r.speed = f(flow / size.area);
  r.rate = f(flow / size.area / size.thickness);
}

Expected<void> addFlows(const Scene& scene, const Double3& origin, FluidSetup& setup) {
  size_t number = 0;
  for (const Emitter& emitter : emittersOf(scene)) {
    const std::string key = emitterKey(scene, number);
    ++number;
    if (auto able = checkEmitter(scene, emitter, key, setup); !able) return able;
    const MouthLattice lattice = mouthLattice(emitter.mouth, scene.fluid.spacing);
    if (lattice.shared > 0)
      return badEmitter(scene, key + ".mesh",
                        grouped(lattice.shared) + " of " + grouped(lattice.points.size()) +
                            " points of a layer are in several triangles; expected a mesh that does not overlap itself");
    EmitterRecord r{};
    place(r, minus(emitter.motion.empty() ? offWalls(scene, lattice.center, lattice.normal) : lattice.center, origin));
    setAxes(r, lattice.normal, lattice.across, lattice.up);
    r.halfAcross = f(lattice.half.first);
    r.halfUp = f(lattice.half.second);
    setFlow(r, {lattice.area, lattice.thickness}, flowOf(emitter));
    r.from = f(emitter.from);
    r.until = secondsOrNever(emitter.until);
    r.firstPoint = static_cast<uint32_t>(setup.mouthPoints.size());
    r.points = static_cast<uint32_t>(lattice.points.size());
    r.shape = std::visit(Overloaded{[](const DiscMouth&) { return kDiscMouth; }, [](const RectMouth&) { return kRectMouth; },
                                    [](const MeshMouth&) { return kMeshMouth; }},
                         emitter.mouth);
    r.armX = f(lattice.arm.x), r.armY = f(lattice.arm.y), r.armZ = f(lattice.arm.z);
    r.phase = kHalfLayer;
    r.fluid = static_cast<uint32_t>(fluidIndex(scene, emitter.fluid));
    addMotion(emitter, r, setup.keyframes);
    setup.mouthPoints.insert(setup.mouthPoints.end(), lattice.points.begin(), lattice.points.end());
    setup.emitters.push_back(r);
    setup.mouthSizes.push_back({lattice.area, lattice.thickness});
  }
  for (const Drain& drain : scene.drains) setup.drains.push_back(recordOf(drain, origin));
  setup.params.emitterCount = static_cast<uint32_t>(setup.emitters.size());
  setup.params.drainCount = static_cast<uint32_t>(setup.drains.size());
  if (!scene.domain) return {};
  const Domain& domain = *scene.domain;
  if (domain.open_removes) setup.params.openRemoves = domain.open;
  if (!domain.outflow) return {};
  setup.params.openRemoves |= 1u << sideBit(domain.outflow->side);
  setup.params.outflowSide = sideBit(domain.outflow->side);
  setup.params.outflowLevel = f(domain.min.y + domain.outflow->level - origin.y);
  return {};
}

FlowRecord firstLedger(uint32_t particles, uint32_t inactive) { return {.filled = particles, .inactive = inactive, .nextId = particles}; }

}  // namespace rill
