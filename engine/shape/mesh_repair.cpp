#include "shape/mesh_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>

#include "core/disjoint_sets.hpp"
#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "shape/mesh_edges.hpp"

namespace rill {
namespace {

Error badInput(const std::string& why) { return {ErrorKind::BadInput, why}; }

std::string trianglesText(size_t count) { return grouped(count) + (count == 1 ? " triangle" : " triangles"); }

/// The first edge that not as many triangles use in one direction as in the other.
const MeshEdge* unbalanced(const std::vector<MeshEdge>& edges) {
  const MeshEdge* first = nullptr;
  forEachGroup(edges, [&](std::span<const MeshEdge> group) {
    if (2 * std::ranges::count(group, true, &MeshEdge::forward) != std::ssize(group)) first = group.data();
    return first == nullptr;
  });
  return first;
}

/// Triangles that share an edge of exactly two.
std::vector<std::vector<std::pair<uint32_t, bool>>> neighborsOf(const std::vector<MeshEdge>& edges, size_t triangles) {
  std::vector<std::vector<std::pair<uint32_t, bool>>> neighbors(triangles);  // and whether one of the two has to be turned
  forEachGroup(edges, [&](std::span<const MeshEdge> group) {
    if (group.size() != 2) return true;
    const bool turned = group[0].forward == group[1].forward;
    neighbors[group[0].triangle].push_back({group[1].triangle, turned});
    neighbors[group[1].triangle].push_back({group[0].triangle, turned});
    return true;
  });
  return neighbors;
}

/// Twice the area of a triangle, along its normal.
Double3 areaOf(const MeshData& data, size_t triangle) {
  const auto& [a, b, c] = data.triangles[triangle];
  return cross(minus(data.vertices[b], data.vertices[a]), minus(data.vertices[c], data.vertices[a]));
}

/// Triangles that hang together by edges; each part by increasing index.
std::vector<std::vector<uint32_t>> partsOf(const std::vector<Triangle>& triangles) {
  DisjointSets sets(triangles.size());
  forEachGroup(sortedEdges(triangles), [&](std::span<const MeshEdge> group) {
    for (const MeshEdge& edge : group) sets.join(edge.triangle, group[0].triangle);
    return true;
  });
  std::unordered_map<uint32_t, size_t> known;
  std::vector<std::vector<uint32_t>> parts;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [at, fresh] = known.emplace(sets.root(t), parts.size());
    if (fresh) parts.emplace_back();
    parts[at->second].push_back(t);
  }
  return parts;
}

/// Whether a part whose triangles face inward borders on the outside: a cavity in another part does not.
bool bordersOutside(const MeshData& data, const TriangleTree& tree, const std::vector<uint32_t>& part) {
  return std::ranges::any_of(part, [&](uint32_t t) {
    const Double3 area = areaOf(data, t);
    const double size = length(area);
    if (!(size > 0)) return false;
    Double3 at = along({}, -1e-4 / std::sqrt(size), area);
    for (uint32_t corner : data.triangles[t]) at = along(at, 1.0 / 3, data.vertices[corner]);
    return tree.winding(at) == 0;
  });
}

void turn(MeshData& data, size_t triangle) {
  std::swap(data.triangles[triangle][1], data.triangles[triangle][2]);
  if (data.normals.empty()) return;
  std::swap(data.normals[3 * triangle + 1], data.normals[3 * triangle + 2]);
  const Double3 face = areaOf(data, triangle);
  for (size_t k = 0; k < 3; ++k)
    if (Float3& n = data.normals[3 * triangle + k]; face.x * n.x + face.y * n.y + face.z * n.z < 0) n = {-n.x, -n.y, -n.z};
}

struct HashOfPlace {
  size_t operator()(const Double3& p) const {
    size_t hash = 0;
    for (double x : p) hash = hash * 0x9E3779B97F4A7C15ULL + std::hash<double>()(x == 0 ? 0.0 : x);
    return hash;
  }
};

}  // namespace

Expected<void> checkMeshData(const MeshData& data) {
  constexpr size_t kMost = std::numeric_limits<uint32_t>::max() / 8;
  if (data.triangles.empty()) return badInput("found no triangles, expected a mesh");
  if (data.triangles.size() > kMost || data.vertices.size() > kMost)
    return badInput("found " + grouped(std::max(data.triangles.size(), data.vertices.size())) +
                    " triangles or vertices, expected at most " + grouped(kMost));
  if (!data.normals.empty() && data.normals.size() != 3 * data.triangles.size())
    return badInput("found " + grouped(data.normals.size()) + " normals, expected three a triangle, or none");
  if (!data.colors.empty() && data.colors.size() != data.triangles.size())
    return badInput("found " + grouped(data.colors.size()) + " colors, expected one a triangle, or none");
  for (size_t v = 0; v < data.vertices.size(); ++v)
    for (double x : data.vertices[v])
      if (!(std::abs(x) <= std::numeric_limits<float>::max()))
        return badInput("vertex " + std::to_string(v) + ": found the coordinate " + shortestNumber(x) + ", expected a 32-bit float");
  for (size_t t = 0; t < data.triangles.size(); ++t)
    for (uint32_t corner : data.triangles[t])
      if (corner >= data.vertices.size())
        return badInput("triangle " + std::to_string(t) + ": found the vertex " + std::to_string(corner) + ", expected an index below " +
                        std::to_string(data.vertices.size()));
  return {};
}

