#include "scene/polygon.hpp"

#include <cmath>
#include <numeric>

namespace rill {
namespace {

struct PlanePoint {
  double x = 0, y = 0;
  friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

/// Twice the signed area of a triangle.
double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The corners without the axis that the polygon faces most, so that its direction becomes counterclockwise.
std::vector<PlanePoint> projected(std::span<const Double3> corners) {
  Double3 normal;  // Newell's method
  for (size_t i = 0; i < corners.size(); ++i) {
    const Double3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    normal.x += (a.y - b.y) * (a.z + b.z - 2 * corners[0].z);
    normal.y += (a.z - b.z) * (a.x + b.x - 2 * corners[0].x);
    normal.z += (a.x - b.x) * (a.y + b.y - 2 * corners[0].y);
  }
  size_t axis = std::abs(normal.x) > std::abs(normal.y) ? 0 : 1;
  if (std::abs(normal.z) > std::abs(normal[axis])) axis = 2;
  size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<PlanePoint> points;
  for (const Double3& corner : corners) points.push_back({corner[u], corner[v]});
  return points;
}

bool isConvex(const std::vector<PlanePoint>& points) {
  for (size_t i = 0, n = points.size(); i < n; ++i) {
    if (turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0) return false;
  }
  return true;
}

/// Whether the corner at `at` of those that are left can be cut off: it is convex, and no other corner is in its triangle.
bool isEar(const std::vector<PlanePoint>& points, const std::vector<uint32_t>& left, size_t at) {
  const size_t n = left.size();
  const PlanePoint &a = points[left[(at + n - 1) % n]], &b = points[left[at]], &c = points[left[(at + 1) % n]];
  if (!(turn(a, b, c) > 0)) return false;
  for (const uint32_t other : left) {
    const PlanePoint& p = points[other];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const Double3> corners, std::vector<std::array<uint32_t, 3>>& triangles) {
  triangles.clear();
  std::vector<uint32_t> left(corners.size());
  std::iota(left.begin(), left.end(), 0U);
  if (corners.size() > 3 && corners.size() <= kMaxClippedCorners) {
    const std::vector<PlanePoint> points = projected(corners);
    for (bool found = !isConvex(points); found && left.size() > 3;) {
      found = false;
      for (size_t at = 0; at < left.size() && !found; ++at) {
        if (!isEar(points, left, at)) continue;
        const size_t n = left.size();
        triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
        left.erase(left.begin() + static_cast<ptrdiff_t>(at));
        found = true;
      }
    }
  }
  for (size_t i = 2; i < left.size(); ++i) triangles.push_back({left[0], left[i - 1], left[i]});
}

}  // namespace rill
