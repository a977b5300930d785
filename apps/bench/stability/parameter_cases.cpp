// Each key of fluid and solver at its minimum and maximum, from the parser's field table; then random combinations.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bench/mesh_shapes.hpp"
#include "bench/stability/stress_case.hpp"
#include "fluid/flows.hpp"
#include "model/fields.hpp"

namespace rill::bench {
namespace {

Scene smallDam() {
  Scene scene = tankScene(0.05, {0.3, 0.5, 0.3}, {0.8, 0.8, 0.3});
  scene.fluid.vorticity = 0;
  return scene;
}

/// Replacements for open and missing limits.
constexpr double kSmall = 1e-6, kLarge = 1e6;

double lowest(const model::Range& r) {
  const double low = r.hasLow() ? r.low : -kLarge;
  return r.low_open ? low + kSmall : low;
}
double highest(const model::Range& r) {
  const double high = r.hasHigh() ? r.high : kLarge;
  return r.high_open ? high - kSmall : high;
}

/// Sets a field as a scene file would.
template <class Owner, class Value>
void set(Owner& owner, const model::Field<Owner, Value>& field, double value) {
  if constexpr (std::is_same_v<Value, std::optional<double>> || std::is_same_v<Value, double>)
    owner.*field.member = value;
  else if constexpr (std::is_integral_v<Value>)
    owner.*field.member = static_cast<Value>(std::llround(value));
  else if constexpr (std::is_enum_v<Value>)
    owner.*field.member = static_cast<Value>(std::llround(value));
}

/// Of a field, as set() takes it; NaN of others.
template <class Owner, class Value>
double numberOf(const Owner& owner, const model::Field<Owner, Value>& field) {
  if constexpr (std::is_same_v<Value, std::optional<double>>)
    return (owner.*field.member).value_or(std::numeric_limits<double>::quiet_NaN());
  else if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
    return static_cast<double>(owner.*field.member);
  else
    return std::numeric_limits<double>::quiet_NaN();
}

/// Excludes keys that define the resolution of the scene, and the memory that it takes.
bool isTested(std::string_view key) { return key != "spacing" && key != "particles" && key != "capacity"; }

/// Keys that random scenes get further below.
bool isDrawnLater(std::string_view key) {
  return key == "surface_tension" || key == "contact_angle" || key == "yield_stress" || key == "flow_index";
}

/// Of a drop of one particle, m/s.
double capillarySpeed(const Scene& scene) {
  double square = 0;
  for (const ResolvedFluid& fluid : resolvedFluids(scene))
    square = std::max(square, fluid.surfaceTension / (fluid.density * scene.fluid.spacing));
  return std::sqrt(square);
}

template <class Owner>
void addExtremes(std::vector<StressCase>& cases, const std::string& owner, Owner Scene::*part) {
  model::forEachField<Owner>([&](const auto& field) {
    if (!isTested(field.info.key)) return;
    const bool words = !field.info.words.empty();
    const double ends[] = {words ? 0 : lowest(field.info.range), words ? double(field.info.words.size() - 1) : highest(field.info.range)};
    for (const double value : ends) {
      Scene scene = smallDam();
      if (field.info.key.starts_with("tensile_")) scene.fluid.tensile = 1;  // enables artificial pressure, which these keys shape
      if (field.info.key == "contact_angle") scene.fluid.surface_tension = 1;
      if (field.info.key == "flow_index") scene.fluid.viscosity = 1;
      set(scene.*part, field, value);
      const std::string shown = words ? std::string(field.info.words[static_cast<size_t>(value)]) : number(value, 7);
      std::string name = owner + ".";
      name.append(field.info.key).append("=").append(shown);
      StressCase c{.name = std::move(name), .scene = scene};
      c.duration_s = scene.solver.iterations > 100 ? 0.05 : 0.25;
      c.maxSpeed = speedBound(scene) + 4 * capillarySpeed(scene);
      c.externalWork = capillarySpeed(scene) > 0;  // the energy of a surface is not measured
      c.mayBeRejected = true;
      c.fullOnly = value == ends[0] && numberOf(smallDam().*part, field) == value;  // as it is without
      cases.push_back(std::move(c));
    }
  });
}

/// A ball or a box, or, half of them, a sheet of some of its triangles.
Solid randomMesh(std::mt19937_64& random, const Double3& at, double size) {
  MeshData data = random() % 2 == 0 ? ballMesh(size, 2) : boxMesh({-size, -size, -size}, {size, size, size});
  const bool sheet = random() % 2 == 0;
  if (sheet) data.triangles.resize(1 + random() % data.triangles.size());
  Solid solid;
  solid.translation = at;
  if (auto mesh = Mesh::create(std::move(data), sheet)) solid.shape = MeshShape{.two_sided = sheet, .mesh = *std::move(mesh)};
  return solid;
}

bool isSheet(const Solid& solid) {
  const auto* mesh = std::get_if<MeshShape>(&solid.shape);
  return mesh && mesh->two_sided;
}

}  // namespace

std::vector<StressCase> parameterCases() {
  std::vector<StressCase> cases;
  addExtremes<FluidSettings>(cases, "fluid", &Scene::fluid);
  addExtremes<SolverSettings>(cases, "solver", &Scene::solver);
  return cases;
}

std::vector<StressCase> randomCases(uint64_t first, uint64_t count) {
  std::vector<StressCase> cases;
  for (uint64_t seed = first; seed < first + count; ++seed) {
    std::mt19937_64 random(seed), shapes(seed);
    const auto uniform = [&](double low, double high) { return low + (high - low) * double(random() >> 11) * 0x1p-53; };
    const auto chance = [&](double probability) { return uniform(0, 1) < probability; };
    const double d = std::pow(10.0, uniform(-3, 1));
    const Double3 room = {d * uniform(6, 24), d * uniform(6, 24), d * uniform(4, 16)};
    Scene scene = tankScene(
        d, {d * std::floor(uniform(2, room[0] / d)), d * std::floor(uniform(2, room[1] / d)), d * std::floor(uniform(2, room[2] / d))},
        room);
    // Durations and velocities scale with the size; gravity does not.
    for (double& g : scene.gravity) g = chance(0.7) ? uniform(-10, 10) : 0;
    const auto randomize = [&](auto& owner, double probability) {
      model::forEachField<std::remove_reference_t<decltype(owner)>>([&](const auto& field) {
        if (!isTested(field.info.key) || isDrawnLater(field.info.key) || !chance(probability)) return;
        const bool words = !field.info.words.empty();
        const double low = words ? 0 : lowest(field.info.range),
                     high = words ? double(field.info.words.size() - 1) : highest(field.info.range);
        const double value = !words && high > 1000 ? std::pow(10.0, uniform(-4, 4)) : uniform(low, high);
        set(owner, field, std::clamp(value, low, high));
      });
    };
    randomize(scene.fluid, 0.25);
    randomize(scene.solver, 0.25);
    scene.solver.iterations = std::min(scene.solver.iterations, 8u);  // more iterations only take longer
    const int solids = chance(0.5) ? 1 + static_cast<int>(uniform(0, 3)) : 0;
    for (int k = 0; k < solids; ++k) {
      Solid solid;
      const Double3 at = {uniform(0, room[0]), uniform(0, room[1]), uniform(0, room[2])};
      const double size = d * uniform(0.5, 4);
      if (chance(0.5))
        solid.shape = SphereShape{at, size};
      else
        solid.shape = BoxShape{{at[0] - size, at[1] - size, at[2] - size}, {at[0] + size, at[1] + size, at[2] + size}};
      if (shapes() % 3 == 0) solid = randomMesh(shapes, at, size);
      solid.friction = uniform(0, 1);
      solid.restitution = uniform(0, 1);
      if (shapes() % 3 == 0 && !isSheet(solid))
        solid.body = Body{.density = std::pow(10.0, double(shapes() % 7)), .locked = static_cast<FreedomMask>(shapes() % 64)};
      else if (chance(0.3))
        solid.motion = {{0, {0, 0, 0}}, {0.2, {uniform(-4, 4) * d, uniform(-4, 4) * d, uniform(-4, 4) * d}}};
      scene.solids.push_back(solid);
    }
    for (double& v : scene.fill[0].velocity) v = uniform(-2, 2) * std::sqrt(10 * d);
    scene.fill[0].jitter = chance(0.3) ? uniform(0, 0.5) : 0;

    if (seed % 3 == 1) addRandomFlows(scene, seed);
    if (seed % 4 == 2) addRandomFluids(scene, seed);
    if (seed % 5 == 3) {
      scene.fluid.surface_tension = scene.fluid.density * 10 * d * d * std::pow(10, double(seed % 4) - 2);  // Bond numbers of 0.1 to 100
      scene.fluid.contact_angle = 10 * double(seed % 19);
    }
    if (scene.fluids.size() > 1 && seed % 3 == 0) {
      const double tension = scene.fluid.density * 10 * d * d * std::pow(10, double(seed / 4 % 4) - 2);
      scene.interfaces = {{.between = {"0", "1"}, .tension = tension}};
      if (scene.fluids.size() > 2) scene.interfaces.push_back({.between = {"2", "0"}, .tension = tension / 3});
    }
    if (seed % 6 == 4) {
      scene.fluid.yield_stress = scene.fluid.density * 10 * d * std::pow(10, double(seed % 5) - 2);  // of 0.01 to 100 layers' weight
      scene.fluid.flow_index = 0.2 + 0.1 * double(seed % 19);
    }
    StressCase c{.name = "random-" + std::to_string(seed), .scene = scene};
    c.duration_s = 12 * std::sqrt(d / 10);
    c.frame_s = c.duration_s / 12;
    c.externalWork = std::ranges::any_of(scene.solids, [](const Solid& s) { return !s.motion.empty() || s.body; }) ||
                     !scene.emitters.empty() || capillarySpeed(scene) > 0;
    // Initial overlaps (jitter, a solid inside the fluid) separate, which adds potential energy.
    c.maxEnergy = scene.fill[0].jitter > 0 || solids > 0 ? 1.2 : 1.02;
    // A mouth in a corner presses its flow through gaps that are narrower than itself.
    c.maxSpeed =
        speedBound(scene, 4 * std::sqrt(10 * d) + 4 * capillarySpeed(scene) + (c.externalWork ? 40 * d : 0) + 2 * fastestEmitter(scene));
    c.mayBeRejected = true;
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace rill::bench
