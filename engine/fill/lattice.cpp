#include "fill/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/overloaded.hpp"
#include "shape/mesh_impl.hpp"
#include "shape/pose.hpp"
#include "shape/shape.hpp"

namespace rill {
namespace {

/// round() that takes 0.15 / 0.1 as 1.5, although the quotient of the doubles is slightly less.
double roundedCount(double length, double spacing) {
  const double ratio = length / spacing;
  return std::floor(ratio * (1 + 1e-12) + 0.5 + 1e-9);
}

double volumeOf(const ParticleFile&) { return 0; }

double volumeOf(const Fill& fill) {
  return std::visit([](const auto& shape) { return volumeOf(shape); }, fill.shape);
}

/// Largest difference between a box side and a whole number of spacings, in spacings: 0 to 0.5.
double maxMisfit(std::span<const Fill> fills, double spacing) {
  double worst = 0;
  for (const Fill& fill : fills) {
    const auto* box = std::get_if<BoxShape>(&fill.shape);
    for (int axis = 0; box && axis < 3; ++axis) {
      const double ratio = (box->max[axis] - box->min[axis]) / spacing;
      worst = std::max(worst, std::abs(ratio - std::round(ratio)));
    }
  }
  return worst;
}

double totalPoints(std::span<const Fill> fills, double spacing) {
  const double exact_rows = std::min(4096.0, 40000.0 / static_cast<double>(fills.size()));  // the search evaluates thousands of spacings
  double total = 0;
  for (const Fill& fill : fills) {
    if (std::holds_alternative<MeshShape>(fill.shape))
      total += volumeOf(fill) / (spacing * spacing * spacing);
    else if (!std::holds_alternative<ParticleFile>(fill.shape))
      total += countPoints(latticeOf(fill, spacing), exact_rows);
  }
  return total;
}

std::vector<Double3> placedVertices(const Fill& fill, const Mesh& mesh) {
  const Pose pose{.center = fill.translation, .rotation = fill.rotation};
  std::vector<Double3> placed;
  placed.reserve(mesh.data().vertices.size());
  for (const Double3& v : mesh.data().vertices) {
    const Double3 turned = toScene(pose, v);
    placed.push_back({turned.x + pose.center.x, turned.y + pose.center.y, turned.z + pose.center.z});
  }
  return placed;
}

std::vector<Run> meshRow(const Lattice& lattice, uint64_t j, uint64_t k) {
  std::vector<Crossing> crossings;
  const double y = lattice.first.y + static_cast<double>(j) * lattice.spacing,
               z = lattice.first.z + static_cast<double>(k) * lattice.spacing;
  lattice.mesh->crossings({0, y, z}, crossings);
  std::ranges::sort(crossings, {}, &Crossing::x);
  std::vector<Run> runs;
  int winding = 0;  // of the points up to the next crossing
  uint64_t begin = 0;
  const auto firstFrom = [&](double x) {  // index of the first point not below x
    return static_cast<uint64_t>(std::clamp(std::ceil((x - lattice.first.x) / lattice.spacing), 0.0, lattice.size[0]));
  };
  for (const Crossing& crossing : crossings) {
    const bool inside = winding != 0;
    winding -= crossing.sign;
    if (!inside && winding != 0) begin = firstFrom(crossing.x);
    if (!inside || winding != 0) continue;
    const uint64_t end = firstFrom(crossing.x);
    if (!runs.empty() && runs.back().end == begin)
      runs.back().end = end;
    else if (begin < end)
      runs.push_back({begin, end});
  }
  return runs;
}

Run sphereRow(const Lattice& lattice, uint64_t j, uint64_t k) {
  // In spacings from the center. The tolerance keeps points on the sphere inside despite rounding.
  const double n = lattice.size[0];
  const double y = static_cast<double>(j) - 0.5 * (lattice.size[1] - 1), z = static_cast<double>(k) - 0.5 * (lattice.size[2] - 1);
  const double radius = lattice.radius / lattice.spacing * (1 + 1e-12);
  const double left = radius * radius - y * y - z * z;
  if (left < 0) return {};
  const double reach = std::sqrt(left), center = 0.5 * (n - 1);
  const auto begin = static_cast<uint64_t>(std::max(0.0, std::ceil(center - reach)));
  return {begin, std::max(begin, static_cast<uint64_t>(std::clamp(std::floor(center + reach) + 1, 0.0, n)))};
}

}  // namespace

Lattice latticeOf(const Fill& fill, double spacing) {
  Lattice lattice;
  lattice.spacing = spacing;
  std::visit(Overloaded{[&](const BoxShape& box) {
                          for (int axis = 0; axis < 3; ++axis) {
                            lattice.size[axis] = roundedCount(box.max[axis] - box.min[axis], spacing);
                            lattice.first[axis] = box.min[axis] + 0.5 * spacing;
                          }
                        },
                        [&](const SphereShape& sphere) {
                          lattice.radius = sphere.radius;
                          for (int axis = 0; axis < 3; ++axis) {
                            lattice.size[axis] = roundedCount(2 * sphere.radius, spacing);
                            lattice.first[axis] = sphere.center[axis] - 0.5 * (lattice.size[axis] - 1) * spacing;
                          }
                        },
                        [&](const MeshShape& mesh) {
                          const std::vector<Double3> placed = placedVertices(fill, *mesh.mesh);
                          lattice.mesh = std::make_shared<TriangleTree>(placed, mesh.mesh->data().triangles);
                          lattice.volume = mesh.mesh->volume();
                          for (size_t axis = 0; axis < 3; ++axis) {
                            const auto along = [axis](const Double3& v) { return v[axis]; };
                            const double low = along(*std::ranges::min_element(placed, {}, along)),
                                         high = along(*std::ranges::max_element(placed, {}, along));
                            lattice.size[axis] = roundedCount(high - low, spacing);
                            lattice.first[axis] = (low + high - (lattice.size[axis] - 1) * spacing) / 2;
                          }
                        },
                        [](const ParticleFile&) {}},
             fill.shape);
  return lattice;
}

std::vector<Run> rowOf(const Lattice& lattice, uint64_t j, uint64_t k) {
  if (lattice.mesh) return meshRow(lattice, j, k);
  return {lattice.radius < 0 ? Run{0, static_cast<uint64_t>(lattice.size[0])} : sphereRow(lattice, j, k)};
}

double countPoints(const Lattice& lattice, double exactRows) {
  if (lattice.radius < 0 && !lattice.mesh) return lattice.boxCount();
  const double rows = lattice.size[1] * lattice.size[2];
  if (!(rows <= exactRows) && lattice.mesh) return lattice.volume / std::pow(lattice.spacing, 3);
  if (!(rows <= exactRows)) return volumeOf(SphereShape{.radius = lattice.radius / lattice.spacing});
  uint64_t count = 0;
  for (uint64_t k = 0; k < static_cast<uint64_t>(lattice.size[2]); ++k) {
    for (uint64_t j = 0; j < static_cast<uint64_t>(lattice.size[1]); ++j) {
      for (const Run& run : rowOf(lattice, j, k)) count += run.end - run.begin;
    }
  }
  return static_cast<double>(count);
}

double spacingFor(std::span<const Fill> fills, double target) {
  double volume = 0;
  for (const Fill& fill : fills) volume += volumeOf(fill);
  if (!(volume > 0) || !(target > 0)) return 0;
  const double middle = std::cbrt(volume / target);
  double best = middle, best_cost = std::numeric_limits<double>::infinity();
  const auto consider = [&](double spacing) {
    // A lattice that misses its box by half a spacing starts with a compressed or missing layer at a wall, which is worse than 2 %
    // more or fewer particles.
    constexpr double kCostOfMisfit = 0.04, kCostOfVolume = 0.01;
    const double count = totalPoints(fills, spacing);
    if (!(count > 0)) return;
    const double cost = std::abs(count - target) / target + kCostOfMisfit * maxMisfit(fills, spacing) +
                        kCostOfVolume * std::abs(std::log(count * spacing * spacing * spacing / volume));
    if (cost >= best_cost) return;
    best = spacing;
    best_cost = cost;
  };
  // The count is a step function of the spacing, and not monotone for spheres: scan a range around the spacing given by the volume,
  // which is off by up to a factor of two for fills of one or two layers.
  const int steps = fills.size() <= 1000 ? 1200 : 100;
  for (int i = -steps; i <= steps; ++i) consider(middle * std::exp2(static_cast<double>(i) / steps));
  // Also try the spacings that fit a side of a box exactly.
  constexpr size_t kFillsToFit = 8;
  constexpr double kMaxPerAxis = 2000;
  for (const Fill& fill : fills.first(std::min(fills.size(), kFillsToFit))) {
    const auto* box = std::get_if<BoxShape>(&fill.shape);
    for (int axis = 0; box && axis < 3; ++axis) {
      const double length = box->max[axis] - box->min[axis];
      const double last = std::min(2 * length / middle, kMaxPerAxis);
      for (double n = std::max(1.0, std::floor(0.5 * length / middle)); n <= last; ++n) consider(length / n);
    }
  }
  return best;
}

}  // namespace rill