void weld(MeshData& data, std::vector<std::string>& warnings) {
  std::unordered_map<Double3, uint32_t, HashOfPlace> known;
  std::vector<Double3> vertices;
  std::vector<uint32_t> number;
  for (const Double3& v : data.vertices) {
    const auto [at, fresh] = known.emplace(v, static_cast<uint32_t>(vertices.size()));
    if (fresh) vertices.push_back(v);
    number.push_back(at->second);
  }
  data.vertices = std::move(vertices);
  size_t kept = 0;
  for (size_t t = 0; t < data.triangles.size(); ++t) {
    Triangle corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = number[data.triangles[t][k]];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    data.triangles[kept] = corners;
    if (!data.colors.empty()) data.colors[kept] = data.colors[t];
    for (size_t k = 0; k < 3 && !data.normals.empty(); ++k) data.normals[3 * kept + k] = data.normals[3 * t + k];
    ++kept;
  }
  if (const size_t dropped = data.triangles.size() - kept; dropped > 0)
    warnings.push_back(trianglesText(dropped) + " with coinciding corners dropped");
  data.triangles.resize(kept);
  if (!data.colors.empty()) data.colors.resize(kept);
  if (!data.normals.empty()) data.normals.resize(3 * kept);
}

Expected<void> orient(MeshData& data, std::vector<std::string>& warnings) {
  std::vector<MeshEdge> edges = sortedEdges(data.triangles);
  const MeshEdge* open = nullptr;
  size_t count = 0;
  forEachGroup(edges, [&](std::span<const MeshEdge> group) {
    if (group.size() % 2 == 0) return true;
    if (open == nullptr) open = group.data();
    ++count;
    return true;
  });
  if (open != nullptr)
    return badInput("the mesh is not closed: found " + grouped(count) + (count == 1 ? " open edge" : " open edges") + ", the first from " +
                    roundedPlace(data.vertices[open->low]) + " to " + roundedPlace(data.vertices[open->high]) +
                    "; expected a closed mesh, or \"two_sided\": true for a sheet");
  if (unbalanced(edges) == nullptr) return {};
  const auto neighbors = neighborsOf(edges, data.triangles.size());
  std::vector<int> turned(data.triangles.size(), -1);
  std::vector<uint32_t> pending;
  size_t total = 0;
  for (uint32_t seed = 0; seed < data.triangles.size(); ++seed) {
    if (turned[seed] >= 0) continue;
    std::vector<uint32_t> part{seed};
    turned[seed] = 0;
    size_t turns = 0;
    for (size_t n = 0; n < part.size(); ++n)
      for (const auto& [other, against] : neighbors[part[n]]) {
        if (turned[other] >= 0) continue;
        turned[other] = turned[part[n]] ^ static_cast<int>(against);
        turns += static_cast<size_t>(turned[other]);
        part.push_back(other);
      }
    if (2 * turns > part.size())  // the fewer ones
      for (uint32_t t : part) turned[t] ^= 1;
    total += std::min(turns, part.size() - turns);
  }
  for (uint32_t t = 0; t < data.triangles.size(); ++t)
    if (turned[t] == 1) turn(data, t);
  edges = sortedEdges(data.triangles);
  if (const MeshEdge* bad = unbalanced(edges))
    return badInput("the triangles face in contradictory directions, first at the edge from " + roundedPlace(data.vertices[bad->low]) +
                    " to " + roundedPlace(data.vertices[bad->high]) + "; expected a mesh with an inside and an outside");
  warnings.push_back(trianglesText(total) + " turned to face as their neighbors do");
  return {};
}

void turnInvertedParts(MeshData& data, std::vector<std::string>& warnings) {
  std::vector<uint32_t> inverted;
  std::optional<TriangleTree> tree;
  for (const std::vector<uint32_t>& part : partsOf(data.triangles)) {
    if (signedVolume(data, part) >= 0) continue;
    if (!tree) tree.emplace(data.vertices, data.triangles);
    if (bordersOutside(data, *tree, part)) inverted.insert(inverted.end(), part.begin(), part.end());
  }
  for (uint32_t t : inverted) turn(data, t);
  if (inverted.size() == data.triangles.size())
    warnings.push_back("the mesh was inside out: all triangles turned");
  else if (!inverted.empty())
    warnings.push_back("parts of the mesh were inside out: " + trianglesText(inverted.size()) + " turned");
}

double signedVolume(const MeshData& data, std::span<const uint32_t> triangles) {
  const Double3 origin = triangles.empty() ? Double3{} : data.vertices[data.triangles[triangles[0]][0]];
  double sum = 0;
  for (uint32_t t : triangles) sum += dot(minus(data.vertices[data.triangles[t][0]], origin), areaOf(data, t));
  return sum / 6;
}

}  // namespace rill
