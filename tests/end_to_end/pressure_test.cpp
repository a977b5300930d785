// Probes of pressure in the figures of rill-capture.
#include <gtest/gtest.h>

#include <string>

#include "support/small_dam.hpp"

namespace rill::test {
namespace pressure_figures_test {

/// The fluid of the small dam between walls on all sides, at rest around a step on the floor.
class PressureFigures : public SmallDam {
 protected:
  void SetUp() override {
    scene = folder
                .write("tank.json", R"({
    "rill": "0.2", "duration": 0.5,
    "domain": {"min": [0, 0, 0], "max": [0.5, 1, 0.3]},
    "fluid": {"spacing": 0.05},
    "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}],
    "solids": [{"box": {"min": [0.35, 0, 0], "max": [0.5, 0.15, 0.3]}}],
    "probes": [{"name": "deep", "pressure": [0.2, 0.15, 0.15]}, {"name": "air", "pressure": [0.2, 0.8, 0.15]},
               {"name": "inside", "pressure": [0.45, 0.05, 0.15]}]
  })")
                .string();
  }
  Outcome runTank(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"--fps", "10", "--frames", "6", "--no-images"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(PressureFigures, StatsHavePressuresInWaterAirAndSolids) {
  const Outcome outcome = runTank({"--stats", "s.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json frames = stats("s.json")["frames"];
  ASSERT_EQ(frames.size(), 6u);
  for (size_t k = 0; k < frames.size(); ++k) {
    const Json& probes = frames[k]["probes"];
    ASSERT_EQ(probes.size(), 3u) << k;
    EXPECT_EQ(probes["deep"].get<double>() > 0, k > 0) << "nothing has been measured at the start: " << probes;
    EXPECT_EQ(probes["air"], 0.0) << k;
    EXPECT_TRUE(probes["inside"].is_null()) << k << ": " << probes;
  }
  const double weight = 1000 * 9.81 * (0.5 - 0.15);
  EXPECT_NEAR(frames.back()["probes"]["deep"].get<double>(), weight, 0.3 * weight) << "Pa";
}

TEST_F(PressureFigures, AreFiguresOfRequirements) {
  const Outcome held = runTank({"--require", "probes.deep>1500", "probes.deep<6000", "probes.air<=0"});
  ASSERT_EQ(held.code, 0) << held.err;
  const size_t at = held.out.find("\nprobes.deep ");
  ASSERT_NE(at, std::string::npos) << held.out;
  EXPECT_TRUE(held.out.substr(0, held.out.find('\n', at + 1)).ends_with(" Pa")) << held.out;
  const Outcome low = runTank({"--quiet", "--require", "probes.deep>1e6"});
  EXPECT_EQ(low.code, 3);
  EXPECT_NE(low.err.find("\"probes.deep>1e6\" does not hold: probes.deep is "), std::string::npos) << low.err;
  const Outcome covered = runTank({"--quiet", "--require", "probes.inside>=0"});
  EXPECT_EQ(covered.code, 3);
  EXPECT_NE(covered.err.find("probes.inside is undefined here"), std::string::npos) << covered.err;
}

TEST_F(PressureFigures, InvalidProbesAreRefusedByKey) {
  struct Case {
    const char *setting, *words;
  };
  for (const Case& c : {Case{"probes[1].pressure=[1,2]", "probes[1].pressure"}, Case{"probes[2].pressure=3", "probes[2].pressure"},
                        Case{"probes[0].front=\"+x\"", "probes[0]"},
                        Case{"rill=\"0.1\"", "probes[0].pressure: the scene says \"rill\": \"0.1\"; the key needs \"rill\": \"0.2\""}}) {
    const Outcome outcome = runTank({"--set", c.setting});
    EXPECT_EQ(outcome.code, 2) << c.setting << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(c.words), std::string::npos) << c.setting << ": " << outcome.err;
  }
}

}  // namespace pressure_figures_test
}  // namespace rill::test
