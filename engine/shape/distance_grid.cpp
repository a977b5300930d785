#include "shape/distance_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape/mesh_impl.hpp"

namespace rill {
namespace {

/// Signed distances of points one after the other. From one to the next the distance changes by no more than they are apart: the sign
/// changes only where the surface may lie between them.
class Walker {
 public:
  Walker(const MeshImpl& mesh, double shell) : mesh_(mesh), shell_(shell) {}

  double to(const Double3& at) {
    const double step = std::hypot(at.x - last_.x, at.y - last_.y, at.z - last_.z);
    const bool near = begun_ && step < distance_;
    const NearestPoint nearest = mesh_.tree.nearest(at, triangle_);
    distance_ = std::sqrt(nearest.squared);
    triangle_ = nearest.triangle;
    if (!near) inside_ = !mesh_.twoSided && mesh_.tree.winding(at) != 0;
    last_ = at;
    begun_ = true;
    return (inside_ ? -distance_ : distance_) - shell_;
  }

 private:
  const MeshImpl& mesh_;
  double shell_;
  Double3 last_ = {};
  double distance_ = 0;
  uint32_t triangle_ = 0;
  bool inside_ = false, begun_ = false;
};

struct Extent {
  Double3 low;
  std::array<double, 3> blocks;  // whole numbers
};

Extent extentOf(const Mesh& mesh, double cell, double outside) {
  Extent extent;
  const double block = DistanceGrid::kCells * cell;
  for (size_t a = 0; a < 3; ++a) {
    const double size = mesh.max()[a] - mesh.min()[a] + 2 * outside;
    extent.blocks[a] = std::max(1.0, std::ceil(size / block));
    extent.low[a] = (mesh.min()[a] + mesh.max()[a] - extent.blocks[a] * block) / 2;
  }
  return extent;
}

double mixed(const float* v, size_t dy, size_t dz, const std::array<double, 3>& t) {
  const auto line = [&](const float* p) { return p[0] * (1 - t[0]) + p[1] * t[0]; };
  const auto face = [&](const float* p) { return line(p) * (1 - t[1]) + line(p + dy) * t[1]; };
  return face(v) * (1 - t[2]) + face(v + dz) * t[2];
}

}  // namespace

double DistanceGrid::at(const std::array<int64_t, 3>& node) const {
  std::array<size_t, 3> inBlock{}, in{};
  double beyond = 0;
  for (size_t a = 0; a < 3; ++a) {
    const int64_t last = int64_t{blocks[a]} * kCells, n = std::clamp<int64_t>(node[a], 0, last);
    if (node[a] != n) beyond = std::hypot(beyond, static_cast<double>(node[a] - n) * cell);
    inBlock[a] = static_cast<size_t>(std::min<int64_t>(n / kCells, blocks[a] - 1));
    in[a] = static_cast<size_t>(n) - inBlock[a] * kCells;
  }
  const uint32_t own = fine[(inBlock[2] * blocks[1] + inBlock[1]) * blocks[0] + inBlock[0]];
  if (own != kCoarse) return nodes[size_t{own} * kBlockNodes + (in[2] * kNodes + in[1]) * kNodes + in[0]] + beyond;
  const size_t row = blocks[0] + 1, layer = row * (blocks[1] + 1);
  std::array<double, 3> t;
  for (size_t a = 0; a < 3; ++a) t[a] = static_cast<double>(in[a]) / kCells;
  return mixed(&corners[inBlock[2] * layer + inBlock[1] * row + inBlock[0]], row, layer, t) + beyond;
}

double gridWords(const Mesh& mesh, double cell, const DistanceBand& band) {
  const Extent extent = extentOf(mesh, cell, band.outside);
  double blocks = 1, corners = 1;
  for (double n : extent.blocks) {
    blocks *= n;
    corners *= n + 1;
  }
  return blocks + corners;
}

std::optional<DistanceGrid> sampleDistances(const Mesh& mesh, double cell, const DistanceBand& band, double shell, uint64_t maxNodes) {
  const Extent extent = extentOf(mesh, cell, band.outside + shell);
  DistanceGrid grid{.low = extent.low, .cell = cell};
  for (size_t a = 0; a < 3; ++a) grid.blocks[a] = static_cast<uint32_t>(extent.blocks[a]);
  const auto [nx, ny, nz] = grid.blocks;
  const double block = grid.block();
  Walker walker(implOf(mesh), shell);
  grid.corners.reserve(size_t{nx + 1} * (ny + 1) * (nz + 1));
  for (uint32_t z = 0; z <= nz; ++z)
    for (uint32_t y = 0; y <= ny; ++y)
      for (uint32_t x = 0; x <= nx; ++x)
        grid.corners.push_back(static_cast<float>(walker.to({grid.low.x + x * block, grid.low.y + y * block, grid.low.z + z * block})));
  // No point of a block is farther from its nearest corner than half the diagonal.
  const double slack = 0.5 * std::numbers::sqrt3 * block;
  const size_t row = nx + 1, layer = row * (ny + 1);
  uint32_t fine = 0;
  for (uint32_t z = 0; z < nz; ++z)
    for (uint32_t y = 0; y < ny; ++y)
      for (uint32_t x = 0; x < nx; ++x) {
        bool meets = false;
        for (size_t k = 0; k < 8; ++k) {
          const double s = grid.corners[(z + (k >> 2)) * layer + (y + (k >> 1 & 1)) * row + x + (k & 1)];
          meets = meets || (s < band.outside + slack && s > -band.inside - slack);
        }
        grid.fine.push_back(meets ? fine++ : DistanceGrid::kCoarse);
        if (!meets) continue;
        if (grid.nodes.size() + DistanceGrid::kBlockNodes > maxNodes) return std::nullopt;
        // What blocks before it have on the faces that they share.
        const uint32_t before[3] = {x > 0 ? grid.fine[grid.fine.size() - 2] : DistanceGrid::kCoarse,
                                    y > 0 ? grid.fine[grid.fine.size() - 1 - nx] : DistanceGrid::kCoarse,
                                    z > 0 ? grid.fine[grid.fine.size() - 1 - size_t{nx} * ny] : DistanceGrid::kCoarse};
        const auto known = [&](std::array<uint32_t, 3> node) -> const float* {
          for (size_t a = 0; a < 3; ++a) {
            if (node[a] > 0 || before[a] == DistanceGrid::kCoarse) continue;
            node[a] = DistanceGrid::kCells;
            return &grid.nodes[size_t{before[a]} * DistanceGrid::kBlockNodes +
                               (node[2] * DistanceGrid::kNodes + node[1]) * DistanceGrid::kNodes + node[0]];
          }
          return nullptr;
        };
        const Double3 low = {grid.low.x + x * block, grid.low.y + y * block, grid.low.z + z * block};
        for (uint32_t k = 0; k < DistanceGrid::kNodes; ++k)
          for (uint32_t j = 0; j < DistanceGrid::kNodes; ++j)
            for (uint32_t i = 0; i < DistanceGrid::kNodes; ++i)
              if (const float* same = known({i, j, k}))
                grid.nodes.push_back(float{*same});
              else
                grid.nodes.push_back(static_cast<float>(walker.to({low.x + i * cell, low.y + j * cell, low.z + k * cell})));
      }
  return grid;
}

}  // namespace rill
