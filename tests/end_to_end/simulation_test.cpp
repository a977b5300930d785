// rill::offline as a library.
#include <algorithm>
#include <cmath>

#include "end_to_end/simulation_rig.hpp"
#include "rill/player.hpp"

namespace rill::offline {
namespace simulation_test {

TEST(Simulation, ResultDoesNotDependOnSubmitSize) {
  Options options;
  const uint64_t chosen = hashAfter(options, 12);
  for (const uint32_t piece : {1u, 7u, 64u}) {
    options.substepsPerSubmit = piece;
    EXPECT_EQ(hashAfter(options, 12), chosen) << piece;
  }
}

TEST(Simulation, MeasuringDoesNotChangeResult) {
  auto looked = open(), left = open();
  ASSERT_TRUE(looked && left);
  for (int k = 0; k < 8; ++k) {
    ASSERT_TRUE(looked->advance(1.0 / 60));
    ASSERT_TRUE(left->advance(1.0 / 60));
    ASSERT_TRUE(looked->stats());
    ASSERT_TRUE(looked->particles());
    ASSERT_TRUE(looked->render("density", 64, 36));
  }
  EXPECT_EQ(looked->stats()->stateHash, left->stats()->stateHash);
}

TEST(Simulation, LongAdvancesAreSplitIntoFrames) {
  Options frames;
  frames.longestFrame_s = 1.0 / 60;
  auto once = open(frames), often = open(frames);
  ASSERT_TRUE(once && often);
  ASSERT_TRUE(once->advance(12.0 / 60));
  for (int k = 0; k < 12; ++k) ASSERT_TRUE(often->advance((12.0 / 60) / 12));
  const auto a = once->stats(), b = often->stats();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->stateHash, b->stateHash);
  EXPECT_GT(a->substeps, b->substeps) << "of the whole advance";
  EXPECT_EQ(a->timeDropped_s, 0);
  EXPECT_NEAR(once->time(), 0.2, 1e-12);
  EXPECT_NEAR(a->time_s, 0.2, 1e-6);
}

// The next frame is submitted before the last is known to be complete: it begins on the device, or does not.
TEST(Simulation, QueuedFramesDoNotChangeBits) {
  for (const char* more : {R"(, "solver": {"neighbors": "grid"})", R"(, "solver": {"iterations": 2},
                           "solids": [{"sphere": {"center": [0.7, 0.2, 0.15], "radius": 0.1},
                                       "motion": [{"at": 0, "translate": [0, 0, 0]}, {"at": 1, "translate": [-0.3, 0, 0]}]}])"}) {
    const std::string text = R"({"rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
      "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}])" +
                             std::string(more) + "}";
    const auto scene = parseScene(text, "scene", ".");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto hashOf = [&](int advances, uint32_t piece) {
      Options options;
      options.validation = true;
      options.substepsPerSubmit = piece;
      options.longestFrame_s = 1.0 / 60;
      auto simulation = Simulation::open(*scene, options);
      EXPECT_TRUE(simulation);
      for (int k = 0; k < advances; ++k) EXPECT_TRUE(simulation->advance((15.0 / 60) / advances));
      const auto stats = simulation->stats();
      EXPECT_TRUE(stats);
      EXPECT_EQ(stats->timeDropped_s, 0);
      EXPECT_NEAR(stats->time_s, 0.25, 1e-6);
      EXPECT_EQ(simulation->takeValidationMessages(), std::vector<std::string>());
      return stats->stateHash;
    };
    const uint64_t separate = hashOf(15, 0);
    for (const uint32_t piece : {0u, 1u, 13u}) EXPECT_EQ(hashOf(1, piece), separate) << more << ", " << piece;
  }
}

TEST(Simulation, ReturnsParticles) {
  auto simulation = open();
  ASSERT_TRUE(simulation);
  const auto start = simulation->particles();
  ASSERT_TRUE(start);
  ASSERT_EQ(start->ids.size(), 600u);
  for (uint32_t i = 0; i < 600; ++i) {
    ASSERT_EQ(start->ids[i], i);
    EXPECT_EQ(start->positions[i], simulation->start().positions[i]) << "the origin is zero here";
  }
  ASSERT_TRUE(simulation->advance(0.2));
  const auto byId = simulation->particles(Order::ById), stored = simulation->particles(Order::AsStored);
  ASSERT_TRUE(byId && stored);
  bool moved = false;
  for (uint32_t i = 0; i < 600; ++i) {
    moved |= !(byId->positions[i] == start->positions[i]);
    EXPECT_EQ(stored->positions[i], byId->positions[stored->ids[i]]);
    EXPECT_NEAR(byId->densities[i], 700, 400);
  }
  EXPECT_TRUE(moved);
}

TEST(Simulation, AddsTheOrigin) {
  Scene far = dam();
  for (int axis = 0; axis < 3; ++axis) {
    far.domain->min[axis] += 512, far.domain->max[axis] += 512;
    std::get<BoxShape>(far.fill[0].shape).min[axis] += 512, std::get<BoxShape>(far.fill[0].shape).max[axis] += 512;
  }
  auto near = open(), moved = open({}, far);
  ASSERT_TRUE(near && moved);
  ASSERT_TRUE(near->advance(0.1));
  ASSERT_TRUE(moved->advance(0.1));
  EXPECT_EQ(near->stats()->stateHash, moved->stats()->stateHash) << "the same to the last bit, far from zero";
  EXPECT_NEAR(near->stats()->front_m, moved->stats()->front_m, 1e-12);
  EXPECT_NEAR(moved->particles()->positions[0].x, 512 + near->particles()->positions[0].x, 1e-4);
}

TEST(Simulation, StatsAreOfCurrentInstant) {
  Options options;
  options.passTimes = true;
  auto simulation = open(options);
  ASSERT_TRUE(simulation);
  ASSERT_TRUE(simulation->advance(1.0 / 60));
  const auto first = simulation->stats(), again = simulation->stats();
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->wall_s, again->wall_s);
  EXPECT_EQ(first->substeps, again->substeps);
  EXPECT_GT(first->wall_s, 0);
  ASSERT_FALSE(first->passes.empty());
  for (const PassTime& pass : first->passes) EXPECT_GT(pass.ms, 0) << pass.name;
  EXPECT_FALSE(first->skipped.empty());
  EXPECT_NE(simulation->explain().find("skipped: vorticity is 0"), std::string::npos);
  EXPECT_NE(simulation->graphDot().find("digraph"), std::string::npos);
}

