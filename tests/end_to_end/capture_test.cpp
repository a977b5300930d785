// rill-capture end to end, on the driver that the environment selects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "rill/mesh.hpp"
#include "rill/particles.hpp"
#include "rill/scene_io.hpp"
#include "support/small_dam.hpp"

namespace rill::test {
namespace capture_test {

using CaptureTest = SmallDam;

TEST_F(CaptureTest, DamBreakIsPlausible) {
  const Outcome outcome = run({"--fps", "40", "--no-images", "--stats", "stats.json", "--require", "outside<1", "non_finite<1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = stats("stats.json");
  ASSERT_EQ(json["frames"].size(), 21u) << "0.5 s at 40 fps, both ends";
  double highest = 0, previousTime = -1;
  const double start = json["frames"][0]["kinetic_J"].get<double>() + json["frames"][0]["potential_J"].get<double>();
  for (size_t k = 0; k < json["frames"].size(); ++k) {
    const Json& frame = json["frames"][k];
    EXPECT_NEAR(frame["time_s"].get<double>(), double(k) / 40, 1e-12);
    EXPECT_GT(frame["time_s"].get<double>(), previousTime);
    previousTime = frame["time_s"];
    EXPECT_EQ(frame["particles"], 600);
    EXPECT_EQ(frame["outside"], 0);
    EXPECT_EQ(frame["non_finite"], 0);
    EXPECT_EQ(frame["loop_bound_hits"], 0);
    EXPECT_EQ(frame["time_dropped_s"], 0.0);
    EXPECT_EQ(frame["substeps"].get<int>() > 0, k > 0);
    EXPECT_TRUE(frame["max_speed"].is_number());
    for (const double x : frame["centre_of_mass"]) EXPECT_TRUE(std::isfinite(x));
    highest = std::max(highest, frame["kinetic_J"].get<double>() + frame["potential_J"].get<double>());
  }
  EXPECT_LE(highest, 1.002 * start);
  EXPECT_NEAR(json["energy"]["ratio"].get<double>(), highest / start, 1e-6);
  EXPECT_LT(json["density_error"]["mean"].get<double>(), 0.001);
  EXPECT_GT(json["frames"].back()["front_m"].get<double>(), 0.8) << "the front has traveled";
  EXPECT_NEAR(json["frames"][0]["front_m"].get<double>(), 0.5, 1e-4);
  EXPECT_NEAR(json["frames"][0]["probes"]["front"].get<double>(), 0.5, 1e-4);
  EXPECT_NEAR(json["frames"][0]["probes"]["H1"].get<double>(), 0.5, 1e-4);
  EXPECT_EQ(json["frames"][0]["potential_J"].get<double>() > 0, true) << "gravity is known at the start";
}

TEST_F(CaptureTest, RunsAreBitwiseEqual) {
  ASSERT_EQ(run({"--frames", "6", "--fps", "20", "--no-images", "--stats", "a.json"}).code, 0);
  ASSERT_EQ(run({"--frames", "6", "--fps", "20", "--out", "pictures", "--size", "64x36", "--stats", "b.json"}).code, 0);
  Json a = stats("a.json"), b = stats("b.json");
  std::set<std::string> hashes;
  for (size_t k = 0; k < 6; ++k) {
    for (Json* frame : {&a["frames"][k], &b["frames"][k]})
      for (const char* key : {"wall_s", "pass_ms", "skipped"}) frame->erase(key);  // pictures have passes of their own
    EXPECT_EQ(a["frames"][k], b["frames"][k]) << k;
    hashes.insert(a["frames"][k]["state_hash"].get<std::string>());
  }
  EXPECT_EQ(hashes.size(), 6u) << "the state changes from frame to frame";
}

TEST_F(CaptureTest, WritesImagesParticlesAndFigures) {
  ASSERT_EQ(capture({scene, "--frames", "3", "--size", "96x54", "--out", "made/here", "--export", "ply", "--stats", "also/made/s.json"},
                    folder.string())
                .code,
            0);
  EXPECT_EQ(TemporaryFolder::namesIn(folder / "made/here"),
            (std::vector<std::string>{"frame_00000.ply", "frame_00000.png", "frame_00001.ply", "frame_00001.png", "frame_00002.ply",
                                      "frame_00002.png"}));
  expectCompletePng(folder / "made/here/frame_00002.png");
  const std::string ply = contentOf(folder / "made/here/frame_00002.ply");
  EXPECT_NE(ply.find("element vertex 600\n"), std::string::npos);
  EXPECT_NE(ply.find("comment time 0.03333333333333333\n"), std::string::npos);
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 600 * 32);
  EXPECT_EQ(stats("also/made/s.json")["frames"].size(), 3u);
}

TEST_F(CaptureTest, WritesPosesOfSolids) {
  const char* solids =
      R"(solids=[{"name": "crate, \"red\"", "box": {"min": [0.7, 0.8, 0.1], "max": [0.8, 0.9, 0.2]}, "body": {"density": 500}},
                          {"sphere": {"center": [0.6, 0.8, 0.1], "radius": 0.05}, "motion": [{"at": 0}, {"at": 1, "translate": [0, 0.5, 0]}]}])";
  ASSERT_EQ(run({"--set", "rill=\"0.2\"", "--set", solids, "--frames", "3", "--fps", "10", "--no-images", "--export", "poses", "--export",
                 "ply", "--out", "moved"})
                .code,
            0);
  EXPECT_TRUE(std::filesystem::exists(folder / "moved/frame_00002.ply"));
  std::istringstream table(contentOf(folder / "moved/poses.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(table, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 7u) << "a header, and two solids in three frames";
  EXPECT_TRUE(lines[0].starts_with("frame,time_s,solid,name,x_m,y_m,z_m,qx,qy,qz,qw,")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("0,0,0,\"crate, \"\"red\"\"\",0.75")) << lines[1];
  EXPECT_TRUE(lines[6].starts_with("2,0.2,1,,0.6,0.90000")) << lines[6];
  const std::string place = lines[5].substr(lines[5].find("\",") + 2);
  EXPECT_NEAR(std::stod(place.substr(place.find(',') + 1)), 0.85 - 0.5 * 9.81 * 0.04, 0.01) << "the crate falls: " << lines[5];
}

TEST_F(CaptureTest, WritesSurfacesAndVtkFiles) {
  const auto write = [&](const char* out) {
    return run(
        {"--frames", "2", "--fps", "10", "--no-images", "--export", "mesh", "--export", "vtk", "--mesh-format", "vtp", "--out", out});
  };
  const Outcome first = write("a");
  ASSERT_EQ(first.code, 0) << first.err;
  ASSERT_EQ(write("b").code, 0);
  EXPECT_EQ(TemporaryFolder::namesIn(folder / "a"),
            (std::vector<std::string>{"frame_00000.mesh.vtp", "frame_00000.vtu", "frame_00001.mesh.vtp", "frame_00001.vtu", "mesh.pvd",
                                      "particles.pvd"}));
  for (const std::string& name : TemporaryFolder::namesIn(folder / "a"))
    EXPECT_TRUE(contentOf(folder / "a" / name) == contentOf(folder / "b" / name)) << name;
  EXPECT_NE(contentOf(folder / "a/mesh.pvd").find("<DataSet timestep=\"0.1\" part=\"0\" file=\"frame_00001.mesh.vtp\"/>"),
            std::string::npos);
  EXPECT_NE(contentOf(folder / "a/particles.pvd").find("file=\"frame_00001.vtu\""), std::string::npos);
}

TEST_F(CaptureTest, SurfaceIsTheClosedMeshOfASolid) {
  ASSERT_EQ(run({"--frames", "1", "--no-images", "--export", "mesh", "--mesh-format", "glb", "--out", "."}).code, 0);
  std::ofstream(folder / "tank.json") << R"({"rill": "0.2", "domain": {"min": [-1, -1, -1], "max": [3, 3, 3]}, "fluid": {"spacing": 0.1},
    "solids": [{"mesh": {"file": "frame_00000.mesh.glb"}}]})";
  const auto read = loadScene(folder / "tank.json");
  ASSERT_TRUE(read) << read.error().message;
  const auto start = loadScene(scene);
  ASSERT_TRUE(start) << start.error().message;
  const auto particles = makeParticles(*start);
  ASSERT_TRUE(particles);
  const double fluid = double(particles->positions.size()) * std::pow(particles->spacing, 3);
  EXPECT_NEAR(std::get<MeshShape>(read->solids.at(0).shape).mesh->volume(), fluid, 0.015 * fluid);  // edges are round
}

