#include "shape/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/vector_math.hpp"

namespace rill {
namespace {

constexpr uint32_t kLeaf = 4;     // triangles
constexpr size_t kMaxDepth = 64;  // halves of 2^32 triangles, and room

Double3 nearestOnSegment(const Double3& p, const Double3& a, const Double3& b) {
  const Double3 edge = minus(b, a);
  const double square = dot(edge, edge);
  return along(a, square > 0 ? std::clamp(dot(minus(p, a), edge) / square, 0.0, 1.0) : 0.0, edge);
}

/// By the region of the triangle's plane that `p` is over: a corner, an edge or the face.
Double3 nearestOnTriangle(const Double3& p, const Double3& a, const Double3& b, const Double3& c) {
  const Double3 ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const double ab_a = dot(ab, ap), ac_a = dot(ac, ap);
  if (ab_a <= 0 && ac_a <= 0) return a;
  const double ab_b = ab_a - dot(ab, ab), ac_b = ac_a - dot(ac, ab);
  if (ab_b >= 0 && ac_b <= ab_b) return b;
  const double ab_c = ab_a - dot(ab, ac), ac_c = ac_a - dot(ac, ac);
  if (ac_c >= 0 && ab_c <= ac_c) return c;
  // Areas opposite to the corners, over that of the triangle once they are divided by their sum.
  const double atA = ab_b * ac_c - ab_c * ac_b, atB = ab_c * ac_a - ab_a * ac_c, atC = ab_a * ac_b - ab_b * ac_a, sum = atA + atB + atC;
  if (atC <= 0 && ab_a >= 0 && ab_b <= 0) return nearestOnSegment(p, a, b);
  if (atB <= 0 && ac_a >= 0 && ac_c <= 0) return nearestOnSegment(p, a, c);
  if (atA <= 0 && ac_b >= ab_b && ab_c >= ac_c) return nearestOnSegment(p, b, c);
  if (!(sum > 0)) return nearestOnSegment(p, b, c);  // no area
  return along(along(a, atB / sum, ab), atC / sum, ac);
}

double squaredDistance(const Double3& p, const Double3& low, const Double3& high) {
  double sum = 0;
  for (size_t a = 0; a < 3; ++a) {
    const double beyond = std::max({low[a] - p[a], p[a] - high[a], 0.0});
    sum += beyond * beyond;
  }
  return sum;
}

/// Twice the area of a point and an edge, seen along x, and its sign.
struct Side {
  double area = 0;
  bool left = false, right = false;
};

/// Of the edge from `u` to `v`. In the other direction it is exactly the negative, whatever the rounding: one of the two is computed.
Side sideOf(const Double3& p, const Double3& u, const Double3& v) {
  const bool forward = std::tie(u.x, u.y, u.z) < std::tie(v.x, v.y, v.z);
  const Double3 &a = forward ? u : v, &b = forward ? v : u;
  const double first = (a.y - p.y) * (b.z - p.z), second = (a.z - p.z) * (b.y - p.y);
  const double area = first - second;
  const double sign = first != second ? area : a.z != b.z ? a.z - b.z : b.y - a.y;  // the point moves along y, and less along z
  return {forward ? area : -area, forward ? sign > 0 : sign < 0, forward ? sign < 0 : sign > 0};
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Double3>& vertices, const std::vector<Triangle>& triangles) {
  triangles_.reserve(triangles.size());
  for (const Triangle& t : triangles) triangles_.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
  if (triangles.empty()) return;
  nodes_.reserve(2 * triangles.size() / kLeaf + 2);
  nodes_.emplace_back();
  build(0, 0, static_cast<uint32_t>(triangles.size()));
}

void TriangleTree::build(uint32_t node, uint32_t first, uint32_t count) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const auto center = [](const Corners& c, size_t axis) { return c[0][axis] + c[1][axis] + c[2][axis]; };  // three times it
  Double3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar}, centerLow = low, centerHigh = high;
  for (uint32_t n = first; n < first + count; ++n)
    for (size_t a = 0; a < 3; ++a) {
      for (const Double3& corner : triangles_[n]) {
        low[a] = std::min(low[a], corner[a]);
        high[a] = std::max(high[a], corner[a]);
      }
      centerLow[a] = std::min(centerLow[a], center(triangles_[n], a));
      centerHigh[a] = std::max(centerHigh[a], center(triangles_[n], a));
    }
  nodes_[node] = {.low = low, .high = high, .first = first, .count = count};
  if (count <= kLeaf) return;
  size_t axis = 0;
  for (size_t a = 1; a < 3; ++a)
    if (centerHigh[a] - centerLow[a] > centerHigh[axis] - centerLow[axis]) axis = a;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](const Corners& a, const Corners& b) { return center(a, axis) < center(b, axis); });
  const auto child = static_cast<uint32_t>(nodes_.size());
  nodes_[node].count = 0;
  nodes_[node].child = child;
  nodes_.resize(nodes_.size() + 2);
  build(child, first, count / 2);
  build(child + 1, first + count / 2, count - count / 2);
}

