#include "offline/probes.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace rill::offline {
namespace {

constexpr uint32_t kFrontNeighbors = 5;  // ignores isolated particles
constexpr double kLevelBin = 1.5;        // spacings

float coordinate(const Float3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace

ProbeReader::ProbeReader(const Scene& scene, std::span<const Float3> positions, const Double3& origin)
    : positions_(positions), spacing_(scene.fluid.spacing), smoothing_(scene.fluid.spacing * scene.fluid.smoothing_ratio) {
  for (int axis = 0; axis < 3; ++axis) {
    minimum_[axis] = scene.domain ? scene.domain->min[axis] : 0.0;
    shift_[axis] = origin[axis] - minimum_[axis];
  }
}

ProbeReader::~ProbeReader() = default;

double ProbeReader::level(double x, double z) const {
  const double lineX = x - minimum_[0], lineZ = z - minimum_[2];
  std::vector<double> heights;
  for (const Float3& p : positions_) {
    const double dx = p.x + shift_[0] - lineX, dz = p.z + shift_[2] - lineZ, y = p.y + shift_[1];
    if (dx * dx + dz * dz <= spacing_ * spacing_ && y >= 0 && std::isfinite(y)) heights.push_back(y);
  }
  std::sort(heights.begin(), heights.end());
  double top = 0, filled = -1;  // filled: highest bin without an empty bin below
  for (const double y : heights) {
    const double bin = std::floor(y / (kLevelBin * spacing_));
    if (bin > filled + 1) break;
    filled = bin;
    top = y + 0.5 * spacing_;
  }
  return top;
}

double ProbeReader::front(Axis axis) const {
  const int component = static_cast<int>(axis) / 2;
  const float sign = static_cast<int>(axis) % 2 == 0 ? 1.0f : -1.0f;
  // A heap: one of the first few particles is usually the front, so a full sort is not needed.
  std::vector<std::pair<float, uint32_t>> farthest;
  farthest.reserve(positions_.size());
  for (uint32_t i = 0; i < positions_.size(); ++i) {
    const float value = sign * coordinate(positions_[i], component);
    if (std::isfinite(value)) farthest.emplace_back(value, i);
  }
  if (farthest.empty()) return 0;
  if (!neighbors_) neighbors_ = std::make_unique<NeighborCounter>(positions_, smoothing_);
  std::priority_queue queue(std::less<>{}, std::move(farthest));
  for (; !queue.empty(); queue.pop()) {
    const auto [value, index] = queue.top();
    if (neighbors_->count(index, kFrontNeighbors) < kFrontNeighbors) continue;
    return double(sign) * (double(value) + 0.5 * spacing_) + shift_[component];
  }
  return 0;
}

}  // namespace rill::offline
