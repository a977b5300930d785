#include "fluid/rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "offline/readout.hpp"
#include "reference/scene_settings.hpp"

namespace rill::test {
namespace {

glm::dvec3 wide(const Float3& v) { return {v.x, v.y, v.z}; }

FluidSetup setupOf(const Trial& trial) {
  const auto count = static_cast<uint32_t>(trial.x.size());
  StartFigures start{.capacity = std::max(count, trial.capacity)};
  for (int a = 0; a < 3; ++a) {
    start.origin[a] = trial.origin[a];
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const glm::dvec3& p : trial.x)
      if (std::isfinite(p.x + p.y + p.z)) low = std::min(low, p[a]), high = std::max(high, p[a]);
    start.extent[a] = std::max(0.0, high - low);
  }
  for (const glm::dvec3& v : trial.v)
    if (std::isfinite(glm::length(v))) start.fastest = std::max(start.fastest, glm::length(v));
  auto setup = makeFluidSetup(trial.timedScene(), start);
  if (!setup) throw std::runtime_error(setup.error().message);
  return *std::move(setup);
}

reference::ReferenceSettings settingsOf(const Trial& trial) {
  reference::ReferenceSettings s = reference::settingsOf(trial.scene, setupOf(trial), trial.origin);
  s.tabulated = true;
  for (const BodyPull& pull : trial.pulls)
    s.pulls.push_back({.solid = pull.solid,
                       .point = reference::vec(pull.point),
                       .target = reference::vec(pull.target) - reference::vec(trial.origin),
                       .rate = 2 * std::numbers::pi * pull.frequency_Hz,
                       .dampingRatio = pull.dampingRatio,
                       .maxForce = pull.maxForce});
  if (trial.stepwise) s.substepsPerBlock = 1;
  return s;
}

std::vector<glm::dvec3> rounded(std::vector<glm::dvec3> points) {
  for (glm::dvec3& p : points) p = wide(narrow(p));
  return points;
}

}  // namespace

std::string firstDifference(const FluidSnapshot& a, const FluidSnapshot& b) {
  std::string found;
  const auto compare = [&](const char* name, const auto& x, const auto& y) {
    if (!found.empty() || x == y) return;
    found = name;
    if (x.size() != y.size()) {
      found += ": " + std::to_string(x.size()) + " and " + std::to_string(y.size()) + " values";
      return;
    }
    size_t count = 0, first = x.size();
    for (size_t i = x.size(); i-- > 0;) {
      if (x[i] == y[i]) continue;
      ++count;
      first = i;
    }
    found += ": " + std::to_string(count) + " of " + std::to_string(x.size()) + " differ, the first at " + std::to_string(first) + ", " +
             ::testing::PrintToString(x[first]) + " and " + ::testing::PrintToString(y[first]);
  };
  compare("control", a.control, b.control);
  compare("sums", a.sums, b.sums);
  compare("solids", a.solids, b.solids);
  compare("bodies", a.bodies, b.bodies);
  compare("slips", a.slips, b.slips);
  compare("loads", a.loads, b.loads);
  compare("pressures", a.pressures, b.pressures);
  compare("flows", a.flows, b.flows);
  compare("regions", a.regions, b.regions);
  compare("id", a.id, b.id);
  compare("position", a.position, b.position);
  compare("velocity", a.velocity, b.velocity);
  compare("fluid", a.fluid, b.fluid);
  compare("concentration", a.concentration, b.concentration);
  compare("warmAcceleration", a.warmAcceleration, b.warmAcceleration);
  compare("warmStart", a.warmStart, b.warmStart);
  compare("rest", a.rest, b.rest);
  compare("nearSolids", a.nearSolids, b.nearSolids);
  compare("neighborCount", a.neighborCount, b.neighborCount);
  compare("neighbors", a.neighbors, b.neighbors);
  compare("cell", a.cell, b.cell);
  if (found.empty() && !(a == b)) found = "listCapacity";
  return found;
}

bool Snapshot::finite() const {
  for (const auto* all : {&x, &v})
    for (const glm::dvec3& p : *all)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  return true;
}

