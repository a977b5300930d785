#include "fill/mouth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh_plane.hpp"
#include "core/overloaded.hpp"
#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "fill/mesh_mouth.hpp"

namespace rill {
namespace {

/// How many samples a mouth has along a side of a size (m).
double samplesAlong(double size, double spacing) {
  constexpr double kMax = 16;
  return std::clamp(std::round(size / spacing), 1.0, kMax);
}

/// Centers of the cells of a grid over a rectangle, those that `inside` takes; its arguments are -1 .. 1.
template <class Inside>
std::vector<Double3> gridOf(const RectMouth& mouth, double spacing, const Inside& inside) {
  const Double3 across = normalized(cross(mouth.normal, mouth.up)), up = normalized(cross(across, mouth.normal));
  const double size[2] = {mouth.size.first, mouth.size.second};
  int count[2];
  for (int i = 0; i < 2; ++i) { count[i] = static_cast<int>(samplesAlong(size[i], spacing)); }
  std::vector<Double3> points;
  for (int j = 0; j < count[1]; ++j) {
    for (int i = 0; i < count[0]; ++i) {
      const double u = (2 * i + 1.0) / count[0] - 1, v = (2 * j + 1.0) / count[1] - 1;
      if (inside(u, v)) points.push_back(along(along(mouth.center, u * size[0] / 2, across), v * size[1] / 2, up));
    }
  }
  return points;
}

/// Those of a grid over the bounds of a mesh that are in it.
std::vector<Double3> samplesOf(const FlatMouth& flat, double spacing) {
  MouthGrid grid;
  for (size_t k = 0; k < 2; ++k) {
    const double size = flat.high[k] - flat.low[k];
    grid.pitch[k] = size / samplesAlong(size, spacing);
    grid.first[k] = flat.low[k] + grid.pitch[k] / 2;
  }
  std::vector<Double3> points;
  for (const MouthPoint& point : pointsIn(flat, grid)) points.push_back(inScene(flat, point));
  if (points.empty()) points.push_back(inScene(flat, middleOf(flat)));
  return points;
}

/// The largest distance of a vertex from the origin, m.
double reachOf(const MeshData& data) {
  double reach = 0;
  for (const auto& triangle : data.triangles)
    for (const uint32_t corner : triangle) reach = std::max(reach, length(data.vertices[corner]));
  return reach;
}

}  // namespace

double areaOf(const Mouth& mouth) {
  return std::visit(Overloaded{[](const DiscMouth& disc) { return std::numbers::pi * disc.radius * disc.radius; },
                               [](const RectMouth& rect) { return rect.size.first * rect.size.second; },
                               [](const MeshMouth& mesh) { return planeOf(mesh.mesh->data()).area; }},
                    mouth);
}

Double3 centerOf(const Mouth& mouth) {
  return std::visit(
      Overloaded{[](const MeshMouth& mesh) { return flatMouth(mesh).center; }, [](const auto& shape) { return shape.center; }}, mouth);
}

Double3 pivotOf(const Mouth& mouth) {
  return std::visit(Overloaded{[](const MeshMouth& mesh) { return mesh.translation; }, [](const auto& shape) { return shape.center; }},
                    mouth);
}

double flowOf(const Emitter& emitter) { return emitter.flow > 0 ? emitter.flow : emitter.speed * areaOf(emitter.mouth); }

Pose mouthPose(const Emitter& emitter, double t) { return keyframedPose(emitter.motion, pivotOf(emitter.mouth), {0, 0, 0, 1}, t); }

Mouth mouthAt(const Emitter& emitter, double t) {
  const Pose pose = mouthPose(emitter, t);
  return std::visit(Overloaded{[&](DiscMouth disc) -> Mouth {
                                 disc.center = pose.center, disc.normal = toScene(pose, disc.normal);
                                 return disc;
                               },
                               [&](RectMouth rect) -> Mouth {
                                 rect.center = pose.center, rect.normal = toScene(pose, rect.normal), rect.up = toScene(pose, rect.up);
                                 return rect;
                               },
                               [&](MeshMouth mesh) -> Mouth {
                                 const Pose placed = keyframedPose(emitter.motion, mesh.translation, mesh.rotation, t);
                                 mesh.translation = placed.center, mesh.rotation = placed.rotation;
                                 return mesh;
                               }},
                    emitter.mouth);
}

double fastestMouth(const Emitter& emitter) {
  const double radius = std::visit(Overloaded{[](const DiscMouth& disc) { return disc.radius; },
                                              [](const RectMouth& rect) { return std::hypot(rect.size.first, rect.size.second) / 2; },
                                              [](const MeshMouth& mesh) { return reachOf(mesh.mesh->data()); }},
                                   emitter.mouth);
  double fastest = 0;
  for (size_t k = 1; k < emitter.motion.size(); ++k) {
    const Pose pose = mouthPose(emitter, emitter.motion[k - 1].at);
    fastest = std::max(fastest, length(pose.velocity) + radius * length(pose.angularVelocity));
  }
  return fastest;
}

std::string emitterKey(const Scene& scene, size_t emitter) {
  return emitter < scene.emitters.size() ? elementPath("emitters", emitter) : "domain.inflow";
}

// The first layer's centers are half a spacing off the wall.
std::vector<Emitter> emittersOf(const Scene& scene) {
  std::vector<Emitter> all = scene.emitters;
  if (!scene.domain || !scene.domain->inflow) return all;
  const Domain& domain = *scene.domain;
  const Inflow& inflow = *domain.inflow;
  const size_t axis = sideBit(inflow.side) / 2, across = 2 - axis;
  const bool high = sideBit(inflow.side) % 2 == 1;
  const double spacing = scene.fluid.spacing;
  Double3 center, normal;
  center[axis] = high ? domain.max[axis] - spacing / 2 : domain.min[axis] + spacing / 2;
  center[1] = domain.min[1] + inflow.level / 2;
  center[across] = (domain.min[across] + domain.max[across]) / 2;
  normal[axis] = high ? -1 : 1;
  all.push_back({.name = "inflow",
                 .mouth = RectMouth{center, {domain.max[across] - domain.min[across], inflow.level}, normal, {0, 1, 0}},
                 .flow = inflow.flow,
                 .speed = inflow.speed,
                 .fluid = inflow.fluid});
  return all;
}

std::vector<Double3> samplesOf(const Mouth& mouth, double spacing) {
  if (const auto* rect = std::get_if<RectMouth>(&mouth)) return gridOf(*rect, spacing, [](double, double) { return true; });
  if (const auto* mesh = std::get_if<MeshMouth>(&mouth)) return samplesOf(flatMouth(*mesh), spacing);
  const auto& disc = std::get<DiscMouth>(mouth);
  const RectMouth square{disc.center, {2 * disc.radius, 2 * disc.radius}, disc.normal, unitAcross(normalized(disc.normal))};
  return gridOf(square, spacing, [](double u, double v) { return u * u + v * v < 1; });
}

}  // namespace rill
