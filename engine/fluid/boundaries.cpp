#include "fluid/boundaries.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "core/overloaded.hpp"
#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "fluid/numbers.hpp"
#include "fluid/viscosity.hpp"
#include "shape/contact_points.hpp"
#include "shape/mass.hpp"
#include "shape/records.hpp"
#include "shape/thin_parts.hpp"
#include "sph/half_space.hpp"
#include "sph/mesh_field.hpp"
#include "sph/no_slip.hpp"
#include "sph/solid_density.hpp"

namespace rill {
namespace {

/// Each entry with its successor behind it, so that a shader fetches the two it interpolates between at once.
void appendTable(std::vector<float>& tables, const std::vector<float>& table, uint32_t& offset) {
  offset = static_cast<uint32_t>(tables.size() / 4);
  for (size_t k = 0; k < table.size(); k += 2) {
    const size_t next = std::min(k + 2, table.size() - 2);
    tables.insert(tables.end(), {table[k], table[k + 1], table[next], table[next + 1]});
  }
}

/// Where the field of a mesh begins among the words; solids with the same mesh share it.
Expected<uint32_t> addMesh(const std::shared_ptr<const Mesh>& mesh, const std::string& key, const SmoothingKernel& kernel,
                           std::map<const Mesh*, uint32_t>& known, FluidSetup& setup) {
  const auto [at, fresh] = known.emplace(mesh.get(), static_cast<uint32_t>(setup.meshWords.size()));
  if (!fresh) return at->second;
  const auto field = MeshField::create(*mesh, kernel);
  if (!field) return Error{field.error().kind, key + ": " + field.error().message};
  if (field->cell() > 0.6 * kernel.spacing())
    setup.warnings.push_back(key + ": the mesh is so large for this spacing that its distances are sampled every " +
                             roundedNumber(field->cell()) + " m, not every half spacing");
  if (const auto thin = thinnestPart(*mesh, 0.5 * kernel.spacing()))
    setup.warnings.push_back(key + ": " + grouped(thin->triangles) + (thin->triangles == 1 ? " triangle is" : " triangles are") +
                             " on parts thinner than half a spacing, which may not hold fluid; the thinnest is " +
                             roundedNumber(thin->thickness) + " m at " + roundedPlace(thin->place) + " of the mesh");
  for (const std::string& warning : mesh->warnings()) setup.warnings.push_back(std::string(key).append(": ").append(warning));
  constexpr double kFloatStep = 0x1p-24, kTooCoarse = 1e-3;
  if (const double far = boundingRadius(MeshShape{.mesh = mesh}); far * kFloatStep > kTooCoarse * kernel.spacing())
    setup.warnings.push_back(key + ": the mesh reaches " + roundedNumber(far) +
                             " m from its origin, where positions are rounded to more than a thousandth of the spacing");
  const std::vector<uint32_t>& words = field->words();
  if (setup.meshWords.size() + words.size() > MeshField::kMaxWords)
    return Error{ErrorKind::TooLarge, key + ": the fields of the scene's meshes need more than " + grouped(4 * MeshField::kMaxWords) +
                                          " bytes; expected smaller meshes, fewer of them, or a larger spacing"};
  setup.meshWords.insert(setup.meshWords.end(), words.begin(), words.end());
  return at->second;
}

/// What follows from a shape; solids with the same mesh share it.
struct BodyShape {
  std::vector<ContactPoint> points;
  MassProperties unit;  ///< of density 1
};

const BodyShape& bodyShape(const Shape& shape, std::map<const Mesh*, BodyShape>& meshes, BodyShape& other) {
  const auto* mesh = std::get_if<MeshShape>(&shape);
  if (!mesh) return other = {contactPoints(shape), massOf(shape, 1)};
  const auto [at, fresh] = meshes.try_emplace(mesh->mesh.get());
  if (fresh) at->second = {contactPoints(shape), massOf(shape, 1)};
  return at->second;
}

/// Whether 32-bit floats can hold the mass and a positive definite inertia, and their inverses.
bool fits(const MassProperties& m) {
  constexpr double kLeast = 1e-30, kMost = 1e30;
  const auto& [xx, yy, zz, yz, zx, xy] = m.inertia;
  const double minor = xx * yy - xy * xy, determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
  const double size = xx + yy + zz;
  const auto within = [](double value) { return value > kLeast && value < kMost; };
  return within(m.mass) && within(size) && xx > 0 && minor > 0 && determinant > 1e-12 * size * size * size;
}

static_assert(kPointWorkgroups * kFluidGroup >= kMaxContactPoints);

Expected<void> addBody(const Solid& solid, const BodyShape& shape, const Double3& origin, FluidSetup& setup) {
  const auto index = static_cast<uint32_t>(setup.solids.size());
  const MassProperties m = massOf(solid, shape.unit);
  if (!fits(m)) {
    const bool crossed = !(m.inertia[0] > 0 && m.inertia[1] > 0 && m.inertia[2] > 0);
    return Error{ErrorKind::BadInput, elementPath("solids", index) + ".body: a mass of " + roundedNumber(m.mass) +
                                          " kg and moments of inertia of " + roundedNumber(m.inertia[0]) + ", " +
                                          roundedNumber(m.inertia[1]) + " and " + roundedNumber(m.inertia[2]) + " kg m^2 " +
                                          (crossed ? "are not those of a solid; expected a mesh that does not cross itself"
                                                   : "do not fit 32-bit floats; expected 1e-30 to 1e30, and no moment 1e-6 of another")};
  }
  setup.movingSolids = true;
  setup.bodies.push_back(bodyRecord(solid, m, index, origin));
  setup.bodies.back().firstPoint = static_cast<uint32_t>(setup.contactPoints.size());
  for (const ContactPoint& point : shape.points)
    setup.contactPoints.push_back(
        {f(point.center.x), f(point.center.y), f(point.center.z), f(point.radius), static_cast<uint32_t>(setup.bodies.size() - 1)});
  return {};
}

}  // namespace

BodyRecord bodyRecord(const Solid& solid, const MassProperties& m, uint32_t index, const Double3& origin) {
  const Pose pose = solidPose(solid, 0.0);
  const Double3 center = along(pose.center, 1, toScene(pose, m.center));
  const Body& body = *solid.body;
  const PoseRecord state{f(center.x - origin.x),    f(center.y - origin.y), f(center.z - origin.z),     f(pose.rotation.x),
                         f(pose.rotation.y),        f(pose.rotation.z),     f(pose.rotation.w),         f(body.velocity.x),
                         f(body.velocity.y),        f(body.velocity.z),     f(body.angular_velocity.x), f(body.angular_velocity.y),
                         f(body.angular_velocity.z)};
  const auto& i = m.inertia;
  return {.state = state,
          .predicted = state,
          .offsetX = f(m.center.x),
          .offsetY = f(m.center.y),
          .offsetZ = f(m.center.z),
          .radius = f(radiusAbout(solid.shape, m.center)),
          .from = f(body.from),
          .mass = f(m.mass),
          .locked = body.locked,
          .held = body.from > 0,
          .solid = index,
          .inertiaXX = f(i[0]),
          .inertiaYY = f(i[1]),
          .inertiaZZ = f(i[2]),
          .inertiaYZ = f(i[3]),
          .inertiaZX = f(i[4]),
          .inertiaXY = f(i[5])};
}

double fastestBody(const Scene& scene) {
  double fastest = 0;
  for (const Solid& solid : scene.solids)
    if (solid.body)
      fastest = std::max(fastest, length(solid.body->velocity) +
                                      radiusAbout(solid.shape, massOf(solid.shape, 1).center) * length(solid.body->angular_velocity));
  return fastest;
}

double fastestSolid(const Scene& scene) {
  double fastest = 0;
  for (const Solid& solid : scene.solids) {
    const double radius = boundingRadius(solid.shape);
    for (size_t k = 1; k < solid.motion.size(); ++k) {
      const Pose pose = solidPose(solid, solid.motion[k - 1].at);
      fastest = std::max(fastest, length(pose.velocity) + radius * length(pose.angularVelocity));
    }
  }
  return fastest;
}

double fastestDriven(const Scene& scene) {
  double fastest = 0;
  for (const Solid& solid : scene.solids) fastest = std::max(fastest, solid.driven);
  return fastest;
}

Expected<void> addSolids(const Scene& scene, const SmoothingKernel& kernel, const Double3& origin, FluidSetup& setup) {
  std::map<const Mesh*, uint32_t> meshes;
  std::map<const Mesh*, BodyShape> bodyShapes;
  BodyShape other;
  for (const Solid& solid : scene.solids) {
    const std::string path = elementPath("solids", setup.solids.size()) + ".mesh";
    SolidRecord record{};
    record.pose = recordOf(solidPose(solid, 0.0), origin);
    record.shape = recordOf(solid.shape);
    record.base = baseRecord(solid, origin);
    record.body = kNoBody;
    if (solid.body) {
      record.body = static_cast<uint32_t>(setup.bodies.size());
      if (auto added = addBody(solid, bodyShape(solid.shape, bodyShapes, other), origin, setup); !added) return added.error();
    }
    record.radius = f(boundingRadius(solid.shape));
    record.friction = f(solid.friction);
    record.restitution = f(solid.restitution);
    record.noSlip = sticks(scene, solid) ? 1 : 0;
    std::vector<KeyframeRecord> keyframes = keyframeRecords(solid.motion);
    if (solid.driven > 0) {
      record.driven = 1;
      const auto still = drivenKeyframes(record.pose, record.pose, 0);
      keyframes.assign(still.begin(), still.end());
      setup.driven.push_back({static_cast<uint32_t>(setup.solids.size()), solid.driven, boundingRadius(solid.shape), record.pose});
    }
    record.firstKey = static_cast<uint32_t>(setup.keyframes.size() / kKeyframeNumbers);
    record.keyCount = static_cast<uint32_t>(keyframes.size());
    setup.movingSolids |= record.keyCount > 0;
    for (const KeyframeRecord& key : keyframes) {
      const auto numbers = std::bit_cast<std::array<float, kKeyframeNumbers>>(key);
      setup.keyframes.insert(setup.keyframes.end(), numbers.begin(), numbers.end());
    }
    std::visit(Overloaded{[&](const SphereShape& sphere) {
                            const SphereTable table = makeSphereTable(kernel, sphere.radius);
                            appendTable(setup.tables, table.table, record.tableOffset);
                            record.tableNodes = table.nodes;
                            record.tableFirst = f(table.first);
                          },
                          [](const BoxShape&) {}, [](const MeshShape&) {}},  // read the table of a half-space
               solid.shape);
    if (const auto* mesh = std::get_if<MeshShape>(&solid.shape)) {
      const auto field = addMesh(mesh->mesh, path, kernel, meshes, setup);
      if (!field) return field.error();
      record.shape.field = *field;
    }
    setup.solids.push_back(record);
  }
  return {};
}

double loadLever(const Scene& scene, double support) {
  double radius = 0;
  for (const Solid& solid : scene.solids) radius = std::max(radius, boundingRadius(solid.shape));
  return std::exp2(std::ceil(std::log2(radius + support)));
}

void setWalls(const Scene& scene, const Double3& origin, FluidParams& p) {
  float* low[3] = {&p.lowX, &p.lowY, &p.lowZ};
  float* high[3] = {&p.highX, &p.highY, &p.highZ};
  float* boundLow[3] = {&p.boundLowX, &p.boundLowY, &p.boundLowZ};
  float* boundHigh[3] = {&p.boundHighX, &p.boundHighY, &p.boundHighZ};
  double margin = 0.5 * scene.fluid.spacing;
  for (int a = 0; a < 3; ++a) {
    *low[a] = *boundLow[a] = -kNoWall;
    *high[a] = *boundHigh[a] = kNoWall;
    if (!scene.domain) continue;
    *boundLow[a] = f(scene.domain->min[a] - origin[a]);
    *boundHigh[a] = f(scene.domain->max[a] - origin[a]);
    if (!(scene.domain->open & (1u << (2 * a)))) *low[a] = *boundLow[a];
    if (!(scene.domain->open & (2u << (2 * a)))) *high[a] = *boundHigh[a];
    if (*low[a] > -kNoWall && *high[a] < kNoWall) margin = std::min(margin, 0.5 * (scene.domain->max[a] - scene.domain->min[a]));
  }
  p.margin = f(margin);
}

void addNoSlipTable(const SmoothingKernel& kernel, FluidSetup& setup) {
  std::vector<float> table;
  for (const float q : makeNoSlipTable(kernel)) table.insert(table.end(), {q, 0});
  appendTable(setup.tables, table, setup.params.noSlipTable);
}

void addHalfSpaceTable(const SmoothingKernel& kernel, FluidSetup& setup) {
  const HalfSpaceTable half = makeHalfSpaceTable(kernel);
  uint32_t first = 0;
  appendTable(setup.tables, half.table, first);
  setup.params.tableStep = f(half.step);
  setup.params.tableNodes = half.nodes;
}

}  // namespace rill
