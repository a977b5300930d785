// The fluid of each particle, from its fill or from a file, and what has mixed.
#include "two_fluids.hpp"

namespace rill::test {
namespace {

TEST(FluidsParticles, HaveTheFluidOfTheirFill) {
  const std::string fills = R"("fill": [{"fluid": "oil", "box": {"max": [0.2, 0.1, 0.1]}},
    {"box": {"min": [0, 0.5, 0], "max": [0.3, 0.6, 0.1]}}])";
  const ParticleSet set = particles(fluidScene(kTwoFluids + ", " + fills));
  EXPECT_EQ(set.fluids, (std::vector<uint8_t>{1, 1, 0, 0, 0}));
  EXPECT_TRUE(particles(fluidScene(R"("fill": [{"box": {}}])")).fluids.empty()) << "one fluid needs no array";
}

TEST(FluidsParticles, FluidsFollowTheParticlesThatAreLeft) {
  const std::string fills = R"("fill": [{"box": {"max": [0.3, 0.1, 0.1]}}, {"fluid": "oil", "box": {"max": [0.5, 0.1, 0.1]}}])";
  const ParticleSet set = particles(fluidScene(kTwoFluids + ", " + fills));
  EXPECT_EQ(set.leftOutOverlap, 3U);
  EXPECT_EQ(set.fluids, (std::vector<uint8_t>{0, 0, 0, 1, 1}));
}

TEST(FluidsParticles, AreMadeByCountToo) {
  Scene s = scene(R"({"rill": "0.2", "domain": {}, "fluid": {"particles": 1000}, )" + kTwoFluids +
                  R"(, "fill": [{"box": {"max": [1, 0.5, 1]}}, {"fluid": "oil", "box": {"min": [0, 0.5, 0], "max": [1, 1, 1]}}]})");
  const ParticleSet set = particles(s);
  ASSERT_EQ(set.fluids.size(), set.positions.size());
  for (size_t i = 0; i < set.fluids.size(); ++i) EXPECT_EQ(set.fluids[i], set.positions[i].y > 0.5F ? 1 : 0);
}

class FluidsPly : public ::testing::Test {
 protected:
  static std::string file(const std::string& type, const std::vector<std::string>& values) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(values.size()) +
                       "\nproperty float x\nproperty float y\nproperty " + type + " fluid\nproperty float z\nend_header\n";
    for (size_t i = 0; i < values.size(); ++i) text += std::to_string(i) + " 0.5 " + values[i] + " 0.5\n";
    return text;
  }
  Expected<ParticleSet> load(const std::string& bytes, const std::string& fluids, const std::string& key = "") {
    folder.write("p.ply", bytes);
    auto s = parseScene(fluidScene(fluids + R"("domain": {"max": [9, 9, 9]}, "fill": [{"particles": {"file": "p.ply"})" + key + "}]"),
                        "dam.json", folder.path);
    if (!s) return s.error();
    return makeParticles(*s, kMany);
  }
  std::string message(const std::string& bytes) {
    const auto set = load(bytes, kTwoFluids + ", ");
    return set ? "accepted" : set.error().message;
  }
  Folder folder;
};

TEST_F(FluidsPly, ReadsTheFluidOfEachParticle) {
  const auto set = load(file("uchar", {"1", "0", "1"}), kTwoFluids + ", ");
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->fluids, (std::vector<uint8_t>{1, 0, 1}));
  EXPECT_EQ(set->positions[2].x, 2);
  EXPECT_EQ(set->positions[2].z, 0.5F) << "columns after it";
}

TEST_F(FluidsPly, FilesWithoutFluidsAreOfTheFirst) {
  const std::string plain =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
  const auto set = load(plain, kTwoFluids + ", ");
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->fluids, std::vector<uint8_t>{0});
}

TEST_F(FluidsPly, TheFillsOwnFluidTakesPrecedence) {
  for (const char* value : {"0", "7"}) {
    const auto set = load(file("uchar", {value, "0"}), kTwoFluids + ", ", R"(, "fluid": "oil")");
    ASSERT_TRUE(set) << set.error().message;
    EXPECT_EQ(set->fluids, (std::vector<uint8_t>{1, 1}));
  }
}

