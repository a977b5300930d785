#include "bench/suites/feature_cases.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/mesh_shapes.hpp"

namespace rill::bench {
namespace {

const Overrides kBase = {{"solver.time_step", "0.00083333333"},
                         {"solver.tolerance", "0"},
                         {"solver.cfl", "10"},
                         {"fluid.tensile", "0"},
                         // Fast enough for a list build about every eleven substeps, as in a complete dam break.
                         {"fill[0].velocity", "[8, 0, 0]"}};

constexpr const char* kBox = R"([{"box": {"min": [2.6, 0, 0.3], "max": [2.9, 0.6, 0.7]}}])";
constexpr const char* kNamedBox = R"([{"name": "box", "box": {"min": [2.6, 0, 0.3], "max": [2.9, 0.6, 0.7]}}])";
constexpr const char* kBody = R"([{"box": {"min": [2.6, 0, 0.3], "max": [2.9, 0.6, 0.7]}, "body": {"density": 500}}])";
constexpr const char* kLoad = R"([{"name": "load", "load": "box"}])";
constexpr const char* kPressure = R"([{"name": "pressure", "pressure": [0.5, 0.2, 0.5]}])";
constexpr const char* kTap = R"([{"disc": {"center": [4, 2.5, 0.5], "radius": 0.1, "normal": [0, -1, 0]}, "speed": 1}])";
constexpr const char* kMovingTap =
    R"([{"disc": {"center": [4, 2.5, 0.5], "radius": 0.1, "normal": [0, -1, 0]}, "speed": 1, "motion": [{"at": 0}, {"at": 1, "translate": [0.5, 0, 0]}]}])";
constexpr const char* kInflow = R"({"side": "-x", "level": 0.2, "speed": 1})";
constexpr const char* kOutflow = R"({"side": "+x", "level": 3.5})";
constexpr const char* kDrain = R"([{"box": {"min": [4.8, 3, 0.3], "max": [4.9, 3.1, 0.7]}}])";
constexpr const char* kNoSlipBox = R"([{"box": {"min": [2.6, 0, 0.3], "max": [2.9, 0.6, 0.7]}, "slip": false}])";
constexpr const char* kDistantBox = R"([{"box": {"min": [4.6, 3, 0.3], "max": [4.9, 3.6, 0.7]}}])";
constexpr const char* kSphere = R"([{"sphere": {"center": [2.8, 0.3, 0.5], "radius": 0.25}}])";
constexpr const char* kMoving =
    R"([{"box": {"min": [2.6, 0, 0.3], "max": [2.9, 0.6, 0.7]}, "motion": [{"at": 0}, {"at": 1, "translate": [0.5, 0, 0]}]}])";

constexpr const char* kFluids = R"([{"name": "water"}, {"name": "oil", "density": 900}])";  // all of the base scene is water
constexpr const char* kInterface = R"([{"between": ["water", "oil"], "tension": 0.02}])";
constexpr const char* kDiffusing = R"([{"name": "water"}, {"name": "milk", "diffusion": 0.001}])";

/// The ball of kSphere as a mesh.
Solid meshBall() {
  Solid solid{.translation = {2.8, 0.3, 0.5}};
  if (auto mesh = Mesh::create(ballMesh(0.25, 5))) solid.shape = MeshShape{.mesh = *std::move(mesh)};
  return solid;
}

/// 36 boxes of three spacings, four and five apart, in the fluid of the base scene; each is `what`, too.
std::string manyBoxes(const std::string& what) {
  constexpr double kSpacing = 1.0 / 12;
  nlohmann::json boxes = nlohmann::json::array();
  for (int n = 0; n < 36; ++n) {
    const std::array<double, 3> low{(1 + n % 6 * 5) * kSpacing, (19 + n / 6 % 2 * 5) * kSpacing, n / 12 * 4 * kSpacing};
    nlohmann::json box = nlohmann::json::parse(what);
    for (const double x : low) {
      box["box"]["min"].push_back(x);
      box["box"]["max"].push_back(x + 3 * kSpacing);
    }
    boxes.push_back(std::move(box));
  }
  return boxes.dump();
}

}  // namespace

std::vector<Feature> features() {
  return {
      {"viscosity", {{"fluid.viscosity", "1"}}, {{"fluid.viscosity", "0"}}},
      {"viscosity, no-slip walls",
       {{"rill", "\"0.2\""}, {"fluid.viscosity", "1"}, {"domain.slip", "false"}},
       {{"rill", "\"0.2\""}, {"domain.slip", "false"}}},
      {"viscosity, no-slip box", {{"rill", "\"0.2\""}, {"fluid.viscosity", "1"}, {"solids", kNoSlipBox}}},
      {"yield stress",
       {{"rill", "\"0.2\""}, {"fluid.viscosity", "1"}, {"fluid.yield_stress", "20"}},
       {{"rill", "\"0.2\""}, {"fluid.yield_stress", "0"}, {"fluid.flow_index", "0.5"}}},
      {"vorticity", {{"fluid.vorticity", "0.2"}}, {{"fluid.vorticity", "0"}}},
      {"drag", {{"rill", "\"0.2\""}, {"fluid.drag", "0.5"}}, {{"rill", "\"0.2\""}, {"fluid.drag", "0"}}},
      // When it is off, its other settings must have no effect.
      {"tensile", {{"fluid.tensile", "0.5"}}, {{"fluid.tensile", "0"}, {"fluid.tensile_radius", "0.4"}, {"fluid.tensile_power", "2"}}},
      {"several fluids", {{"rill", "\"0.2\""}, {"fluids", kFluids}}, {{"rill", "\"0.2\""}, {"fluids", "[]"}}},
      {"diffusion", {{"rill", "\"0.2\""}, {"fluids", kDiffusing}}},
      {"surface tension",
       {{"rill", "\"0.2\""}, {"fluid.surface_tension", "0.072"}},
       {{"rill", "\"0.2\""}, {"fluid.surface_tension", "0"}, {"fluid.contact_angle", "30"}}},
      {"interfaces",
       {{"rill", "\"0.2\""}, {"fluids", kFluids}, {"fluid.surface_tension", "0.072"}, {"interfaces", kInterface}},
       {{"rill", "\"0.2\""}, {"interfaces", "[]"}}},
      {"solid box", {{"solids", kBox}}, {{"solids", "[]"}}},
      {"solid out of reach", {{"solids", kDistantBox}}},  // without a solid it equals "solid box" off
      {"solid sphere", {{"solids", kSphere}}},
      {.name = "mesh of 8,192 triangles", .on = {}, .off = {{"solids", "[]"}}, .solid = meshBall()},
      {"moving solid", {{"solids", kMoving}}},
      {"load on a solid", {{"rill", "\"0.2\""}, {"solids", kNamedBox}, {"probes", kLoad}}},
      {"36 boxes", {{"solids", manyBoxes("{}")}}, {{"solids", "[]"}}},
      {"36 floating boxes",
       {{"rill", "\"0.2\""}, {"solids", manyBoxes(R"({"body": {"density": 500}})")}},
       {{"rill", "\"0.2\""}, {"solids", "[]"}}},
      {"floating box", {{"rill", "\"0.2\""}, {"solids", kBody}}, {{"rill", "\"0.2\""}, {"solids", "[]"}}},
      {"pressure at a point", {{"rill", "\"0.2\""}, {"probes", kPressure}}, {{"rill", "\"0.2\""}, {"probes", "[]"}}},
      {"tap", {{"rill", "\"0.2\""}, {"emitters", kTap}}, {{"rill", "\"0.2\""}, {"emitters", "[]"}}},
      {"tap that moves", {{"rill", "\"0.2\""}, {"emitters", kMovingTap}}},
      {"inflow and outflow", {{"rill", "\"0.2\""}, {"domain.inflow", kInflow}, {"domain.outflow", kOutflow}}},
      {"drain", {{"rill", "\"0.2\""}, {"drains", kDrain}}, {{"rill", "\"0.2\""}, {"drains", "[]"}}},
      {"open side that removes", {{"rill", "\"0.2\""}, {"domain.open", R"(["+y"])"}, {"domain.open_removes", "true"}}},
      {"3 iterations", {{"solver.iterations", "3"}, {"solver.warm_start", "0.02"}}, {{"solver.iterations", "1"}}},
      {"no artificial viscosity", {{"solver.artificial_viscosity", "0"}}},  // its dispatches are empty at the speeds of the base scene
      {"no warm start", {{"solver.warm_start", "0"}}},
      {"poly6 and spiky", {{"solver.kernel", "poly6_spiky"}}, {{"solver.kernel", "wendland"}}},
      {"grid, no list", {{"solver.neighbors", "grid"}}, {{"solver.neighbors", "list"}}},
      {"gravity changes", {{"gravity_changes", R"([{"at": 0.02, "value": [3, -9.81, 0]}])"}}, {{"gravity_changes", "[]"}}},
      {"whitewater", {{"rill", "\"0.2\""}, {"look.whitewater", "true"}}, {{"rill", "\"0.2\""}, {"look.whitewater", "false"}}},
      {.name = "pass times", .on = {}, .passTimes = true},
      {.name = "figures", .on = {}, .measuresFigures = true},
  };
}

const Overrides& baseChanges() { return kBase; }

std::vector<PassScene> passScenes() {
  return {
      {"empty", "empty"},
      {"resting", "resting-column"},
      {"no walls", "zero-gravity-drop"},
      {"no solids", "dam10k"},
      {"everything", "dam10k", {{"fluid.viscosity", "1"}, {"fluid.vorticity", "0.2"}, {"solver.iterations", "3"}, {"solids", kMoving}}},
  };
}

}  // namespace rill::bench