glm::dvec3 Snapshot::velocitySum() const {
  glm::dvec3 sum(0);
  for (const glm::dvec3& each : v) sum += each;
  return sum;
}

double Snapshot::fastest() const {
  double most = 0;
  for (const glm::dvec3& each : v) most = std::max(most, glm::length(each));
  return most;
}

Oracle::Oracle(const Trial& trial) : trial_(trial), solver_(settingsOf(trial), rounded(trial.x), rounded(trial.v)) {
  const FluidParams p = setupOf(trial).params;
  std::ranges::copy(trial.fluids, solver_.state.fluid.begin());
  if (trial.settle && p.initialPressureIterations > 0)
    solver_.solveInitialPressure(p.initialPressureStep, p.initialPressureMomentum, static_cast<int>(p.initialPressureIterations));
  solver_.begin(trial.step);
  for (size_t k = 0; k < solver_.state.concentration.size(); ++k)
    for (size_t i = 0; i < trial.concentration.size(); ++i) solver_.state.concentration[k][i] = trial.concentration[i][int(k)];
}

std::vector<reference::Impulse> Oracle::advanceWithLoads(int substeps) {
  std::vector<reference::Impulse> sums(trial_.scene.solids.size());
  solver_.startBlock();
  for (int n = 0; n < substeps; ++n) {
    substep();
    for (size_t k = 0; k < sums.size(); ++k) {
      sums[k].linear += solver_.impulses()[k].linear;
      sums[k].angular += solver_.impulses()[k].angular;
    }
  }
  return sums;
}

void Oracle::advance(int substeps) {
  solver_.startBlock();
  for (int n = 0; n < substeps; ++n) substep();
}

void Oracle::substep() {
  // A change that is due when a substep ends acts on the prediction of the next one.
  for (const GravityChange& change : trial_.scene.gravity_changes)
    if (change.at <= solver_.time() + trial_.step + 1e-7) solver_.settings.gravity = {change.value[0], change.value[1], change.value[2]};
  solver_.substep(trial_.step, trial_.step);
}

FluidTest::Run::Run(FluidTest& test, const Trial& trial, const FluidSnapshot* from) : pulls(trial.pulls), test_(test), step_(trial.step) {
  Scene scene = trial.timedScene();
  if (trial.gather == Gather::Grid) scene.solver.neighbors = NeighborChoice::Grid;
  const ParticleSet particles = trial.particles();
  auto made = Fluid::create(test.rillDevice(), {.scene = &scene,
                                                .particles = &particles,
                                                .snapshot = from,
                                                .settle = trial.settle,
                                                .capacity = trial.capacity,
                                                .storageReads = trial.gather == Gather::Storage,
                                                .loads = trial.loads,
                                                .mergePasses = trial.mergePasses.value_or(trial.gather == Gather::Storage)});
  if (!made) throw std::runtime_error(made.error().message);
  fluid_ = std::move(*made);
  fillTransients(0xffffffffu);
}

void FluidTest::Run::fillTransients(uint32_t word) {
  graph_.reset();
  BufferRef transients = graph_.create("transient fill", {std::min(uint64_t{8} << 20, test_.rillDevice().info().maxBufferBytes)});
  graph_.pass("transient fill", [&](Pass& pass) {
    transients = pass.write(transients, Use::CopyTarget, true);
    pass.sideEffect();
    return [transients, word](Commands& commands) { commands.fill(transients, word); };
  });
  test_.runGraph(graph_);
}

FluidSnapshot FluidTest::Run::saved() {
  read({});
  SnapshotReader reader(*fluid_);
  for (Graph graph; !reader.done();) {
    graph.reset();
    reader.declare(graph);
    test_.runGraph(graph);
    const auto taken = reader.take(graph);
    EXPECT_TRUE(taken) << taken.error().message;
    if (!taken) break;
  }
  return std::move(reader.snapshot());
}