TEST_F(FluidsPly, IsSkippedInASceneOfOneFluid) {
  const auto set = load(file("float", {"3.5", "-1"}), "");
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_TRUE(set->fluids.empty());
}

TEST_F(FluidsPly, RejectsFluidsThatTheSceneLacks) {
  const auto expected = [&](const std::string& found) {
    return "dam: fill[0].particles.file: " + (folder.path / "p.ply").string() + ": vertex 1, property \"fluid\": found " + found +
           ", expected the index of one of the scene's fluids, a whole number from 0 to 1";
  };
  EXPECT_EQ(message(file("uchar", {"1", "2"})), expected("2"));
  EXPECT_EQ(message(file("int", {"1", "-1"})), expected("-1"));
  EXPECT_EQ(message(file("float", {"1", "0.5"})), expected("0.5"));
  EXPECT_EQ(message(file("float", {"1", "nan"})), expected("nan"));
  EXPECT_EQ(message(file("list uchar uchar", {"1 1", "1 1"})), "dam: fill[0].particles.file: " + (folder.path / "p.ply").string() +
                                                                   ": the vertex property \"fluid\" is a list; expected a number");
}

/// A file of two fluids, of which the second has mixed, with or without velocities.
std::string mixedFile(const std::vector<std::string>& shares, bool velocities = false) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(shares.size());
  for (const char* name : {"x", "y", "z"}) text += std::string("\nproperty float ") + name;
  for (const char* name : {"vx", "vy", "vz"}) text += velocities ? std::string("\nproperty float ") + name : "";
  text += "\nproperty uchar fluid\nproperty float concentration1\nend_header\n";
  for (size_t i = 0; i < shares.size(); ++i)
    text += std::to_string(i) + " 0.5 0.5 " + (velocities ? "0 0 1 " : "") + "0 " + shares[i] + "\n";
  return text;
}

const std::string kMilk = R"("fluids": [{"name": "water"}, {"name": "milk", "diffusion": 1e-5}], )";

TEST_F(FluidsPly, KeepsWhatHasMixed) {
  for (const bool velocities : {false, true}) {
    const auto set = load(mixedFile({"0.25", "1.0000001", "0"}, velocities), kMilk);
    ASSERT_TRUE(set) << set.error().message;
    EXPECT_EQ(set->concentrations, (std::vector<Float4>{{0.25F, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}}));
  }
  EXPECT_TRUE(load(mixedFile({"0.25"}), kTwoFluids + ", ")->concentrations.empty()) << "no fluid diffuses";
  EXPECT_TRUE(load(mixedFile({"0.25"}), kMilk, R"(, "fluid": "milk")")->concentrations.empty()) << "the fill is all milk";
  EXPECT_TRUE(load(file("uchar", {"1", "0"}), kMilk)->concentrations.empty()) << "the file has none";
}

TEST_F(FluidsPly, FluidsThatTheFileLacksHaveNotMixed) {
  const auto set = load(mixedFile({"0.25"}), R"("fluids": [{"name": "ink", "diffusion": 1}, {"name": "milk", "diffusion": 1e-5}], )");
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->concentrations, (std::vector<Float4>{{1, 0.25F, 0, 0}}));
}

TEST_F(FluidsPly, OtherFillsHaveNotMixed) {
  folder.write("p.ply", mixedFile({"0.25"}));
  auto s = parseScene(fluidScene(kMilk + R"("fill": [{"box": {"min": [4, 0, 0], "max": [4.1, 0.1, 0.1]}, "fluid": "milk"},
      {"particles": {"file": "p.ply"}}])"),
                      "dam.json", folder.path);
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(particles(*s).concentrations, (std::vector<Float4>{{1, 0, 0, 0}, {0.25F, 0, 0, 0}}));
}

TEST_F(FluidsPly, RejectsConcentrationsOutsideOfZeroToOne) {
  for (const char* bad : {"-0.1", "1.01", "nan", "inf"}) {
    const auto set = load(mixedFile({"0.5", bad}), kMilk);
    ASSERT_FALSE(set) << bad;
    EXPECT_EQ(set.error().message, "dam: fill[0].particles.file: " + (folder.path / "p.ply").string() +
                                       ": vertex 1, property \"concentration1\": found " + bad + ", expected a number from 0 to 1");
  }
}

}  // namespace
}  // namespace rill::test
