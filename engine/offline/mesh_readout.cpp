#include "offline/mesh_readout.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>

namespace rill::offline {
namespace {

std::vector<Float3> vectors(std::span<const std::byte> bytes, size_t count, const Double3& origin) {
  std::vector<Float3> all(std::min(count, bytes.size() / sizeof(Float4)));
  for (size_t i = 0; i < all.size(); ++i) {
    Float4 v;
    std::memcpy(&v, bytes.data() + i * sizeof v, sizeof v);
    all[i] = {static_cast<float>(origin.x + double{v.x}), static_cast<float>(origin.y + double{v.y}),
              static_cast<float>(origin.z + double{v.z})};
  }
  return all;
}

}  // namespace

MeshTickets meshReadout(Graph& graph, const SurfaceMesh& mesh) {
  return {graph.readback(mesh.positions), graph.readback(mesh.normals), graph.readback(mesh.velocities), graph.readback(mesh.indices),
          graph.readback(mesh.counts)};
}

MeshReadout collect(const Graph& graph, const MeshTickets& tickets, const Double3& origin) {
  MeshReadout made;
  std::array<uint32_t, size_t(MeshCount::Words)> counts{};
  const auto bytes = graph.data(tickets.counts);
  std::memcpy(counts.data(), bytes.data(), std::min(bytes.size(), sizeof counts));
  const auto count = [&](MeshCount what) { return counts[size_t(what)]; };
  made.needed.maxBlocks = count(MeshCount::NeededBlocks);
  made.needed.maxVertices = count(MeshCount::NeededVertices);
  made.needed.maxTriangles = count(MeshCount::NeededTriangles);
  SurfaceTriangles& triangles = made.triangles;
  triangles.tooFar = count(MeshCount::TooFar);
  triangles.boundHits = count(MeshCount::BoundHits);
  const size_t vertices = count(MeshCount::Vertices);
  triangles.positions = vectors(graph.data(tickets.positions), vertices, origin);
  triangles.normals = vectors(graph.data(tickets.normals), vertices, {});
  triangles.velocities = vectors(graph.data(tickets.velocities), vertices, {});
  const auto indices = graph.data(tickets.indices);
  triangles.indices.resize(std::min<size_t>(count(MeshCount::Indices), indices.size() / sizeof(uint32_t)));
  if (!triangles.indices.empty()) std::memcpy(triangles.indices.data(), indices.data(), triangles.indices.size() * sizeof(uint32_t));
  return made;
}

bool fits(const SurfaceMesherDesc& needed, const SurfaceMesherDesc& limits) {
  return needed.maxBlocks <= limits.maxBlocks && needed.maxVertices <= limits.maxVertices && needed.maxTriangles <= limits.maxTriangles;
}

SurfaceMesherDesc roomFor(const SurfaceMesherDesc& needed, const SurfaceMesherDesc& limits) {
  SurfaceMesherDesc desc = limits;
  for (uint32_t SurfaceMesherDesc::*limit :
       {&SurfaceMesherDesc::maxBlocks, &SurfaceMesherDesc::maxVertices, &SurfaceMesherDesc::maxTriangles}) {
    const uint64_t wanted = uint64_t{needed.*limit} + needed.*limit / 4;
    desc.*limit = std::max(limits.*limit, static_cast<uint32_t>(std::min<uint64_t>(wanted, std::numeric_limits<uint32_t>::max())));
  }
  return desc;
}

}  // namespace rill::offline