void FluidTest::Run::advance(double seconds, uint32_t piece) {
  bool resume = false;
  do {
    graph_.reset();
    fluid_->addTo(graph_,
                  {.advance_s = seconds, .resume = resume, .substeps = piece, .targets = targets, .pulls = pulls, .emitters = emitters});
    emitters.clear();
    test_.runGraph(graph_);
    if (HasFatalFailure()) return;
    resume = true;
  } while (fluid_->progress().timeLeft_s > 0);
}

Snapshot FluidTest::Run::read(const FluidStep& step) {
  graph_.reset();
  const FluidState state = fluid_->addTo(graph_, step);
  const auto tickets = offline::readout(graph_, state);
  const Ticket control = state.capacity > 0 ? graph_.readback(state.control) : Ticket{};
  test_.runGraph(graph_);
  if (const auto bytes = graph_.data(control); bytes.size() >= sizeof control_) std::memcpy(&control_, bytes.data(), sizeof control_);
  const auto raw = offline::collect(graph_, tickets);
  Snapshot result;
  result.x.resize(raw.ids.size());
  result.v.resize(raw.ids.size());
  result.density.resize(raw.ids.size());
  result.concentration.resize(raw.concentrations.size());
  std::vector<uint32_t> ids(raw.ids);
  std::sort(ids.begin(), ids.end());
  for (size_t i = 0; i < raw.ids.size(); ++i) {
    const auto place = static_cast<size_t>(std::lower_bound(ids.begin(), ids.end(), raw.ids[i]) - ids.begin());
    result.x[place] = wide(raw.positions[i]);
    result.v[place] = wide(raw.velocities[i]);
    if (!raw.concentrations.empty()) {
      const Float4& c = raw.concentrations[i];
      result.concentration[place] = {c.x, c.y, c.z, c.w};
    }
    result.density[place] = step.stats ? raw.relativeDensities[i] : 0.0;
  }
  return result;
}

Snapshot FluidTest::Run::snapshot() { return read({}); }

FluidStats FluidTest::Run::stats() {
  measured_ = read({.stats = true});
  const auto stats = fluid_->stats();
  if (!stats) throw std::runtime_error("no figures came back");
  return *stats;
}

Difference FluidTest::difference(const Trial& trial, int substeps, Oracle& exact) {
  auto run = start(trial);
  if (trial.stepwise)
    for (int n = 0; n < substeps; ++n) run->substeps(1);
  else
    run->substeps(substeps);
  const Snapshot device = run->snapshot();
  const auto& expected = exact.solver().state;
  Difference most;
  for (size_t i = 0; i < device.x.size(); ++i) {
    const double position = glm::length(device.x[i] - expected.position[i]) / trial.d();
    const double velocity = glm::length(device.v[i] - expected.velocity[i]) * trial.step / trial.d();
    if (!(position <= most.position)) most.worst = i;
    // Not std::max: what is not a number has to stand out.
    if (!(position <= most.position)) most.position = position;
    if (!(velocity <= most.velocity)) most.velocity = velocity;
  }
  return most;
}

void FluidTest::forEachGather(Trial trial, int substeps, const std::function<void(Run&)>& check) {
  for (Gather gather : gathersInTurn()) {
    SCOPED_TRACE(nameOf(gather));
    trial.gather = gather;
    auto run = start(trial);
    run->substeps(substeps);
    check(*run);
  }
}

void FluidTest::expectEqual(Trial trial, int substeps, double position, double velocity, double ageing) {
  Oracle oracle(trial);
  oracle.advance(substeps);
  for (Gather gather : gathersInTurn()) {
    trial.gather = gather;
    SCOPED_TRACE(std::string(nameOf(gather)) + ", " + std::to_string(substeps) + " substeps");
    const Difference most = difference(trial, substeps, oracle);
    if (std::getenv("RILL_SHOW"))
      std::printf("%s %d: %.3g %.3g (%zu)\n", nameOf(gather), substeps, most.position, most.velocity, most.worst);
    EXPECT_LE(most.position, position + (gather == Gather::Grid ? 0 : ageing)) << "spacings, particle " << most.worst;
    EXPECT_LE(most.velocity, velocity + (gather == Gather::Grid ? 0 : ageing)) << "spacings a substep, particle " << most.worst;
  }
}

}  // namespace rill::test
