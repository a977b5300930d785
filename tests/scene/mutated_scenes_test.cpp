// Scenes with random invalid numbers: each is either rejected or accepted with valid simulation parameters.
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "fluid/settings.hpp"
#include "model/fields.hpp"
#include "support.hpp"
#include "support/flat_meshes.hpp"
#include "tank.hpp"

namespace rill::test {
namespace {

/// Setters of all numbers in a scene.
class Numbers {
 public:
  using Set = std::function<void(double factor, double value)>;  ///< sets number * factor + value

  explicit Numbers(Scene& scene) { object(scene); }
  const std::vector<Set>& all() const { return all_; }

 private:
  template <class Owner>
  void object(Owner& owner) {
    model::forEachField<Owner>([&](const auto& field) {
      using Value = typename std::remove_cvref_t<decltype(field)>::Value;
      if constexpr (model::kHasMember<Value>) {
        if (Value* value = field.find(owner)) add(*value);
      }
    });
    if constexpr (std::is_same_v<Owner, Solid>) add(owner.driven);
  }
  void add(double& number) {
    all_.push_back([&number](double factor, double value) { number = number * factor + value; });
  }
  template <class Whole>
  requires std::is_unsigned_v<Whole> || std::is_enum_v<Whole>
  void add(Whole& number) {
    all_.push_back([&number](double factor, double value) {
      const double wanted = static_cast<double>(number) * factor + value;
      const bool fits = wanted > -1 && wanted < 255;
      number = static_cast<Whole>(fits ? static_cast<uint8_t>(wanted) : std::numeric_limits<uint64_t>::max());
    });
  }
  void add(Double3& v) {
    for (double& number : v) add(number);
  }
  void add(Quaternion& v) {
    for (double& number : v) add(number);
  }
  void add(std::pair<double, double>& pair) {
    add(pair.first);
    add(pair.second);
  }
  void add(std::optional<double>& number) {
    all_.push_back([&number](double factor, double value) { number = number.value_or(0.01) * factor + value; });
  }
  template <class T>
  void add(std::optional<T>& value) {
    if (value) add(*value);
  }
  template <class T>
  void add(std::vector<T>& values) {
    for (T& value : values) add(value);
  }
  template <model::Described Struct>
  void add(Struct& value) {
    object(value);
  }
  void add(std::string&) {}
  void add(std::pair<std::string, std::string>&) {}
  void add(std::filesystem::path&) {}

