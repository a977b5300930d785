#include "reference/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numbers>
#include <tuple>

#include "mesher/cube_table.hpp"
#include "mesher/mesher_records.h"
#include "reference/neighbors.hpp"

namespace rill::reference {
namespace {

using Place = std::array<int, 3>;

/// Eigenvalues, the largest first, with eigenvectors as columns: cyclic Jacobi rotations.
std::pair<glm::dvec3, glm::dmat3> eigen(glm::dmat3 a) {
  glm::dmat3 v(1);
  for (uint32_t sweep = 0; sweep < kMeshSweeps; ++sweep)
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      if (std::abs(a[p][q]) < 1e-300) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1)), c = 1 / std::sqrt(t * t + 1), s = t * c;
      glm::dmat3 rotation(1);
      rotation[p][p] = rotation[q][q] = c;
      rotation[q][p] = s;
      rotation[p][q] = -s;
      a = glm::transpose(rotation) * a * rotation;
      v = v * rotation;
    }
  std::array<int, 3> order{0, 1, 2};
  std::ranges::sort(order, [&](int i, int j) { return a[i][i] > a[j][j]; });
  return {{a[order[0]][order[0]], a[order[1]][order[1]], a[order[2]][order[2]]}, {v[order[0]], v[order[1]], v[order[2]]}};
}

double smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

class Grid {
 public:
  Grid(std::span<const Ellipsoid> particles, std::span<const glm::dvec3> velocities, double cell)
      : particles_(particles), velocities_(velocities), cell_(cell) {
    for (uint32_t i = 0; i < particles.size(); ++i) bins_[binOf(particles[i].center)].push_back(i);
  }

  glm::dvec3 point(const Place& p) const { return cell_ * glm::dvec3(p[0], p[1], p[2]); }
  double distance(const Place& p) {
    const auto [found, added] = distances_.try_emplace(p, 0.0);
    if (added) found->second = meshDistance(at(point(p)).sum);
    return found->second;
  }

  FieldValue at(const glm::dvec3& x) const {
    FieldValue all;
    const Place bin = binOf(x);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto found = bins_.find({bin[0] + i, bin[1] + j, bin[2] + k});
          if (found == bins_.end()) continue;
          for (const uint32_t p : found->second) {
            const FieldValue one = fieldAt(particles_.subspan(p, 1), velocities_.empty() ? velocities_ : velocities_.subspan(p, 1), x);
            all.sum += one.sum;
            all.slope += one.slope;
            all.velocity += one.sum * one.velocity;
          }
        }
    if (all.sum > 0) all.velocity /= all.sum;
    return all;
  }

 private:
  static Place binOf(const glm::dvec3& x) {
    const auto along = [](double a) { return static_cast<int>(std::floor(a / double{kMeshReach})); };
    return {along(x.x), along(x.y), along(x.z)};
  }

  std::span<const Ellipsoid> particles_;
  std::span<const glm::dvec3> velocities_;
  double cell_;
  std::map<Place, std::vector<uint32_t>> bins_;
  std::map<Place, double> distances_;
};

}  // namespace

double meshKernel(double r) {
  if (r >= 1.5) return 0;
  return r <= 0.5 ? 1 / std::numbers::pi : (1.5 - r) / (2 * std::numbers::pi * r);
}

double meshKernelSlope(double r) { return r <= 0.5 || r >= 1.5 ? 0 : -1.5 / (2 * std::numbers::pi * r * r); }

double meshDistance(double sum) {
  if (sum < 0.5) return 1 - std::sqrt(2 * sum);
  return sum >= 1 ? -1 : std::sqrt(2 - 2 * sum) - 1;
}