TEST_F(CaptureTest, ExplainListsRunAndSkippedPasses) {
  const Outcome outcome = run({"--frames", "2", "--no-images", "--explain"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("density "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("skipped: viscosity is 0"), std::string::npos) << outcome.out;
}

// Transparent and opaque fluids cast a shadow, in a pass of its own.
TEST_F(CaptureTest, ThicknessAndShadowAreSeparatePasses) {
  for (const bool opaque : {false, true}) {
    const std::string preset = opaque ? "look.preset=clay" : "look.preset=water";
    ASSERT_EQ(run({"--frames", "1", "--size", "64x36", "--quiet", "--set", preset, "--stats", "s.json", "--out", preset}).code, 0);
    const Json frame = stats("s.json")["frames"].back();
    EXPECT_TRUE(frame["pass_ms"].contains("fluid shadow")) << frame;
    EXPECT_FALSE(frame["skipped"].contains("fluid shadow")) << frame;
    EXPECT_EQ(frame["pass_ms"].contains("fluid thickness"), !opaque) << frame;
    EXPECT_EQ(frame["skipped"].value("fluid thickness", ""), opaque ? "the look is opaque" : "") << frame;
  }
}

TEST_F(CaptureTest, NoShadowWithoutFloor) {
  ASSERT_EQ(run({"--frames", "1", "--size", "64x36", "--quiet", "--set", R"(domain.open=["-y"])", "--stats", "s.json"}).code, 0);
  const Json frame = stats("s.json")["frames"].back();
  EXPECT_FALSE(frame["pass_ms"].contains("fluid shadow")) << frame;
  EXPECT_EQ(frame["skipped"].value("fluid shadow", ""), "there is nothing that it falls on") << frame;
  EXPECT_TRUE(frame["pass_ms"].contains("fluid shade")) << frame;
}

TEST_F(CaptureTest, NoPassTimesOmitsTimes) {
  ASSERT_EQ(run({"--frames", "2", "--no-images", "--stats", "timed.json"}).code, 0);
  EXPECT_GT(stats("timed.json")["frames"][1]["pass_ms"]["density"].get<double>(), 0);
  const Outcome outcome = run({"--frames", "2", "--no-images", "--no-pass-times", "--explain", "--stats", "plain.json"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_EQ(stats("plain.json")["frames"][1]["pass_ms"], Json::object());
  EXPECT_NE(outcome.out.find("density "), std::string::npos) << "what ran is told all the same: " << outcome.out;
}

TEST_F(CaptureTest, RendersEmptyScene) {
  const std::string empty =
      folder.write("none.json", R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {"min": [0,0,0], "max": [1,1,1]}})").string();
  const Outcome outcome = capture({empty, "--frames", "3", "--size", "64x36", "--export", "ply", "--stats", "s.json"}, folder.string());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = stats("s.json");
  EXPECT_EQ(json["particles"], 0);
  ASSERT_EQ(json["frames"].size(), 3u);
  EXPECT_EQ(json["frames"][2]["density_error_mean"], 0.0);
  EXPECT_EQ(json["frames"][2]["front_m"], 0.0);
  EXPECT_FALSE(json["frames"][2]["skipped"].empty());
  expectCompletePng(folder / "out/none/frame_00002.png");
  EXPECT_NE(contentOf(folder / "out/none/frame_00000.ply").find("element vertex 0\n"), std::string::npos);
}

TEST_F(CaptureTest, EveryShippedSceneRuns) {
  const std::filesystem::path scenes = std::filesystem::path(RILL_SOURCE_DIR) / "assets/scenes";
  size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".json" || file.filename().string().ends_with(".schema.json")) continue;
    ++count;
    const std::string name = file.lexically_relative(scenes).replace_extension().generic_string();
    std::vector<std::string> arguments = {name,           "--frames",         "2", "--no-images", "--quiet", "--require", "outside<1",
                                          "non_finite<1", "time_dropped_s<=0"};
    const auto read = loadScene(file);
    ASSERT_TRUE(read) << read.error().message;
    // The viewer's tests open each at its full size. Without a fill there is no spacing for so many.
    if (!read->fill.empty()) arguments.insert(arguments.end(), {"--particles", "2000"});
    const Outcome outcome = capture(arguments, folder.string());
    EXPECT_EQ(outcome.code, 0) << name << ": " << outcome.err;
  }
  EXPECT_GE(count, 10u);
}

TEST_F(CaptureTest, DroppedTimeIsReported) {
  ASSERT_EQ(
      run({"--frames", "13", "--fps", "60", "--no-images", "--stats", "s.json", "--set", "solver.max_substeps=2", "solver.cfl=0.05"}).code,
      0);
  const Json json = stats("s.json");
  EXPECT_GT(json["frames"][12]["time_dropped_s"].get<double>(), 0.0);
  EXPECT_EQ(json["frames"][12]["substeps"], 2);
}

}  // namespace capture_test
}  // namespace rill::test
