#pragma once
// Scenes with emitters, their particles, and the ledger of particles.
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string>

#include "fluid/flows.hpp"
#include "fluid/rig.hpp"
#include "reference/emitters.hpp"

namespace rill::test {
namespace flows_test {

inline Emitter disc(const Double3& center, double radius, const Double3& normal, double speed) {
  return {.mouth = DiscMouth{.center = center, .radius = radius, .normal = normal}, .speed = speed};
}

/// Space without walls, empty but for what emitters add.
inline Trial space(uint32_t capacity = 4000) {
  Trial t = trial();
  t.scene.gravity = {0, 0, 0};
  t.scene.solver.tolerance = 0;
  t.capacity = capacity;
  return t;
}

/// A tank of half its height.
inline Trial tank() {
  Trial t = trial();
  setWalls(t, {1, 1, 0.5});
  t.x = block({16, 8, 8}, t.d(), {}, 0.01);
  t.capacity = 4000;
  t.step = 2e-3;
  return t;
}

using reference::vec;
inline glm::dvec3 vec(const Float3& v) { return {v.x, v.y, v.z}; }

/// By `angle` (rad) about a unit vector.
inline Quaternion turn(const Double3& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {s * axis.x, s * axis.y, s * axis.z, std::cos(angle / 2)};
}

inline reference::EmitterSettings settingsOf(const Emitter& emitter, double spacing) {
  const MouthLattice lattice = mouthLattice(emitter.mouth, spacing);
  const double speed = emitter.speed > 0 ? emitter.speed : emitter.flow / lattice.area;
  reference::EmitterSettings s{
      .center = vec(lattice.center) - vec(lattice.arm), .velocity = speed * vec(lattice.normal), .rate = speed / lattice.thickness};
  s.from = emitter.from;
  s.until = emitter.until.value_or(1e9);
  s.motion = emitter.motion;
  for (const auto& [across, up] : lattice.points)
    s.points.push_back(vec(lattice.arm) + double{across} * vec(lattice.across) + double{up} * vec(lattice.up));
  return s;
}

inline bool isInactive(const Float3& x) { return x.x > kInactiveLimit; }

class FlowsTest : public FluidTest {
 protected:
  /// Active particles by id.
  std::map<uint32_t, std::pair<glm::dvec3, glm::dvec3>> particles(const FluidSnapshot& s) {
    std::map<uint32_t, std::pair<glm::dvec3, glm::dvec3>> all;
    for (size_t i = 0; i < s.id.size(); ++i) {
      if (isInactive(s.position[i])) continue;
      EXPECT_TRUE(all.insert({s.id[i], {vec(s.position[i]), vec(s.velocity[i])}}).second) << "an id twice";
    }
    return all;
  }

  /// One emitter's particles against the closed form, at the end of the run.
  void expectBirths(const Trial& t, Run& run, double position, double velocity) {
    const FluidSnapshot state = run.saved();
    const double time = run.progress().time_s;
    const auto expected = reference::births(settingsOf(t.scene.emitters[0], t.d()), time, vec(t.scene.gravity));
    const auto found = particles(state);
    const size_t layer = mouthLattice(t.scene.emitters[0].mouth, t.d()).points.size();
    // The last layer may be late by the time of a substep and of kLateLayers.
    EXPECT_LE(found.size(), expected.size());
    ASSERT_GE(found.size() + layer, expected.size());
    EXPECT_GT(found.size(), 2 * layer);
    for (const auto& [id, particle] : found) {
      EXPECT_LT(glm::length(particle.first - expected[id].position), position * t.d()) << id;
      EXPECT_LT(glm::length(particle.second - expected[id].velocity), velocity) << id;
    }
  }

  FluidLedger expectBalance(Run& run) {
    const FluidStats s = run.stats();
    const FluidLedger& l = s.ledger;
    EXPECT_EQ(l.filled + l.emitted, s.particles + l.drained + l.left + l.inactive);
    return l;
  }

  /// What each emitter has let out at a time is its flow (m^3/s) times the time that it was open, within a layer.
  void expectExactFlow(const Trial& t, const std::vector<double>& flows, const std::vector<double>& frames) {
    for (const double frame : frames) {
      auto run = start(t);
      for (int k = 1; k * frame < 0.401; ++k) {
        run->advance(frame);
        run->stats();
        const double time = run->progress().time_s;
        for (size_t e = 0; e < flows.size(); ++e) {
          const MouthLattice lattice = mouthLattice(t.scene.emitters[e].mouth, t.d());
          const double open = std::min(time, t.scene.emitters[e].until.value_or(1e9));
          EXPECT_NEAR(run->fluid().emitted()[e].volume, flows[e] * open, lattice.area * lattice.thickness) << e << " at " << time;
        }
      }
      expectBalance(*run);
    }
  }

  /// A run that resumes halfway has the bits of one without a break. The ledger at the end.
  FluidLedger goesOnFromASnapshot(const Trial& t) {
    auto whole = start(t);
    for (int frame = 0; frame < 4; ++frame) whole->advance(1.0 / 60);
    const FluidSnapshot half = whole->saved();
    for (int frame = 0; frame < 4; ++frame) whole->advance(1.0 / 60);
    auto again = start(t, &half);
    for (int frame = 0; frame < 4; ++frame) again->advance(1.0 / 60);
    EXPECT_EQ(firstDifference(again->saved(), whole->saved()), "");
    return whole->stats().ledger;
  }

  /// expectBirths() after 0.4 s, at several steps and in every way to gather.
  void expectBirthsInEveryWay(Trial t) {
    for (const double step : {1e-3, 2.7e-3, 8e-3})
      for (const Gather gather : kGathers) {
        SCOPED_TRACE(std::string(nameOf(gather)) + ", step " + std::to_string(step));
        t.step = step;
        t.gather = gather;
        auto run = start(t);
        for (int frame = 0; frame < 5; ++frame) run->advance(0.08);
        expectBirths(t, *run, 2e-3, 2e-3);
      }
  }
};

}  // namespace flows_test
}  // namespace rill::test
