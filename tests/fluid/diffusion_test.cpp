// Diffusion between fluids: substeps against the reference, what it conserves, and that it moves nothing.
#include <algorithm>
#include <cmath>

#include "fluid/rig.hpp"

namespace rill::test {
namespace diffusion_test {

class DiffusionTest : public FluidTest {
 protected:
  /// After substeps that are advances of their own, so that each begins a block: the largest difference of a concentration.
  double difference(const Trial& t, int substeps) {
    auto run = start(t);
    for (int n = 0; n < substeps; ++n) run->substeps(1);
    const Snapshot device = run->snapshot();
    Trial stepwise = t;
    stepwise.stepwise = true;
    Oracle oracle(stepwise);
    oracle.advance(substeps);
    const auto& exact = oracle.solver().state.concentration;
    double most = 0;
    EXPECT_EQ(device.concentration.size(), t.x.size());
    for (size_t i = 0; i < device.concentration.size(); ++i)
      for (size_t k = 0; k < 4; ++k) {
        const double wanted = k < exact.size() ? exact[k][i] : 0, off = std::abs(device.concentration[i][int(k)] - wanted);
        if (!(off <= most)) most = off;
      }
    return most;
  }
  void expectReference(Trial t, int substeps, double limit) {
    for (const Gather gather : kGathers) {
      SCOPED_TRACE(nameOf(gather));
      t.gather = gather;
      EXPECT_LE(difference(t, substeps), limit);
    }
  }
};

/// A jittered block in a corner, of fluids with these diffusivities that are mixed at random.
Trial mixture(const std::vector<double>& diffusivities) {
  Trial t = trial();
  for (const double diffusion : diffusivities)
    t.scene.fluids.push_back({.name = "fluid " + std::to_string(t.scene.fluids.size()), .diffusion = diffusion});
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 0.4, 5, glm::dvec3(-0.2));
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids.push_back(static_cast<uint8_t>(i * 7919 % diffusivities.size()));
  return t;
}

double sumOf(const Snapshot& s, int component) {
  double sum = 0;
  for (const glm::dvec4& c : s.concentration) sum += c[component];
  return sum;
}

void expectShares(const Snapshot& s) {
  for (const glm::dvec4& c : s.concentration)
    for (int k = 0; k < 4; ++k) EXPECT_TRUE(c[k] >= -1e-5 && c[k] <= 1 + 1e-5) << c[k];
}

// What is left is the rounding of floats, and that positions are off by what substep_test.cpp allows.
constexpr double kOneStep = 1e-5, kTenSteps = 2e-3;

TEST_F(DiffusionTest, MatchesReference) {
  for (const std::vector<double>& diffusivities : {std::vector{0.0, 0.1}, {0.1, 0.0}, {0.02, 0.2, 0.0}, {0.1, 0.05, 0.2, 0.02, 0.0}}) {
    SCOPED_TRACE(diffusivities.size());
    const Trial t = mixture(diffusivities);
    expectReference(t, 1, kOneStep);
    expectReference(t, 10, kTenSteps);
  }
}

// Of several stages, up to more than there are.
TEST_F(DiffusionTest, InStagesMatchesReference) {
  for (const double diffusion : {0.3, 1.0, 10.0, 100.0, 1e4}) {
    SCOPED_TRACE(diffusion);
    expectReference(mixture({0.0, diffusion}), 3, kTenSteps);
  }
}

TEST_F(DiffusionTest, OnceABlockMatchesReference) {
  Trial t = mixture({0.0, 0.1});
  t.v.clear();
  auto run = start(t);
  run->substeps(6);
  Oracle oracle(t);
  oracle.advance(6);
  const Snapshot device = run->snapshot();
  for (size_t i = 0; i < t.x.size(); ++i) EXPECT_NEAR(device.concentration[i].x, oracle.solver().state.concentration[0][i], kTenSteps) << i;
}

// Coincident particles, a pair, one alone, and one that leaves the fluid.
TEST_F(DiffusionTest, DegenerateInputKeepsSharesAndSums) {
  for (const KernelChoice kernel : {KernelChoice::Wendland, KernelChoice::Poly6Spiky})
    for (const double diffusion : {1e-9, 0.1, 1e4, 1e30}) {
      SCOPED_TRACE(diffusion);
      Trial t = mixture({0.0, diffusion});
      t.scene.solver.kernel = kernel;
      t.x.insert(t.x.end(), {{0.9, 0.9, 0.9}, {0.7, 0.8, 0.2}, {0.76, 0.8, 0.2}});
      t.v.resize(t.x.size());
      t.fluids.insert(t.fluids.end(), {1, 1, 0});
      t.x[40] = t.x[41] = t.x[42];
      forEachGather(t, 0, [&](Run& run) {
        const double before = sumOf(run.snapshot(), 0);
        run.substeps(30);
        const Snapshot after = run.snapshot();
        EXPECT_NEAR(sumOf(after, 0), before, 1e-5 * before);
        expectShares(after);
        if (diffusion == 1e-9) { EXPECT_EQ(after.concentration[t.x.size() - 3].x, 1) << "alone"; }
        EXPECT_EQ(run.stats().diffusionBoundHits > 0, diffusion > 1e3);
      });
    }
}

TEST_F(DiffusionTest, ParticlesThatBecomeInactiveTakeTheirShare) {
  Trial t = mixture({0.0, 1.0});
  t.x[3].x = std::numeric_limits<double>::quiet_NaN();
  t.x[8].x = std::numeric_limits<double>::quiet_NaN();
  auto run = start(t);
  run->substeps(10);
  const Snapshot s = run->snapshot();
  EXPECT_EQ(run->stats().diffusionBoundHits, 0u);
  expectShares(s);
  EXPECT_NEAR(sumOf(s, 0), double(std::ranges::count(t.fluids, 1)), 1e-4);
}

TEST_F(DiffusionTest, MovesNothing) {
  Trial t = mixture({0.0, 0.1});
  Trial without = mixture({0.0, 0.0});
  for (const Gather gather : kGathers) {
    t.gather = without.gather = gather;
    auto run = start(t), other = start(without);
    run->substeps(50);
    other->substeps(50);
    const Snapshot a = run->snapshot(), b = other->snapshot();
    EXPECT_TRUE(a.x == b.x && a.v == b.v);
    EXPECT_TRUE(b.concentration.empty());
    EXPECT_GT(run->fluid().memory().particleBytes, other->fluid().memory().particleBytes);
    Graph graph;
    EXPECT_EQ(other->fluid().present(graph).concentration, BufferRef{});
  }
}

// The host may give what the first particles start with; others have not mixed.
TEST_F(DiffusionTest, StartsFromAMixture) {
  Trial t = mixture({0.02, 0.2, 0.0});
  for (size_t i = 0; i < 100; ++i) t.concentration.emplace_back(double(i) / 128, 1 - double(i) / 128, 0, 0);
  expectReference(t, 10, kTenSteps);
  const auto refusal = [&](const ParticleSet& particles) {
    const Scene scene = t.timedScene();
    const auto made = Fluid::create(rillDevice(), {.scene = &scene, .particles = &particles});
    return made ? std::string() : made.error().message;
  };
  ParticleSet particles = t.particles();
  for (const float bad : {-0.01F, 1.01F, std::numeric_limits<float>::quiet_NaN()}) {
    particles.concentrations[7].y = bad;
    EXPECT_NE(refusal(particles).find("ParticleSet::concentrations has "), std::string::npos) << bad;
  }
  particles.concentrations.assign(t.x.size() + 1, Float4{});
  EXPECT_EQ(refusal(particles), "ParticleSet::concentrations has 253 entries; expected at most one for each of 252 positions");
}

TEST_F(DiffusionTest, GoesOnFromASnapshot) {
  const Trial t = mixture({0.02, 0.2, 0.0});
  auto run = start(t);
  run->substeps(7);
  const FluidSnapshot state = run->saved();
  EXPECT_EQ(state.concentration.size(), t.x.size());
  auto again = start(t, &state);
  run->substeps(20);
  again->substeps(20);
  EXPECT_EQ(firstDifference(run->saved(), again->saved()), "");
  // Particles that were added after the state was saved have not mixed.
  FluidSnapshot shorter = state;
  shorter.concentration.resize(10);
  const Snapshot s = start(t, &shorter)->snapshot();
  EXPECT_EQ(s.concentration.size(), t.x.size());
  expectShares(s);
  shorter.concentration.resize(t.x.size() + 1);
  const Scene scene = t.timedScene();
  const ParticleSet particles = t.particles();
  const auto refused = Fluid::create(rillDevice(), {.scene = &scene, .particles = &particles, .snapshot = &shorter});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("mixture has 253 entries; expected at most 252"), std::string::npos) << refused.error().message;
}

