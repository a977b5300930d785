// rill-capture --play: draws particles from files.
#include <gtest/gtest.h>

#include <fstream>

#include "rill/player.hpp"
#include "shared/ply.hpp"
#include "support/child_process.hpp"
#include "support/picture.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace play_test {

constexpr const char* kScene = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1.6, 0.8, 0.4]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.6, 0.5, 0.4]}}], "camera": {"eye": [2.4, 1.0, 2.0], "target": [0.75, 0.25, 0.2], "fov_y_deg": 38}
})";

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

TEST(Play, DrawsExportedFrames) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kScene).string();
  for (const char* view : {"final", "particles"}) {
    const auto run = (folder / "run").string(), played = (folder / "played").string();
    const Outcome made =
        capture({scene, "--frames", "3", "--fps", "10", "--view", view, "--export", "ply", "--size", "240x135", "--out", run, "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
    const Outcome drawn = capture({scene, "--play", run, "--fps", "10", "--view", view, "--size", "240x135", "--out", played, "--quiet"});
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_EQ(drawn.err + drawn.out, "");
    for (const char* name : {"frame_00000.png", "frame_00002.png"}) {
      const Distance apart = distance(readPicture(folder / "run" / name), readPicture(folder / "played" / name));
      EXPECT_LE(apart.mean, 0.003) << view;
      EXPECT_LE(apart.worst, 0.1) << view;
    }
  }
}

TEST(Play, AcceptsPositionsOnly) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kScene).string();
  std::filesystem::create_directories(folder / "in");
  write(folder / "in/a.ply",
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\nend_header\n0.5 0.2 0.2\n0.6 "
        "0.3 0.2\n");
  write(folder / "in/b.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n");
  write(folder / "in/b.whitewater.ply", "not read, since the scene has no look.whitewater");
  const Outcome drawn = capture({scene, "--play", (folder / "in").string(), "--size", "64x36", "--out", (folder / "out").string()});
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_NE(drawn.err.find("warning: --play: whitewater (1 of .whitewater.ply) is not drawn: look.whitewater is false"), std::string::npos)
      << drawn.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frame_00002.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/frame_00001.png"));
}

constexpr const char* kSplash = R"({
  "rill": "0.2", "domain": {"min": [0, 0, 0], "max": [1, 1.4, 0.4]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [1, 0.3, 0.4]}}, {"box": {"min": [0.3, 0.6, 0], "max": [0.7, 1, 0.4]}, "velocity": [0, -4, 0]}],
  "look": {"whitewater": true}, "camera": {"eye": [2.2, 1.4, 2.4], "target": [0.5, 0.5, 0.2], "fov_y_deg": 38}
})";

TEST(Play, DrawsExportedWhitewater) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kSplash).string();
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{scene, "--fps", "10", "--size", "240x135"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = capture(arguments, folder.string());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err;
  };
  run({"--frames", "4", "--export", "ply", "--export", "vtk", "--out", "run", "--quiet"});
  EXPECT_EQ(run({"--play", "run", "--out", "played", "--quiet"}), "");
  const auto emitted = apps::readWhitewaterPly(folder / "run/frame_00003.whitewater.ply");
  ASSERT_TRUE(emitted) << emitted.error().message;
  ASSERT_GT(emitted->positions.size(), 100u);
  EXPECT_TRUE(std::filesystem::exists(folder / "run/whitewater.pvd"));
  EXPECT_GT(std::filesystem::file_size(folder / "run/frame_00003.whitewater.vtu"), 29 * emitted->positions.size());

  std::filesystem::remove(folder / "run/frame_00003.whitewater.ply");
  run({"--play", "run", "--out", "without", "--quiet"});
  const Picture simulated = readPicture(folder / "run/frame_00003.png");
  const double missing = distance(simulated, readPicture(folder / "without/frame_00003.png")).mean;
  EXPECT_GT(missing, 0.001);
  EXPECT_LE(distance(simulated, readPicture(folder / "played/frame_00003.png")).mean, 0.2 * missing);

  std::filesystem::rename(folder / "run/frame_00002.whitewater.ply", folder / "run/other.whitewater.ply");
  EXPECT_NE(run({"--play", "run", "--out", "without"}).find("frame_00002.ply\" has no .whitewater.ply beside it"), std::string::npos);
}