std::vector<Ellipsoid> ellipsoids(std::span<const glm::dvec3> positions) {
  std::vector<Ellipsoid> all(positions.size());
  const Neighbors near = findNeighbors(positions, double{kMeshFitRadius});
  for (size_t i = 0; i < positions.size(); ++i) {
    double weights = 1, sum = meshKernel(0);
    glm::dvec3 first(0);
    glm::dmat3 second(0);
    for (const uint32_t j : near.of(i)) {
      const glm::dvec3 to = positions[j] - positions[i];
      const double r = glm::length(to) / double{kMeshFitRadius}, weight = 1 - r * r * r;
      weights += weight;
      sum += meshKernel(glm::length(to));
      first += weight * to;
      second += weight * glm::outerProduct(to, to);
    }
    const glm::dvec3 mean = first / weights;
    const auto [values, axes] = eigen(second / weights - glm::outerProduct(mean, mean));
    Ellipsoid& e = all[i];
    e.center = positions[i];
    e.surface = glm::length(mean) > double{kMeshDeepOffset} || weights < double{kMeshDeepWeight};
    // Particles at the rim of a sheet, too
    const double aside = glm::length(mean - glm::dot(mean, axes[2]) * axes[2]) - double{kMeshRimOffset};
    const double rim = double{kMeshRim} * std::max(aside, 0.0) * (1 - smooth(0, double{kMeshAlong}, values[2]));
    const double few = std::clamp(std::pow(double{kMeshSheetSum} / sum, double{kMeshPower}), 1.0, double{kMeshMaxAmplitude});
    e.amplitude = std::min(few * (1 + rim), double{kMeshMaxAmplitude});
    const double ratio = std::max(values[2], 0.0);
    glm::dvec3 scale(1);
    for (int a = 0; a < 2; ++a)
      scale[a] = 1 + (double{kMeshStretch} - 1) * (1 - smooth(double{kMeshFlat}, double{kMeshRound}, ratio / std::max(values[a], 1e-9))) *
                         smooth(0, double{kMeshAlong}, values[a]);
    e.toKernel = glm::dmat3(0);
    for (int a = 0; a < 3; ++a) e.toKernel += glm::outerProduct(axes[a], axes[a]) / scale[a];
    e.amplitude /= scale[0] * scale[1];
    e.radius = 1.5 * std::max(scale[0], scale[1]);
  }
  return all;
}

FieldValue fieldAt(std::span<const Ellipsoid> particles, std::span<const glm::dvec3> velocities, const glm::dvec3& point) {
  FieldValue all;
  for (size_t i = 0; i < particles.size(); ++i) {
    const Ellipsoid& e = particles[i];
    const glm::dvec3 in = e.toKernel * (point - e.center);
    const double r = glm::length(in), value = e.amplitude * meshKernel(r);
    all.sum += value;
    if (r > 0) all.slope += e.amplitude * meshKernelSlope(r) / r * (e.toKernel * in);
    if (!velocities.empty()) all.velocity += value * velocities[i];
  }
  if (all.sum > 0) all.velocity /= all.sum;
  return all;
}

SurfaceMesh surfaceMesh(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities, double cell) {
  const std::vector<Ellipsoid> particles = ellipsoids(positions);
  Grid grid(particles, velocities, cell);
  std::map<Place, bool> cells;
  for (const Ellipsoid& e : particles) {
    Place low{}, high{};
    for (int a = 0; a < 3; ++a) {
      low[size_t(a)] = static_cast<int>(std::floor((e.center[a] - e.radius) / cell)) - 1;
      high[size_t(a)] = static_cast<int>(std::ceil((e.center[a] + e.radius) / cell));
    }
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int z = low[2]; z <= high[2]; ++z) cells[{x, y, z}] = true;
  }
  SurfaceMesh mesh;
  std::map<std::pair<Place, uint32_t>, uint32_t> vertices;
  const auto table = cubeTriangles();
  for (const auto& [base, ignored] : cells) {
    const auto corner = [&](uint32_t c) { return Place{base[0] + int(c & 1), base[1] + int(c >> 1 & 1), base[2] + int(c >> 2 & 1)}; };
    uint32_t inside = 0;
    for (uint32_t c = 0; c < 8; ++c) inside |= (grid.distance(corner(c)) < 0 ? 1u : 0u) << c;
    for (const auto& triangle : table[inside]) {
      std::array<uint32_t, 3> indices{};
      for (size_t k = 0; k < 3; ++k) {
        const CubeEdge edge = cubeEdge(triangle[k]);
        const Place from = corner(edge.from), to = corner(edge.from | 1u << edge.axis);
        const auto [found, added] = vertices.try_emplace({from, edge.axis}, static_cast<uint32_t>(mesh.positions.size()));
        indices[k] = found->second;
        if (!added) continue;
        const double a = grid.distance(from), b = grid.distance(to);
        const double t = std::clamp(a / (a - b), double{kMeshEdgeMargin}, 1 - double{kMeshEdgeMargin});
        const glm::dvec3 along = grid.point(to) - grid.point(from), x = grid.point(from) + t * along;
        const FieldValue value = grid.at(x);
        // One step of Newton's method along the edge
        const double change = glm::dot(value.slope, along), step = std::abs(change) > 1e-3 ? (0.5 - value.sum) / change : 0;
        const double refined = std::clamp(t + step, double{kMeshEdgeMargin}, 1 - double{kMeshEdgeMargin});
        const double steep = glm::length(value.slope);
        mesh.positions.push_back(grid.point(from) + refined * along);
        mesh.normals.push_back(steep > 0 ? -value.slope / steep : glm::dvec3(0, 1, 0));
        mesh.velocities.push_back(value.velocity);
      }
      mesh.triangles.push_back(indices);
    }
  }
  return mesh;
}

double enclosedVolume(const SurfaceMesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles) volume += glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6;
  return volume;
}

}  // namespace rill::reference