TEST(Simulation, PassTimesAreOptional) {
  auto simulation = open();
  ASSERT_TRUE(simulation);
  ASSERT_TRUE(simulation->advance(1.0 / 60));
  const auto stats = simulation->stats();
  ASSERT_TRUE(stats);
  ASSERT_FALSE(stats->passes.empty()) << "what ran is known all the same";
  for (const PassTime& pass : stats->passes) {
    EXPECT_GT(pass.recorded, 0u) << pass.name;
    EXPECT_EQ(pass.ms, 0) << pass.name;
  }
  Options timed;
  timed.passTimes = true;
  EXPECT_EQ(hashAfter({}, 3), hashAfter(timed, 3));
}

TEST(Simulation, RejectsInvalidArguments) {
  auto simulation = open();
  ASSERT_TRUE(simulation);
  EXPECT_FALSE(simulation->advance(-1));
  EXPECT_FALSE(simulation->advance(std::nan("")));
  EXPECT_TRUE(simulation->advance(0));
  EXPECT_FALSE(simulation->render("inside out", 64, 36));
  EXPECT_FALSE(simulation->render("particles", 0, 36));
  EXPECT_FALSE(Simulation::open(std::filesystem::path("missing.json")));
}

TEST(Simulation, ExposureBrightensFinalPicturesOnly) {
  const auto sumOf = [](double stops, const std::string& view) {
    auto simulation = open({.exposure_stops = stops});
    const auto image = simulation->render(view, 64, 36);
    EXPECT_TRUE(image) << image.error().message;
    uint64_t sum = 0;
    for (const uint8_t value : image->rgba) sum += value;
    return sum;
  };
  EXPECT_LT(sumOf(-1, "final"), sumOf(0, "final"));
  EXPECT_LT(sumOf(0, "final"), sumOf(1, "final"));
  EXPECT_EQ(sumOf(0, "depth"), sumOf(1, "depth"));
  const auto linear = [](double stops) {
    auto simulation = open({.exposure_stops = stops, .validation = true});
    const auto image = simulation->renderLinear(64, 36);
    EXPECT_TRUE(image) << image.error().message;
    EXPECT_TRUE(simulation->takeValidationMessages().empty());
    return image->rgba;
  };
  const std::vector<uint16_t> halves = linear(0);
  ASSERT_EQ(halves.size(), 4u * 64 * 36);
  for (size_t k = 3; k < halves.size(); k += 4) ASSERT_EQ(halves[k], 0x3C00) << "alpha is 1";
  EXPECT_GT(std::ranges::count_if(halves, [](uint16_t half) { return half > 0x2000 && half < 0x3C00; }), 64 * 36) << "light up to 1";
  EXPECT_EQ(linear(2), halves) << "before exposure";
  for (const double bad : {10.5, -11.0, double(NAN)}) {
    const auto refused = Simulation::open(dam(), {.exposure_stops = bad});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("Options::exposure_stops is "), std::string::npos) << refused.error().message;
    EXPECT_FALSE(Player::open(dam(), {.exposure_stops = bad}));
  }
}

