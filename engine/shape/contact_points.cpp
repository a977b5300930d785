#include "shape/contact_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vector_math.hpp"

namespace rill {
namespace {

std::vector<ContactPoint> pointsOf(const SphereShape& sphere) { return {{.center = {0, 0, 0}, .radius = sphere.radius}}; }

std::vector<ContactPoint> pointsOf(const BoxShape& box) {
  const Double3 half = halfExtents(box);
  const double smallest = std::min({half.x, half.y, half.z}), radius = 0.1 * smallest;
  std::array<int, 3> along{};  // points
  for (size_t a = 0; a < 3; ++a) along[a] = static_cast<int>(std::clamp(std::round(2 * half[a] / smallest) + 1, 3.0, 5.0));
  std::vector<ContactPoint> points;
  for (int i = 0; i < along[0]; ++i)
    for (int j = 0; j < along[1]; ++j)
      for (int k = 0; k < along[2]; ++k) {
        const std::array<int, 3> at = {i, j, k};
        bool surface = false;
        ContactPoint point{.radius = radius};
        for (size_t a = 0; a < 3; ++a) {
          surface |= at[a] == 0 || at[a] == along[a] - 1;
          point.center[a] = (half[a] - radius) * (2.0 * at[a] / (along[a] - 1) - 1);
        }
        if (surface) points.push_back(point);
      }
  return points;
}

/// Points of a triangle no farther apart than `step`, at most eight along an edge; its corners among them.
void addPoints(const Double3& a, const Double3& b, const Double3& c, double step, std::vector<Double3>& all) {
  const double longest = std::max({length(minus(b, a)), length(minus(c, b)), length(minus(a, c))});
  const int parts = static_cast<int>(std::clamp(std::ceil(longest / step), 1.0, 8.0));
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; i + j <= parts; ++j)
      all.push_back(rill::along(rill::along(a, double(i) / parts, minus(b, a)), double(j) / parts, minus(c, a)));
}

std::vector<ContactPoint> pointsOf(const MeshShape& shape) {
  const MeshData& data = shape.mesh->data();
  const double step = 0.25 * length(halfExtents(shape));
  std::vector<Double3> candidates;
  for (const auto& [a, b, c] : data.triangles) addPoints(data.vertices[a], data.vertices[b], data.vertices[c], step, candidates);
  std::vector<double> distance(candidates.size(), std::numeric_limits<double>::max());
  std::vector<ContactPoint> points;
  const Double3 middle = middleOf(shape);
  size_t next = 0;  // the farthest from the middle
  for (size_t k = 0; k < candidates.size(); ++k)
    if (length(minus(candidates[k], middle)) > length(minus(candidates[next], middle))) next = k;
  while (points.size() < kMaxContactPoints && distance[next] > 0.1 * step) {
    points.push_back({.center = candidates[next]});
    for (size_t k = 0; k < candidates.size(); ++k) distance[k] = std::min(distance[k], length(minus(candidates[k], points.back().center)));
    next = static_cast<size_t>(std::ranges::max_element(distance) - distance.begin());
  }
  return points;
}

}  // namespace

std::vector<ContactPoint> contactPoints(const Shape& shape) {
  return std::visit([](const auto& s) { return pointsOf(s); }, shape);
}

}  // namespace rill
