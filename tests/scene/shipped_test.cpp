#include <map>

#include "support.hpp"

namespace rill::test {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(RILL_SOURCE_DIR) / "assets/scenes";

/// Particle counts of all shipped scenes. Scenes that are not listed fail the test below.
const std::map<std::string, size_t> kCounts{{"bowl", 12533},
                                            {"box-and-sphere", 30000},
                                            {"crown", 32696},
                                            {"dam-break", 30000},
                                            {"dam10k", 10800},
                                            {"dam50k", 50000},
                                            {"double-dam", 37500},
                                            {"drop", 28693},
                                            {"drops-on-a-plate", 3744},
                                            {"duck-in-a-tub", 32815},
                                            {"empty", 0},
                                            {"floating-crates", 49248},
                                            {"fountain", 9500},
                                            {"honey", 0},
                                            {"lake", 28800},
                                            {"lava-lamp", 10240},
                                            {"milk-in-water", 22000},
                                            {"oil-and-water", 20541},
                                            {"resting-column", 8000},
                                            {"river", 0},
                                            {"slump", 2916},
                                            {"tap-and-plug", 0},
                                            {"waterwheel", 30000},
                                            {"zero-gravity-drop", 4224},
                                            {"validation/martin-moyce-1", 6912},
                                            {"validation/martin-moyce-2", 8000}};

TEST(Shipped, HaveExpectedParticleCounts) {
  size_t seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kScenes)) {
    const std::string file = entry.path().lexically_relative(kScenes).replace_extension().string();
    if (entry.path().extension() != ".json" || file == "scene.schema") continue;
    SCOPED_TRACE(file);
    ++seen;
    auto loaded = loadScene(entry.path());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_FALSE(loaded->title.empty());
    EXPECT_FALSE(loaded->about.empty());
    EXPECT_TRUE(loaded->camera);
    const ParticleSet set = particles(*loaded);
    EXPECT_TRUE(set.warnings.empty()) << set.warnings.front();
    ASSERT_TRUE(kCounts.contains(file)) << "add it to the list above";
    EXPECT_EQ(set.positions.size(), kCounts.at(file));
  }
  EXPECT_EQ(seen, kCounts.size());
}

TEST(Shipped, Dam50kKeepsItsBenchmarkSetup) {
  const auto s = loadScene(kScenes / "dam50k.json");
  ASSERT_TRUE(s);
  EXPECT_EQ(s->fluid.spacing, 0.05);
  EXPECT_EQ(s->fluid.viscosity, 0);
  EXPECT_EQ(s->duration, 2);
  EXPECT_EQ(s->gravity[1], -9.81);
  EXPECT_EQ(s->domain->max[0], 5);
  EXPECT_EQ(s->domain->max[1], 4);
  EXPECT_EQ(s->domain->open, 0);
  EXPECT_EQ(std::get<BoxShape>(s->fill[0].shape).max[1], 2.5);
}

}  // namespace
}  // namespace rill::test
