#pragma once
// Seed inputs for fuzzing.
#include <filesystem>
#include <string>
#include <vector>

#include "support/checkpoint_seed.hpp"
#include "support/temporary_folder.hpp"
#include "support/tetrahedron_files.hpp"

namespace rill::test {

/// All scenes of assets/scenes, one with the keys of pressure and of fluid that sticks, two with those of bodies,
/// two with those of emitters and drains, one with several fluids, and one with overrides.
inline std::vector<std::string> sceneSeeds() {
  std::vector<std::string> seeds;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(RILL_SOURCE_DIR) / "assets/scenes"))
    if (entry.path().extension() == ".json" && !entry.path().filename().string().ends_with(".schema.json"))
      seeds.push_back(contentOf(entry.path()));
  std::sort(seeds.begin(), seeds.end());
  seeds.push_back(R"({"rill": "0.2", "domain": {"slip": false}, "fluid": {"spacing": 0.1, "viscosity": 5},
    "fill": [{"box": {"max": [1, 0.5, 1]}}], "solids": [{"name": "post", "box": {"max": [0.2, 0.9, 0.2]}, "slip": false},
    {"sphere": {"center": [0.6, 0.4, 0.5], "radius": 0.2}, "slip": false, "body": {"density": 300}},
    {"sphere": {"radius": 0.1}, "slip": true, "motion": [{"at": 0}, {"at": 1, "translate": [0, 1, 0]}]}],
    "probes": [{"name": "wet", "pressure": [0.5, 0.1, 0.8]}, {"name": "covered", "pressure": [0.1, 0.1, 0.1]},
      {"name": "far", "pressure": [-1e30, 0, 1e300]}]})");
  seeds.push_back(R"({"rill": "0.2", "domain": {}, "fluid": {"spacing": 0.1}, "fill": [{"box": {"max": [1, 0.5, 1]}}], "solids": [
    {"name": "crate", "box": {"max": [0.3, 0.4, 0.5]}, "rotation": [0, 0, 1, 1], "friction": 0.3, "restitution": 0.5, "body":
      {"mass": 2, "velocity": [1, 0, -1], "angular_velocity": [0, 0, 3], "locked": ["y", "rx", "ry"], "from": 0.25}},
    {"name": "ball", "sphere": {"center": [0.6, 0.7, 0.5], "radius": 0.2}, "body": {"density": 300}}],
    "probes": [{"name": "load", "load": "crate"}, {"name": "pose", "pose": "ball"}]})");
  seeds.push_back(R"({"rill": "0.2", "fluid": {"spacing": 0.1}, "solids": [
    {"mesh": {"file": "ball.obj", "scale": 0.1, "up": "z"}, "translation": [0, 1, 0], "body": {"density": 7800}}]})");
  const std::string flows = R"({"rill": "0.2", "duration": 5, "domain": {"open": ["-y", "+x"], "open_removes": true},
    "fluid": {"spacing": 0.1, "capacity": 1900}, "fill": [{"box": {"max": [1, 0.5, 1]}}],
    "solids": [{"name": "lid", "box": {"min": [0.2, 0.8, 0.2], "max": [0.9, 1, 0.9]}, "motion": [{"at": 0}, {"at": 1}]}], "emitters": [
      {"name": "tap", "disc": {"center": [0.5, 0.9, 0.5], "radius": 0.15, "normal": [0, -1, 0]}, "flow": 0.002, "from": 0.5, "until": 5},
      {"rect": {"center": [0, 0.8, 0.5], "size": [0.4, 0.2], "normal": [1, 0, 0], "up": [0, 1, 0]}, "speed": 1.5}],
    "drains": [{"name": "plug", "box": {"max": [0.1, 0.1, 0.1]}, "until": 9}, {"sphere": {"center": [0.9, 0, 0.9], "radius": 0.2}}],
    "probes": [{"name": "in", "flow": "tap"}, {"name": "out", "flow": "plug"}]})";
  seeds.push_back(flows);
  seeds.push_back(flows + '\0' + "emitters[0].flow=0.1\ndrains[0].from=1\nemitters[1].rect.size=[1e3,1e-3]\nfluid.capacity=0\nfill=[]");
  seeds.push_back(R"({"rill": "0.2", "domain": {"inflow": {"level": 0.5, "speed": 1, "fluid": "oil"}}, "fluid": {"spacing": 0.1},
    "fluids": [{"name": "water", "color": [0, 0.5, 1]}, {"name": "oil", "density": 900, "viscosity": 0.05}],
    "interfaces": [{"between": ["oil", "water"], "tension": 0.02}],
    "fill": [{"box": {"max": [1, 0.3, 1]}}, {"fluid": "oil", "box": {"min": [0, 0.3, 0], "max": [1, 0.5, 1]}}],
    "emitters": [{"disc": {"center": [0.5, 0.9, 0.5], "radius": 0.15}, "flow": 0.002, "fluid": "oil"}]})" +
                  std::string(1, '\0') + "fluids.oil.density=1200\nfluids[0].viscosity=3\nfill[0].fluid=oil");
  seeds.push_back(seeds.front() + '\0' + "fluid.viscosity=0.1\nsolver.time_step=auto\nfill[0].jitter=0.2\nprobes=[]");
  return seeds;
}

