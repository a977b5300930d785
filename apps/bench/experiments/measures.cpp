#include "bench/experiments/measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace rill::bench {
namespace {

constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double kVoidRadius = 1.25;  // spacings; points inside a cubic lattice are at most 0.87 from it

/// Wendland C2 without its constant factor: densities are calibrated on the rest lattice.
double wendland(double q) {
  if (q >= 1) return 0;
  const double u = 1 - q;
  return u * u * u * u * (1 + 4 * q);
}

double latticeSum(double support_in_spacings) {
  const int reach = static_cast<int>(std::ceil(support_in_spacings));
  double sum = 0;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) sum += wendland(std::sqrt(double(x * x + y * y + z * z)) / support_in_spacings);
  return sum;
}

Double3 mean(std::span<const Double3> points) {
  Double3 sum{};
  for (const Double3& point : points)
    for (size_t axis = 0; axis < 3; ++axis) sum[axis] += point[axis];
  for (double& value : sum) value /= double(points.size());
  return sum;
}

}  // namespace

Cloud cloudOf(const offline::Particles& particles, double spacing_m) {
  const auto wide = [](const Float3& value) { return Double3{value.x, value.y, value.z}; };
  Cloud cloud;
  cloud.spacing = spacing_m;
  for (const Float3& position : particles.positions) cloud.position.push_back(wide(position));
  for (const Float3& velocity : particles.velocities) cloud.velocity.push_back(wide(velocity));
  if (!particles.concentrations.empty()) cloud.share = particles.concentrations.front();
  return cloud;
}

NeighborGrid::NeighborGrid(std::span<const Double3> points, double reach_m) : points_(points), cell_(reach_m), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), size_t{0});
  std::vector<uint64_t> keys;
  for (const Double3& point : points) keys.push_back(keyOf(cellOf(point)));
  std::ranges::stable_sort(order_, {}, [&](size_t i) { return keys[i]; });
  for (size_t first = 0, last = 0; first < order_.size(); first = last) {
    while (last < order_.size() && keys[order_[last]] == keys[order_[first]]) ++last;
    ranges_[keys[order_[first]]] = {first, last};
  }
}

NeighborGrid::Cell NeighborGrid::cellOf(const Double3& point) const {
  Cell cell;
  for (size_t axis = 0; axis < 3; ++axis) cell[axis] = static_cast<int64_t>(std::floor(point[axis] / cell_));
  return cell;
}

// 21 bits per axis. The distance test separates cells that share a key.
uint64_t NeighborGrid::keyOf(const Cell& cell) {
  uint64_t key = 0;
  for (const int64_t index : cell) key = key << 21 | (static_cast<uint64_t>(index) & 0x1FFFFF);
  return key;
}

void NeighborGrid::within(const Double3& center, double radius_m, const std::function<void(size_t, double)>& visit) const {
  const Cell middle = cellOf(center);
  for (int64_t x = -1; x <= 1; ++x)
    for (int64_t y = -1; y <= 1; ++y)
      for (int64_t z = -1; z <= 1; ++z) {
        const auto found = ranges_.find(keyOf({middle[0] + x, middle[1] + y, middle[2] + z}));
        if (found == ranges_.end()) continue;
        for (size_t k = found->second.first; k < found->second.second; ++k) {
          const Double3& other = points_[order_[k]];
          double squared = 0;
          for (size_t axis = 0; axis < 3; ++axis) squared += (other[axis] - center[axis]) * (other[axis] - center[axis]);
          if (squared <= radius_m * radius_m) visit(order_[k], squared);
        }
      }
}

bool NeighborGrid::anyWithin(const Double3& center, double radius_m) const {
  bool any = false;
  within(center, radius_m, [&](size_t, double) { any = true; });
  return any;
}

Walls wallsOf(const Scene& scene) {
  Walls walls;
  if (!scene.domain) return walls;
  for (size_t axis = 0; axis < 3; ++axis) {
    walls.min[axis] = scene.domain->min[axis];
    walls.max[axis] = scene.domain->max[axis];
  }
  walls.closed = ~unsigned{scene.domain->open} & 63u;
  return walls;
}

std::vector<size_t> interiorParticles(const Cloud& cloud, const Walls& walls, double reach_m) {
  const double gap = kVoidRadius * cloud.spacing;
  const NeighborGrid grid(cloud.position, gap);
  const auto awayFromWalls = [&](const Double3& point) {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (walls.closed >> (2 * axis) & 1 && point[axis] - walls.min[axis] < reach_m) return false;
      if (walls.closed >> (2 * axis + 1) & 1 && walls.max[axis] - point[axis] < reach_m) return false;
    }
    return true;
  };
  const auto surrounded = [&](const Double3& point) {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          const double whole = reach_m / std::sqrt(double(x * x + y * y + z * z));
          for (const double scale : {whole, whole / 2})
            if (!grid.anyWithin({point[0] + scale * x, point[1] + scale * y, point[2] + scale * z}, gap)) return false;
        }
    return true;
  };
  std::vector<size_t> interior;
  for (size_t i = 0; i < cloud.size(); ++i)
    if (awayFromWalls(cloud.position[i]) && surrounded(cloud.position[i])) interior.push_back(i);
  return interior;
}