TEST_F(DiffusionTest, EmittersAddWhatHasNotMixed) {
  Trial t = mixture({0.0, 1e-9});
  t.capacity = 600;
  t.scene.emitters = {{.name = "milk", .mouth = DiscMouth{{0.7, 0.8, 0.7}, 0.15, {0, -1, 0}}, .speed = 1.0, .fluid = "fluid 1"}};
  auto run = start(t);
  run->substeps(100);
  const Snapshot s = run->snapshot();
  ASSERT_GT(s.concentration.size(), t.x.size() + 20);
  for (size_t i = t.x.size(); i < s.concentration.size(); ++i) EXPECT_NEAR(s.concentration[i].x, 1, 1e-5) << i;
}

TEST_F(DiffusionTest, WarnsOfOneFluidThatDiffuses) {
  Trial t = trial();
  t.x = block({3, 3, 3}, t.d());
  t.scene.fluids = {{.name = "milk", .diffusion = 1e-4}};
  const std::string warning = "fluids.milk.diffusion: has no effect in a scene with one fluid, expected two or more in fluids";
  EXPECT_EQ(std::ranges::count(start(t)->fluid().warnings(), warning), 1);
  t.scene.fluids.push_back({.name = "water"});
  EXPECT_EQ(std::ranges::count(start(t)->fluid().warnings(), warning), 0);
}

}  // namespace diffusion_test
}  // namespace rill::test