TEST(Play, RefusesBadWhitewater) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kSplash).string();
  std::filesystem::create_directories(folder / "in");
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 1\n", end = "end_header\n";
  std::string place, motion;
  for (const char* name : {"x", "y", "z"}) place += std::string("property float ") + name + "\n";
  for (const char* name : {"vx", "vy", "vz"}) motion += std::string("property float ") + name + "\n";
  write(folder / "in/a.ply", head + place + end + "0.5 0.5 0.2\n");
  const auto errorOf = [&](const std::string& text) {
    write(folder / "in/a.whitewater.ply", text);
    const Outcome outcome =
        capture({scene, "--size", "64x36", "--out", (folder / "out").string(), "--quiet", "--play", (folder / "in").string()});
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  const std::string of = head + place + motion + "property uchar class\n";
  EXPECT_NE(errorOf(head + place + motion + end + "0 0 0 0 0 0\n").find("a.whitewater.ply: has no property \"class\""), std::string::npos);
  EXPECT_NE(errorOf(of + end + "0 0 0 0 0 0 3\n").find("vertex 0, property \"class\": found 3, expected 0 (spray), 1 (foam) or 2 (bubble)"),
            std::string::npos);
  EXPECT_NE(errorOf(of + end + "0 inf 0 0 0 0 1\n").find("vertex 0: the position is"), std::string::npos);
  EXPECT_NE(errorOf(of + "property float age\n" + end + "0 0 0 0 0 0 1 nan\n").find("property \"age\""), std::string::npos);
  EXPECT_NE(errorOf(of + "property float random\n" + end + "0 0 0 0 0 0 1 0.5\n").find("property \"random\": found 0.5, expected"),
            std::string::npos);
  EXPECT_NE(errorOf(of + end + "0 0 0 0 0 0").find("a.whitewater.ply"), std::string::npos) << "cut off";
  EXPECT_NE(errorOf("").find("a.whitewater.ply"), std::string::npos) << "empty";
}

TEST(Play, BlursByTheVelocitiesOfTheFiles) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kScene).string();
  const std::vector<std::string> film{"--shutter", "360", "--samples", "8", "--fps", "10", "--size", "240x135", "--quiet"};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), scene);
    arguments.insert(arguments.end(), film.begin(), film.end());
    const Outcome outcome = capture(arguments, folder.string());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  run({"--frames", "4", "--export", "ply", "--out", "run"});
  run({"--play", "run", "--out", "played"});
  const Outcome sharp = capture({scene, "--play", "run", "--fps", "10", "--size", "240x135", "--out", "sharp", "--quiet"}, folder.string());
  ASSERT_EQ(sharp.code, 0) << sharp.err;
  const Picture simulated = readPicture(folder / "run/frame_00003.png"), played = readPicture(folder / "played/frame_00003.png");
  const double blur = distance(simulated, readPicture(folder / "sharp/frame_00003.png")).mean;
  EXPECT_GT(blur, 0.0005);
  EXPECT_LE(distance(simulated, played).mean, 0.2 * blur);

  std::filesystem::create_directories(folder / "in");
  write(folder / "in/a.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n");
  const Outcome without =
      capture({scene, "--play", "in", "--shutter", "180", "--samples", "2", "--size", "64x36", "--out", "out"}, folder.string());
  EXPECT_EQ(without.code, 0) << without.err;
  EXPECT_NE(without.err.find("warning: --shutter: \"in/a.ply\" has no velocities (vx, vy, vz)"), std::string::npos) << without.err;
}

// After a full turn the image is the same again, and different in between.
TEST(Play, CameraOrbits) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kScene).string();
  std::filesystem::create_directories(folder / "in");
  for (const char* name : {"in/a.ply", "in/b.ply", "in/c.ply"})
    write(folder / name,
          "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\nend_header\n0.5 0.2 0.2\n0.6 "
          "0.3 0.2\n");
  const Outcome drawn = capture({scene, "--play", (folder / "in").string(), "--size", "160x90", "--fps", "2", "--orbit", "360", "--out",
                                 (folder / "out").string(), "--quiet"});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const Picture start = readPicture(folder / "out/frame_00000.png");
  EXPECT_LE(distance(start, readPicture(folder / "out/frame_00002.png")).mean, 1e-3);
  EXPECT_GT(distance(start, readPicture(folder / "out/frame_00001.png")).mean, 0.002);
}

