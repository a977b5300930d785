// What a host may get wrong in calls on a device: each is an error with a message, and the fluid goes on as if it had not been asked.
#include <cmath>
#include <limits>

#include "fluid/rig.hpp"

namespace rill::test {
namespace input_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

class FluidInput : public FluidTest {
 protected:
  static Trial tank() {
    Trial t = trial();
    setWalls(t, {0.5, 0.5, 0.5});
    t.x = block({4, 4, 4}, t.d());
    t.scene.solids = {ball({0.4, 0.1, 0.4}, 0.05)};
    t.scene.solids[0].driven = 1;
    return t;
  }
  std::string refusal(const FluidDesc& desc) {
    const auto made = Fluid::create(rillDevice(), desc);
    if (made) return "made";
    EXPECT_EQ(made.error().kind, ErrorKind::BadInput);
    return made.error().message;
  }
};

TEST_F(FluidInput, RejectsInvalidDescriptions) {
  const Trial t = tank();
  const ParticleSet particles = t.particles();
  EXPECT_EQ(refusal({}), "FluidDesc::scene is null; expected a scene");
  EXPECT_EQ(refusal({.scene = &t.scene}), "FluidDesc::particles is null; expected what makeParticles() makes, or a set of the host's own");
  ParticleSet few = particles;
  few.velocities.pop_back();
  EXPECT_EQ(refusal({.scene = &t.scene, .particles = &few}), "a fluid needs as many velocities as positions: 63 for 64");
  for (const double bad : {kNan, kInf, 1e300}) {
    ParticleSet lost = particles;
    lost.origin[1] = bad;
    EXPECT_NE(refusal({.scene = &t.scene, .particles = &lost}).find("ParticleSet::origin is "), std::string::npos) << bad;
  }
}

TEST_F(FluidInput, RejectsSpacingThatIsNotTheScenes) {
  Trial t = tank();
  t.scene.fluid.spacing = 0.0625;
  ParticleSet set = t.particles();
  for (const auto& [spacing, text] : {std::pair{0.5, "0.5"}, {-0.0625, "-0.0625"}, {kNan, "nan"}}) {
    set.spacing = spacing;
    EXPECT_EQ(refusal({.scene = &t.scene, .particles = &set}),
              "ParticleSet::spacing is " + std::string(text) + "; expected the scene's fluid.spacing, 0.0625 (m)");
  }
  t.scene.fluid.spacing = 0, t.scene.fluid.particles = 64;
  EXPECT_EQ(refusal({.scene = &t.scene, .particles = &set}), "ParticleSet::spacing is nan; expected a length above 0 (m)");
}

TEST_F(FluidInput, RejectsInvalidScenes) {
  const Trial t = tank();
  const ParticleSet particles = t.particles();
  const auto with = [&](auto&& change) {
    Scene scene = t.scene;
    change(scene);
    return refusal({.scene = &scene, .particles = &particles});
  };
  EXPECT_EQ(with([](Scene& s) { s.gravity[1] = kNan; }), "gravity[1]: nan is not finite; expected a number (m/s^2)");
  EXPECT_EQ(with([](Scene& s) { s.solver.iterations = 4'000'000'000; }),
            "solver.iterations: 4000000000 is out of range; expected a whole number from 1 to 1000");
  EXPECT_EQ(with([](Scene& s) {
              s.solids[0].shape = SphereShape{{0, 0, 0}, -1};
            }),
            "solids[0].sphere.radius: -1 is out of range; expected a number above 0 (m)");
  EXPECT_EQ(with([](Scene& s) { s.fluid.smoothing_ratio = kNan; }),
            "fluid.smoothing_ratio: nan is not finite; expected a number from 1.2 to 4");
  EXPECT_EQ(with([](Scene& s) { s.fluid.spacing = 0, s.fluid.particles = 64; }),
            "fluid.spacing: expected a number above 0 (m) here or in ParticleSet::spacing, found none");
}

TEST_F(FluidInput, RejectsInvalidSteps) {
  const Trial t = tank();
  auto run = start(t);
  run->advance(0.01);
  const Snapshot before = run->snapshot();
  const auto invalid = [&](const FluidStep& step) {
    Graph graph;
    (void)run->fluid().addTo(graph, step);
    const auto compiled = graph.compile();
    if (compiled) return std::string("compiled");
    EXPECT_EQ(compiled.error().kind, ErrorKind::BadInput);
    return compiled.error().message;
  };
  EXPECT_EQ(invalid({.advance_s = kNan}), "FluidStep::advance_s is nan; expected a finite time of at least 0 (s)");
  EXPECT_EQ(invalid({.advance_s = -0.1}), "FluidStep::advance_s is -0.1; expected a finite time of at least 0 (s)");
  EXPECT_EQ(invalid({.advance_s = kInf}), "FluidStep::advance_s is inf; expected a finite time of at least 0 (s)");
  EXPECT_EQ(invalid({.advance_s = 1e300}), "FluidStep::advance_s is 1e+300; expected a finite time of at least 0 (s)");
  const SolidTarget unknown[] = {{.solid = 0}, {.solid = 7}};
  EXPECT_EQ(invalid({.advance_s = 0.01, .targets = unknown}), "FluidStep::targets[1].solid is 7; the scene has 1 solid");
  for (const auto& [bad, text] : {std::pair{Quaternion{0, 0, 0, 0}, "(0, 0, 0, 0)"},
                                  {Quaternion{0, kNan, 0, 1}, "(0, nan, 0, 1)"},
                                  {Quaternion{0, 0, -kInf, 1}, "(0, 0, -inf, 1)"}}) {
    const SolidTarget turned[] = {{.solid = 0, .rotation = bad}};
    EXPECT_EQ(invalid({.advance_s = 0.01, .targets = turned}),
              "FluidStep::targets[0].rotation is " + std::string(text) + "; expected a finite quaternion x y z w of a length above 0");
  }
  for (const double v : run->fluid().drivenCenter(7)) EXPECT_TRUE(std::isnan(v));
  for (const double v : run->fluid().drivenRotation(7)) EXPECT_TRUE(std::isnan(v));
  EXPECT_TRUE(std::isfinite(run->fluid().drivenCenter(0)[0]));
  EXPECT_EQ(run->snapshot(), before);
  run->advance(0.01);
  EXPECT_NE(run->snapshot(), before) << "it goes on";
}

}  // namespace input_test
}  // namespace rill::test