void TriangleTree::take(uint32_t triangle, const Double3& at, NearestPoint& best) const {
  const Double3 q = nearestOnTriangle(at, triangles_[triangle][0], triangles_[triangle][1], triangles_[triangle][2]), r = minus(at, q);
  if (const double squared = dot(r, r); squared < best.squared) best = {squared, q, triangle};
}

NearestPoint TriangleTree::nearest(const Double3& at, uint32_t guess) const {
  NearestPoint best;
  if (nodes_.empty()) return best;
  take(guess, at, best);
  std::array<std::pair<uint32_t, double>, kMaxDepth> stack;
  size_t depth = 0;
  stack[depth++] = {0, squaredDistance(at, nodes_[0].low, nodes_[0].high)};
  while (depth > 0) {
    const auto [index, near] = stack[--depth];
    if (near >= best.squared) continue;
    const Node& node = nodes_[index];
    for (uint32_t n = node.first; n < node.first + node.count; ++n) take(n, at, best);
    if (node.count > 0) continue;
    std::pair<uint32_t, double> a{node.child, 0}, b{node.child + 1, 0};
    for (auto* child : {&a, &b}) child->second = squaredDistance(at, nodes_[child->first].low, nodes_[child->first].high);
    if (a.second < b.second) std::swap(a, b);
    stack[depth++] = a;  // the nearer one is taken first
    stack[depth++] = b;
  }
  return best;
}

void TriangleTree::crossings(const Double3& at, std::vector<Crossing>& out) const {
  out.clear();
  if (nodes_.empty()) return;
  std::array<uint32_t, kMaxDepth> stack;
  size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (at.y < node.low.y || at.y > node.high.y || at.z < node.low.z || at.z > node.high.z) continue;
    for (uint32_t n = node.first; n < node.first + node.count; ++n) {
      const Corners& t = triangles_[n];
      bool front = true, back = true;
      double whole = 0, weighted = 0;
      for (size_t k = 0; k < 3; ++k) {  // the edge opposite to corner k
        const Side side = sideOf(at, t[(k + 1) % 3], t[(k + 2) % 3]);
        front = front && side.left;
        back = back && side.right;
        whole += side.area;
        weighted += side.area * t[k].x;
      }
      if (!front && !back) continue;
      const double x = whole != 0 ? weighted / whole : t[0].x;
      out.push_back({x, front ? 1 : -1});
    }
    if (node.count > 0) continue;
    stack[depth++] = node.child;
    stack[depth++] = node.child + 1;
  }
}

int TriangleTree::winding(const Double3& at) const {
  thread_local std::vector<Crossing> all;
  crossings(at, all);
  int sum = 0;
  for (const Crossing& crossing : all)
    if (crossing.x > at.x) sum += crossing.sign;
  return sum;
}

std::optional<double> TriangleTree::firstHit(const Double3& from, const Double3& direction) const {
  std::optional<double> first;
  if (nodes_.empty()) return first;
  std::array<uint32_t, kMaxDepth> stack;
  size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    double begin = 0, end = first.value_or(std::numeric_limits<double>::infinity());
    for (size_t a = 0; a < 3; ++a) {
      if (direction[a] == 0) {
        if (from[a] < node.low[a] || from[a] > node.high[a]) end = -1;
        continue;
      }
      const double s = (node.low[a] - from[a]) / direction[a], t = (node.high[a] - from[a]) / direction[a];
      begin = std::max(begin, std::min(s, t));
      end = std::min(end, std::max(s, t));
    }
    if (begin > end) continue;
    for (uint32_t n = node.first; n < node.first + node.count; ++n) {
      const auto& [a, b, c] = triangles_[n];
      const Double3 u = minus(b, a), v = minus(c, a);
      const Double3 p = cross(direction, v), r = minus(from, a), q = cross(r, u);
      const double determinant = dot(u, p);
      if (determinant == 0) continue;
      const double s = dot(r, p) / determinant, t = dot(direction, q) / determinant, hit = dot(v, q) / determinant;
      if (s >= 0 && t >= 0 && s + t <= 1 && hit > 0 && (!first || hit < *first)) first = hit;
    }
    if (node.count > 0) continue;
    stack[depth++] = node.child;
    stack[depth++] = node.child + 1;
  }
  return first;
}

}  // namespace rill