std::vector<double> wideDensity(const Cloud& cloud, std::span<const size_t> indices, double support_m) {
  const double rest = latticeSum(support_m / cloud.spacing);
  const NeighborGrid grid(cloud.position, support_m);
  std::vector<double> density;
  for (const size_t i : indices) {
    double sum = 0;
    grid.within(cloud.position[i], support_m, [&](size_t, double squared) { sum += wendland(std::sqrt(squared) / support_m); });
    density.push_back(sum / rest);
  }
  return density;
}

BulkDensity bulkDensity(const Cloud& cloud, const Walls& walls, double solver_support_m) {
  const double support = 2 * solver_support_m;
  const std::vector<size_t> interior = interiorParticles(cloud, walls, support);
  const std::vector<double> density = wideDensity(cloud, interior, support);
  BulkDensity bulk;
  bulk.particles = interior.size();
  double sum = 0, squares = 0;
  std::map<long, std::pair<double, size_t>> bins;
  for (size_t k = 0; k < interior.size(); ++k) {
    const double error = density[k] - 1;
    sum += error;
    squares += error * error;
    auto& [total, count] = bins[std::lround(std::floor(cloud.position[interior[k]][1] / (2 * cloud.spacing)))];
    total += error;
    ++count;
  }
  const double count = double(interior.size());
  bulk.error = interior.empty() ? kUnmeasured : sum / count;
  bulk.spread = interior.empty() ? kUnmeasured : std::sqrt(std::max(0.0, squares / count - bulk.error * bulk.error));
  for (const auto& [bin, content] : bins)
    bulk.profile.emplace_back((double(bin) + 0.5) * 2 * cloud.spacing, content.first / double(content.second));
  return bulk;
}

double clumpedFraction(const Cloud& cloud) {
  const double near = 0.5 * cloud.spacing;
  const NeighborGrid grid(cloud.position, cloud.spacing);
  size_t clumped = 0;
  for (const Double3& point : cloud.position) {
    size_t others = 0;
    grid.within(point, near, [&](size_t, double) { ++others; });
    if (others > 1) ++clumped;  // includes the particle itself
  }
  return double(clumped) / double(cloud.size());
}

double surfaceLevel(const Cloud& cloud, double floor_m, double min_x_m, double max_x_m) {
  const double reach = 2 * cloud.spacing;
  const NeighborGrid grid(cloud.position, reach);
  std::vector<double> heights;
  for (const Double3& point : cloud.position) {
    if (point[0] < min_x_m || point[0] > max_x_m) continue;
    bool covered = false;
    grid.within(point, reach, [&](size_t other, double squared) {
      const double rise = cloud.position[other][1] - point[1];
      covered = covered || (squared > 0 && rise > 0.8 * std::sqrt(squared));
    });
    if (!covered) heights.push_back(point[1] + 0.5 * cloud.spacing - floor_m);
  }
  if (heights.empty()) return kUnmeasured;
  const double highest = *std::ranges::max_element(heights);
  std::erase_if(heights, [&](double height) { return height < 0.5 * highest; });
  return std::accumulate(heights.begin(), heights.end(), 0.0) / double(heights.size());
}

double frontAlongX(const Cloud& cloud) {
  const NeighborGrid grid(cloud.position, 2 * cloud.spacing);
  std::vector<size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, std::greater{}, [&](size_t i) { return cloud.position[i][0]; });
  for (const size_t i : order) {
    size_t others = 0;
    grid.within(cloud.position[i], 2 * cloud.spacing, [&](size_t, double) { ++others; });
    if (others > 5) return cloud.position[i][0] + 0.5 * cloud.spacing;
  }
  return kUnmeasured;
}

double heightAtWall(const Cloud& cloud, double wall_m, double floor_m) {
  const double step = 1.5 * cloud.spacing;
  std::map<long, std::vector<double>> strips;  // heights of the particles per strip
  for (const Double3& point : cloud.position)
    if (point[0] - wall_m < step) strips[std::lround(std::floor(point[2] / (2 * cloud.spacing)))].push_back(point[1] - floor_m);
  double sum = 0;
  for (auto& [strip, heights] : strips) {
    std::ranges::sort(heights);
    double top = 0;
    long reached = -1;
    for (const double height : heights) {
      const long bin = std::lround(std::floor(height / step));
      if (bin > reached + 1) break;
      reached = bin;
      top = height + 0.5 * cloud.spacing;
    }
    sum += top;
  }
  return strips.empty() ? 0 : sum / double(strips.size());
}

double rmsSpeed(const Cloud& cloud) {
  double sum = 0;
  for (const Double3& velocity : cloud.velocity)
    for (const double component : velocity) sum += component * component;
  return std::sqrt(sum / double(cloud.size()));
}

Double3 meanPosition(const Cloud& cloud) { return mean(cloud.position); }
Double3 meanVelocity(const Cloud& cloud) { return mean(cloud.velocity); }

Double3 meanAngularMomentum(const Cloud& cloud) {
  const Double3 center = meanPosition(cloud);
  Double3 sum{};
  for (size_t i = 0; i < cloud.size(); ++i) {
    Double3 arm;
    for (size_t axis = 0; axis < 3; ++axis) arm[axis] = cloud.position[i][axis] - center[axis];
    const Double3& v = cloud.velocity[i];
    sum[0] += arm[1] * v[2] - arm[2] * v[1];
    sum[1] += arm[2] * v[0] - arm[0] * v[2];
    sum[2] += arm[0] * v[1] - arm[1] * v[0];
  }
  for (double& value : sum) value /= double(cloud.size());
  return sum;
}

}  // namespace rill::bench