inline std::vector<std::string> plySeeds() {
  const std::string head =
      " 1.0\ncomment one\nelement vertex 2\nproperty float x\nproperty double y\nproperty float z\nproperty list uchar int n\n";
  std::string little = "ply\nformat binary_little_endian" + head + "end_header\n",
              big = "ply\nformat binary_big_endian" + head + "end_header\n";
  for (int k = 0; k < 2; ++k) {
    for (std::string* text : {&little, &big}) *text += std::string(16, static_cast<char>(k)) + '\2' + std::string(8, 'n');
  }
  return {
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty float vx\nproperty float "
      "vy\n"
      "property float vz\nend_header\n0 0.5 1e-3 0 0 0\n-1 2 3 4 5 6\n",
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty uchar fluid\n"
      "end_header\n0 0.5 1e-3 0\n-1 2 3 1\n",
      little, big};
}

/// The first letter names the format.
inline std::vector<std::string> meshSeeds() {
  GltfFile transformed;
  transformed.primitives = R"({"attributes":{"POSITION":5,"NORMAL":6},"indices":7,"mode":5,"material":0})";
  transformed.nodes =
      R"({"mesh":0,"scale":[-1,2,1],"rotation":[0,0,0,1],"translation":[1,2,3]},{"children":[0],"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,1,2,3,1]})";
  transformed.more = R"(,"scene":0,"scenes":[{"nodes":[1]}],"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1]}}])";
  return {"o" + tetrahedronObj(),
          "ov 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 0.2 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng a\nusemtl b\nf -5/1/1 -4/1/1 -3/1/1 -2/1/1 -1//1\n",
          "s" + asciiStl(),
          "s" + binaryStl(),
          "p" + asciiPly(),
          "p" + binaryPly(false),
          "p" + binaryPly(true),
          "g" + transformed.gltf(),
          "b" + GltfFile{}.glb()};
}

inline std::vector<std::string> checkpointSeeds() {
  std::vector<std::string> seeds;
  offline::Checkpoint withoutList = seedCheckpoint(), empty;
  FluidSnapshot& s = withoutList.fluid;
  s.control[offsetof(FluidControl, listState) / 4] = kListDue;
  for (auto* array : {&s.neighborCount, &s.neighbors, &s.cell}) array->clear();
  for (const offline::Checkpoint& c : {seedCheckpoint(), seedCheckpointWithBodies(), withoutList, empty}) {
    const auto bytes = offline::encodeCheckpoint(c);
    seeds.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return seeds;
}

}  // namespace rill::test
