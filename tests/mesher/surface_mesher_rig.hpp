#pragma once
// Meshes of points made on the device, and what must hold of any.
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <vector>

#include "reference/surface_mesh.hpp"
#include "rill/surface_mesher.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace surface_mesher_test {

using reference::SurfaceMesh;
using Points = std::vector<glm::dvec3>;

inline constexpr double kSpacing = 0.05;

struct Made {
  SurfaceMesh mesh;  ///< in spacings, velocities as given
  std::vector<uint32_t> counts;
  std::vector<std::byte> bytes;  ///< all of it, to compare
  uint32_t count(MeshCount what) const { return counts[size_t(what)]; }
};

class SurfaceMesherTest : public GpuTest {
 protected:
  /// `points`, `velocities`: in spacings, and in m/s.
  Made make(const Points& points, SurfaceMesherDesc desc = {}, const Points& velocities = {}, uint32_t spare = 0) {
    const auto count = static_cast<uint32_t>(points.size());
    if (desc.capacity == 0) desc.capacity = std::max(count + spare, 1u);
    auto mesher = SurfaceMesher::create(device(), desc);
    EXPECT_TRUE(mesher) << mesher.error().message;
    std::vector<Float4> position, velocity;
    for (const auto& p : points) position.push_back({float(p.x * kSpacing), float(p.y * kSpacing), float(p.z * kSpacing), 7});
    for (const auto& v : velocities) velocity.push_back({float(v.x), float(v.y), float(v.z), 1});
    for (uint32_t k = 0; k < spare; ++k) position.push_back({1e9f, 1e9f, 1e9f, 0});
    Buffer positions = upload("position", position.empty() ? std::vector<Float4>(1) : position), moving, number;
    Graph graph;
    FluidState state;
    state.capacity = count + spare;
    state.spacing = float(kSpacing);
    state.position = graph.import("position", importOf(positions));
    if (!velocity.empty()) {
      moving = upload("velocity", velocity);
      state.velocity = graph.import("velocity", importOf(moving));
    }
    if (spare > 0) {
      number = upload("count", std::vector<uint32_t>{count});
      state.countBuffer = graph.import("count", importOf(number));
    }
    const rill::SurfaceMesh made = mesher->addTo(graph, state);
    const Ticket tickets[] = {graph.readback(made.counts), graph.readback(made.positions), graph.readback(made.normals),
                              graph.readback(made.velocities), graph.readback(made.indices)};
    run(graph);
    Made out;
    out.counts = read<uint32_t>(graph, tickets[0]);
    if (out.counts.size() < size_t(MeshCount::Words)) {
      ADD_FAILURE() << "no counts";
      out.counts.resize(size_t(MeshCount::Words));
      return out;
    }
    const size_t vertices = out.count(MeshCount::Vertices), indices = out.count(MeshCount::Indices);
    const auto part = [&](size_t which, Points& to, double scale) {
      const auto from = read<Float4>(graph, tickets[which]);
      for (size_t i = 0; i < vertices; ++i) to.push_back(scale * glm::dvec3(from[i].x, from[i].y, from[i].z));
      const auto raw = std::as_bytes(std::span(from)).first(vertices * 16);
      out.bytes.insert(out.bytes.end(), raw.begin(), raw.end());
    };
    part(1, out.mesh.positions, 1 / kSpacing);
    part(2, out.mesh.normals, 1);
    part(3, out.mesh.velocities, 1);
    const auto index = read<uint32_t>(graph, tickets[4]);
    for (size_t i = 0; i + 2 < indices; i += 3) out.mesh.triangles.push_back({index[i], index[i + 1], index[i + 2]});
    const auto raw = std::as_bytes(std::span(index)).first(indices * 4);
    out.bytes.insert(out.bytes.end(), raw.begin(), raw.end());
    return out;
  }
};

/// Every side of a triangle belongs to one other, in the opposite direction, and every vertex to triangles around it.
inline void expectClosed(const SurfaceMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  std::vector<uint32_t> around(mesh.positions.size(), 0);
  for (const auto& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k) {
      ASSERT_LT(t[k], mesh.positions.size());
      ++around[t[k]];
      ++sides[{t[k], t[(k + 1) % 3]}];
    }
  size_t open = 0;
  for (const auto& [side, times] : sides) open += times != 1 || !sides.contains({side.second, side.first}) ? 1 : 0;
  EXPECT_EQ(open, 0u);
  for (const uint32_t triangles : around) ASSERT_GE(triangles, 3u);
  for (const auto& p : mesh.positions) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  for (const auto& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-5);
}

inline double volumeError(const Made& made, size_t particles) { return reference::enclosedVolume(made.mesh) / double(particles) - 1; }

inline Points block(int x, int y, int z, double jitter = 0, uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-jitter, jitter);
  Points points;
  for (int i = 0; i < x; ++i)
    for (int j = 0; j < y; ++j)
      for (int k = 0; k < z; ++k) points.push_back({i + 0.21 + off(random), j + 0.33 + off(random), k + 0.41 + off(random)});
  return points;
}

inline Points ball(double radius) {
  Points points;
  const int n = static_cast<int>(radius) + 1;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k)
        if (const glm::dvec3 x(i + 0.5, j + 0.5, k + 0.5); glm::length(x) < radius) points.push_back(x);
  return points;
}

}  // namespace surface_mesher_test
}  // namespace rill::test