TEST(Simulation, IsCleanUnderValidation) {
  Options options;
  options.validation = true;
  auto simulation = open(options);
  ASSERT_TRUE(simulation);
  ASSERT_TRUE(simulation->advance(0.05));
  ASSERT_TRUE(simulation->stats());
  ASSERT_TRUE(simulation->render("particles", 96, 54));
  for (const std::string& message : simulation->takeValidationMessages()) ADD_FAILURE() << message;
}

TEST(Simulation, ParticlesKeepTheirFluid) {
  auto scene = parseScene(R"({
    "rill": "0.2", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
    "fluids": [{"name": "water"}, {"name": "oil", "density": 800}],
    "fill": [{"box": {"max": [0.5, 0.3, 0.3]}}, {"fluid": "oil", "box": {"min": [0, 0.3, 0], "max": [0.5, 0.5, 0.3]}}],
    "emitters": [{"fluid": "oil", "disc": {"center": [0.7, 0.8, 0.15], "radius": 0.1, "normal": [0, -1, 0]}, "flow": 0.01}]})",
                          "two", ".");
  ASSERT_TRUE(scene) << scene.error().message;
  auto simulation = open({}, *scene);
  ASSERT_TRUE(simulation);
  ASSERT_TRUE(simulation->advance(0.25));
  const auto particles = simulation->particles();
  ASSERT_TRUE(particles);
  const std::vector<uint8_t>& first = simulation->start().fluids;
  ASSERT_EQ(particles->fluids.size(), particles->ids.size());
  ASSERT_GT(particles->ids.size(), first.size()) << "some were emitted";
  double oil = 0, water = 0, ofOil = 0, ofWater = 0;
  for (size_t i = 0; i < particles->ids.size(); ++i) {
    const uint32_t id = particles->ids[i];
    ASSERT_EQ(particles->fluids[i], id < first.size() ? first[id] : 1) << id;
    (particles->fluids[i] == 1 ? oil : water) += particles->densities[i];
    (particles->fluids[i] == 1 ? ofOil : ofWater) += 1;
  }
  EXPECT_LT(oil / ofOil, 0.85 * water / ofWater) << "densities are those of the fluid";
  const auto stats = simulation->stats();
  ASSERT_TRUE(stats && stats->fluids.size() == 2);
  EXPECT_EQ(stats->fluids[0].particles, uint64_t(ofWater));
  EXPECT_EQ(stats->fluids[1].particles, uint64_t(ofOil));
  EXPECT_EQ(stats->fluids[1].ledger.filled + stats->fluids[1].ledger.emitted, uint64_t(ofOil));
  EXPECT_GT(stats->fluids[1].ledger.emitted, 0u);
  EXPECT_EQ(stats->fluids[0].ledger.emitted, 0u);
}

TEST(Simulation, PoursThroughAMeshOfAFile) {
  auto scene = parseScene(R"({
    "rill": "0.2", "domain": {"min": [-0.3, 0, -0.3], "max": [0.3, 0.6, 0.3]}, "fluid": {"spacing": 0.02},
    "emitters": [{"name": "nozzle", "mesh": {"file": "meshes/star.obj", "scale": 1.5, "translation": [0, 0.4, 0]}, "flow": 0.01,
                  "motion": [{"at": 0}, {"at": 0.5, "rotate": [0, 0.6, 0, 0.8]}]}],
    "probes": [{"name": "rate", "flow": "nozzle"}]})",
                          "star", RILL_SOURCE_DIR "/assets/scenes");
  ASSERT_TRUE(scene) << scene.error().message;
  auto simulation = open({}, *scene);
  ASSERT_TRUE(simulation);
  ASSERT_TRUE(simulation->advance(0.4));
  const auto stats = simulation->stats();
  ASSERT_TRUE(stats);
  const double layer = 1.5 * 1.5 * 0.0116 / (0.02 * 0.02);
  EXPECT_NEAR(static_cast<double>(stats->ledger.emitted), 0.01 * 0.4 / 8e-6, layer);
  EXPECT_EQ(stats->ledger.emitted, stats->particles);
  const auto particles = simulation->particles();
  ASSERT_TRUE(particles);
  for (const Float3& x : particles->positions) EXPECT_TRUE(std::abs(x.x) < 0.31F && std::abs(x.z) < 0.31F && x.y > -0.01F);
}

}  // namespace simulation_test
}  // namespace rill::offline
