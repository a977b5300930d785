#include "fill/mesh_mouth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh_plane.hpp"
#include "core/vector_math.hpp"
#include "shape/mesh_edges.hpp"
#include "shape/pose.hpp"

namespace rill {
namespace {

/// Where an edge crosses a row, the same of its two triangles: from its lower end.
double crossing(const MouthPoint& a, const MouthPoint& b, double y) {
  const MouthPoint &low = std::pair(a[1], a[0]) < std::pair(b[1], b[0]) ? a : b, &high = &low == &a ? b : a;
  return low[0] + (high[0] - low[0]) * ((y - low[1]) / (high[1] - low[1]));
}

/// Calls visit(row, first column, column behind the last) for the rows of a lattice in a triangle. What is on an edge is in the triangle
/// above or to the right of it.
template <class Visit>
void forEachRow(const std::array<MouthPoint, 3>& t, const MouthGrid& grid, const Visit& visit) {
  const auto [low, high] = std::minmax({t[0][1], t[1][1], t[2][1]});
  const double last = std::ceil((high - grid.first[1]) / grid.pitch[1]);  // more by one at either end, whatever the rounding
  for (double row = std::floor((low - grid.first[1]) / grid.pitch[1]); row <= last; ++row) {
    const double y = grid.first[1] + row * grid.pitch[1];
    double from = std::numeric_limits<double>::infinity(), to = -from;
    for (size_t k = 0; k < 3; ++k) {
      const MouthPoint &a = t[k], &b = t[(k + 1) % 3];
      if ((a[1] <= y) == (b[1] <= y)) continue;
      const double x = crossing(a, b, y);
      from = std::min(from, x), to = std::max(to, x);
    }
    const double begin = std::ceil((from - grid.first[0]) / grid.pitch[0]), end = std::ceil((to - grid.first[0]) / grid.pitch[0]);
    if (begin < end) visit(row, begin, end);
  }
}

double areaOf(const std::array<MouthPoint, 3>& t) {
  return std::abs((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1])) / 2;
}

}  // namespace

FlatMouth flatMouth(const MeshMouth& mouth) {
  const MeshData& data = mouth.mesh->data();
  const MeshPlane plane = planeOf(data);
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  forEachGroup(sortedEdges(data.triangles), [&](std::span<const MeshEdge> group) {
    if (group.size() == 1) edges.emplace_back(group[0].low, group[0].high);
    return true;
  });
  Double3 longest = cross(std::abs(plane.normal.y) < 0.9 ? Double3{0, 1, 0} : Double3{0, 0, 1}, plane.normal);
  double length2 = 0;
  constexpr double kLonger = 1 + 1e-9;  // the first of edges that are equal but for rounding
  for (const auto& [a, b] : edges) {
    const Double3 edge = minus(data.vertices[b], data.vertices[a]), flat = along(edge, -dot(edge, plane.normal), plane.normal);
    if (dot(flat, flat) > kLonger * length2) longest = flat, length2 = dot(flat, flat);
  }
  const Double3 across = normalized(longest), up = cross(across, plane.normal);
  FlatMouth flat{.area = plane.area, .low = {0, 0}, .high = {0, 0}};
  const auto inPlane = [&](uint32_t vertex) {
    const Double3 from = minus(data.vertices[vertex], plane.center);
    return MouthPoint{dot(from, across), dot(from, up)};
  };
  for (const auto& [a, b, c] : data.triangles) {
    flat.triangles.push_back({inPlane(a), inPlane(b), inPlane(c)});
    for (const MouthPoint& corner : flat.triangles.back())
      for (size_t k = 0; k < 2; ++k) flat.low[k] = std::min(flat.low[k], corner[k]), flat.high[k] = std::max(flat.high[k], corner[k]);
  }
  for (const auto& [a, b] : edges) flat.outline.push_back({inPlane(a), inPlane(b)});
  const Pose pose{.center = mouth.translation, .rotation = mouth.rotation};
  flat.center = along(mouth.translation, 1, toScene(pose, plane.center));
  flat.normal = toScene(pose, plane.normal), flat.across = toScene(pose, across), flat.up = toScene(pose, up);
  return flat;
}

MouthSum sumIn(const FlatMouth& mouth, const MouthGrid& grid) {
  MouthSum sum;
  for (const auto& t : mouth.triangles)
    forEachRow(t, grid, [&](double row, double begin, double end) {
      const double count = end - begin;
      sum.count += count;
      sum.moment[0] += count * (grid.first[0] + grid.pitch[0] * (begin + end - 1) / 2);
      sum.moment[1] += count * (grid.first[1] + grid.pitch[1] * row);
    });
  return sum;
}

std::vector<MouthPoint> pointsIn(const FlatMouth& mouth, const MouthGrid& grid, size_t* shared) {
  std::vector<MouthPoint> points;
  for (const auto& t : mouth.triangles)
    forEachRow(t, grid, [&](double row, double begin, double end) {
      for (double column = begin; column < end; ++column) points.push_back({row, column});
    });
  std::ranges::sort(points);
  const auto rest = std::unique(points.begin(), points.end());
  if (shared != nullptr) *shared = static_cast<size_t>(points.end() - rest);
  points.erase(rest, points.end());
  for (MouthPoint& p : points) p = {grid.first[0] + p[1] * grid.pitch[0], grid.first[1] + p[0] * grid.pitch[1]};
  return points;
}

double rowsOf(const FlatMouth& mouth, double pitch) {
  double rows = 0;
  for (const auto& t : mouth.triangles) {
    const auto [low, high] = std::minmax({t[0][1], t[1][1], t[2][1]});
    rows += 1 + (high - low) / pitch;
  }
  return rows;
}

MouthPoint middleOf(const FlatMouth& mouth) {
  const auto largest = std::ranges::max_element(mouth.triangles, {}, [](const auto& t) { return areaOf(t); });
  const auto& [a, b, c] = *largest;
  return {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3};
}

Double3 inScene(const FlatMouth& mouth, const MouthPoint& point) {
  return along(along(mouth.center, point[0], mouth.across), point[1], mouth.up);
}

}  // namespace rill