  std::vector<Set> all_;
};

StartFigures figuresOf(const ParticleSet& set) {
  StartFigures start{.capacity = static_cast<uint32_t>(set.positions.size())};
  start.origin = set.origin;
  for (const Float3& p : set.positions) {
    const float v[3] = {p.x, p.y, p.z};
    for (int a = 0; a < 3; ++a) start.extent[a] = std::max<double>(start.extent[a], std::abs(v[a]));
  }
  for (const Float3& v : set.velocities) start.fastest = std::max<double>(start.fastest, std::hypot(v.x, v.y, v.z));
  return start;
}

void addBodies(Scene& scene) {
  scene.solids[0].body = Body{.density = 500, .velocity = {0, 1, 0}, .locked = 0b110};
  const Body held{.mass = 2, .angular_velocity = {1, 0, 0}, .from = 0.5};
  scene.solids.push_back({.shape = SphereShape{{0.3, 0.7, 0.3}, 0.1}, .body = held});
  scene.solids.push_back(
      {.shape = MeshShape{.mesh = meshOf(ballMesh(0.1, 1))}, .translation = {0.6, 0.8, 0.6}, .body = Body{.density = 2000}});
}

/// Fluid that sticks to walls and solids, and probes of pressure in it and in a solid.
void addStickyFluidAndPressures(Scene& scene) {
  scene.fluid.viscosity = 20;
  scene.domain->slip = false;
  for (Solid& solid : scene.solids) solid.slip = false;
  scene.probes.push_back({.name = "wet", .pressure = Double3{0.2, 0.1, 0.3}});
  scene.probes.push_back({.name = "covered", .pressure = Double3{0.95, 0.2, 0.5}});
}

/// Emitters, drains, an inflow and an outflow.
void addFlows(Scene& scene) {
  scene.emitters = {{.name = "tap", .mouth = DiscMouth{{0.3, 0.8, 0.3}, 0.1, {0, -1, 0}}, .flow = 0.01, .from = 0.1, .until = 2},
                    {.mouth = RectMouth{{0.6, 0.8, 0.6}, {0.2, 0.1}, {1, 0, 0}, {0, 1, 0}}, .speed = 2},
                    {.mouth = mouthOf(cornerMesh(0.1)), .speed = 1}};
  std::get<MeshMouth>(scene.emitters[2].mouth).translation = {0.5, 0.8, 0.5};
  scene.drains = {{.name = "plug", .shape = BoxShape{{0, 0, 0}, {0.1, 0.1, 0.1}}},
                  {.shape = SphereShape{{0.5, 0.1, 0.5}, 0.1}, .until = 3}};
  scene.probes.push_back({.name = "rate", .flow = "tap"});
  if (scene.domain->open != 0) return;
  scene.domain->inflow = Inflow{.level = 0.3, .speed = 0.5};
  scene.domain->outflow = Outflow{.level = 0.2};
}

TEST(MutatedScenes, AreRejectedOrRun) {
  constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kValues[] = {nan, inf, -inf, 1e300, -1e300, 3e38, -3e38, 1e20, 1e-20, 1e-44, -1e-44, 1, -1, 4, 100, 0};
  constexpr double kFactors[] = {0, 0, 0, 1, -1, 2, 0.5, 1.1, 0.01, 100, 1e6, 1e-6};
  std::mt19937 random(20240229);
  const auto below = [&](size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(random); };
  int rejected = 0, ran = 0, sticky = 0, flows = 0;
  for (int round = 0; round < 4000; ++round) {
    Scene scene = tank();
    if (round % 2 == 1) addBodies(scene);
    if (round % 4 >= 2) addStickyFluidAndPressures(scene);
    if (round % 3 == 0) addFlows(scene);
    const Numbers numbers(scene);
    for (size_t changes = 1 + below(3); changes > 0; --changes) {
      const double factor = kFactors[below(std::size(kFactors))];
      numbers.all()[below(numbers.all().size())](factor, factor == 0 ? kValues[below(std::size(kValues))] : 0);
    }
    const auto checked = checkScene(scene);
    (void)fluidMemory(scene, 1000);
    const auto made = makeParticles(scene, 3000);
    if (made) scene.fluid.spacing = made->spacing;
    EXPECT_LE(capacityOf(scene, 1000), kMaxParticles) << round;
    const auto setup = makeFluidSetup(scene, made ? figuresOf(*made) : StartFigures{.capacity = 100, .extent = {1, 1, 1}});
    if (!checked) {
      ++rejected;
      ASSERT_FALSE(made);
      EXPECT_EQ(made.error().message, checked.error().message);
      ASSERT_FALSE(setup);
      EXPECT_EQ(setup.error().message, checked.error().message);
      continue;
    }
    if (!made) {
      EXPECT_FALSE(made.error().message.empty());
      continue;
    }
    EXPECT_LE(made->positions.size(), 3000u);
    if (!setup) {
      EXPECT_EQ(setup.error().kind, ErrorKind::BadInput);
      EXPECT_FALSE(setup.error().message.empty());
      continue;
    }
    ++ran;
    EXPECT_LE(setup->grid.cells(), maxGridCells(made->positions.size()));
    for (const BodyRecord& body : setup->bodies) {
      EXPECT_GT(body.mass, 0) << round;
      for (const float number : {body.mass, body.inertiaXX, body.inertiaYY, body.inertiaZZ, body.radius, body.state.velocityX})
        EXPECT_TRUE(std::isfinite(number)) << round;
    }
    for (const PressureProbeRecord& probe : setup->pressureProbes)
      for (const float number : {probe.x, probe.y, probe.z}) EXPECT_TRUE(std::isfinite(number)) << round;
    EXPECT_TRUE(std::isfinite(setup->params.pressureDensity)) << round;
    sticky += setup->noSlipSolids && !setup->pressureProbes.empty();
    for (const EmitterRecord& e : setup->emitters) {
      EXPECT_TRUE(std::isfinite(e.speed) && std::isfinite(e.rate) && e.rate >= 0 && e.points > 0) << round;
      EXPECT_LE(e.firstPoint + e.points, setup->mouthPoints.size()) << round;
      ++flows;
    }
    EXPECT_GT(setup->longestStep, 0) << round;
    EXPECT_TRUE(std::isfinite(setup->longestStep)) << round;
    for (const SolidRecord& solid : setup->solids) EXPECT_TRUE(std::isfinite(solid.pose.centerX)) << round;
  }
  EXPECT_GT(rejected, 1000);
  EXPECT_GT(ran, 300);
  EXPECT_GT(sticky, 100);
  EXPECT_GT(flows, 200);
}

}  // namespace
}  // namespace rill::test