TEST(Play, ErrorsNameFolderAndFile) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kScene).string();
  std::filesystem::create_directories(folder / "in");
  const auto errorOf = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{scene, "--size", "64x36", "--out", (folder / "out").string(), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = capture(arguments);
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  const std::string in = (folder / "in").string();
  EXPECT_NE(errorOf({"--play", in}).find("contains no .ply file"), std::string::npos);
  EXPECT_NE(errorOf({"--play", (folder / "nowhere").string()}).find("cannot read the folder"), std::string::npos);
  EXPECT_NE(errorOf({"--play", in, "--stats", "-"}).find("--stats: not possible with --play"), std::string::npos);
  write(folder / "in/broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n0\n");
  EXPECT_NE(errorOf({"--play", in}).find("broken.ply"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frame_00000.png"));
}

TEST(Play, RefusesFluidsThatTheSceneLacks) {
  const TemporaryFolder folder;
  const std::string scene = folder
                                .write("scene.json", R"({"rill": "0.2", "fluid": {"spacing": 0.1}, "domain": {},
                                  "fluids": [{"name": "water"}, {"name": "oil"}]})")
                                .string();
  std::filesystem::create_directories(folder / "in");
  const auto play = [&](const std::string& fluid) {
    write(folder / "in/one.ply",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty uchar fluid\n"
          "end_header\n0.5 0.5 0.5 " +
              fluid + "\n");
    return capture({scene, "--size", "64x36", "--out", (folder / "out").string(), "--quiet", "--play", (folder / "in").string()});
  };
  EXPECT_EQ(play("1").code, 0);
  const Outcome refused = play("2");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("one.ply: vertex 0, property \"fluid\": found 2, expected the index of one of the scene's fluids"),
            std::string::npos)
      << refused.err;
}

// The same in the library, with the validation layer.
TEST(Play, LibraryDrawsEveryViewCleanUnderValidation) {
  Scene scene;
  scene.fluid.spacing = 0.1;
  scene.camera = Camera{{0, 0, 4}, {0, 0, 0}, 40};
  scene.look.whitewater = true;
  offline::Options options;
  options.validation = true;
  auto player = offline::Player::open(scene, options);
  ASSERT_TRUE(player) << player.error().message;
  std::vector<Float3> positions;
  for (int i = 0; i < 1000; ++i) positions.push_back({0.1f * float(i % 10), 0.1f * float(i / 10 % 10), 0.1f * float(i / 100)});
  const Double3 origin = {-0.5, -0.5, -0.5};
  std::vector<Float3> inScene, above;
  for (const Float3& p : positions) inScene.push_back({p.x - 0.5f, p.y - 0.5f, p.z - 0.5f});
  for (const Float3& p : inScene) above.push_back({p.x, p.y + 0.6f, p.z});
  offline::DiffuseParticles white{.positions = above,
                                  .velocities = std::vector<Float3>(positions.size(), {0, 1, 0}),
                                  .ages = std::vector<float>(positions.size(), 1),
                                  .classes = std::vector<WhitewaterClass>(positions.size(), WhitewaterClass::Foam)};
  for (int round = 0; round < 2; ++round) {
    for (const std::string_view view : offline::Simulation::views()) {
      const auto image = player->render(std::string(view), 160, 90);
      ASSERT_TRUE(image) << image.error().message;
      EXPECT_EQ(image->rgba.size(), 160u * 90 * 4);
    }
    ASSERT_TRUE(player->show({.positions = positions, .origin = origin, .whitewater = white}));
  }
  const auto fromOrigin = player->render("final", 160, 90);
  ASSERT_TRUE(player->show({.positions = inScene, .whitewater = white}));
  const auto inPlace = player->render("final", 160, 90);
  ASSERT_TRUE(player->show({.positions = inScene}));
  const auto without = player->render("final", 160, 90);
  ASSERT_TRUE(fromOrigin && inPlace && without);
  const auto difference = [](const offline::Image& a, const offline::Image& b) {
    double sum = 0;
    for (size_t k = 0; k < a.rgba.size(); ++k) sum += std::abs(int(a.rgba[k]) - int(b.rgba[k]));
    return sum / double(a.rgba.size());
  };
  EXPECT_GT(difference(*inPlace, *without), 0.1);
  EXPECT_LT(difference(*inPlace, *fromOrigin), 0.05 * difference(*inPlace, *without)) << "whitewater is not relative to the origin";
  EXPECT_FALSE(player->show({.positions = positions, .velocities = {{0, 0, 0}}}));
  EXPECT_FALSE(player->show({.positions = positions, .fluids = {0}}));
  EXPECT_TRUE(player->show({.positions = positions, .fluids = std::vector<uint8_t>(positions.size(), 0)}));
  EXPECT_FALSE(player->show({.positions = positions, .fluids = std::vector<uint8_t>(positions.size(), 1)})) << "the scene has one fluid";
  white.randoms = {1, 2};
  EXPECT_FALSE(player->show({.positions = positions, .whitewater = white}));
  white.randoms.clear();
  white.classes.pop_back();
  EXPECT_FALSE(player->show({.positions = positions, .whitewater = white}));
  for (const std::string& text : player->takeValidationMessages()) ADD_FAILURE() << text;
}

}  // namespace play_test
}  // namespace rill::test
