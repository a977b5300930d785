// The passes that turn a fluid's surface into a mesh, in order.
#include <bit>

#include "graph/shader_pass.hpp"
#include "mesher/surface_mesher_impl.hpp"
#include "render/particle_count.hpp"

namespace rill {

/// The buffers of one frame.
struct SurfaceMesherImpl::Frame {
  MeshPush push{};
  BufferRef position, velocity, particleCount, counts, arguments, keys, sorted, order, ranks, reached, occupied, blocks, neighbors, binKeys,
      binOrder, start, places, ellipsoids, surface, states, mixed, nearBins, binLists, lists, field, table, cases, rowVertices,
      rowTriangles, firstVertex, edges, listed;
  SurfaceMesh mesh;
};

/// A pass of one dispatch over the frame's buffers, which shaders know by these names.
void SurfaceMesherImpl::add(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size,
                            Frame& f) const {
  addDispatch(graph, name, pipeline, size, f.push,
              {{"position", f.position},
               {"velocity", std::as_const(f.velocity)},
               {"particle_count", f.particleCount},
               {"counts", f.counts},
               {"arguments", f.arguments},
               {"keys", f.keys},
               {"sorted", f.sorted},
               {"order", f.order},
               {"ranks", f.ranks},
               {"reached", f.reached},
               {"occupied", f.occupied},
               {"listed", f.listed},
               {"blocks", f.blocks},
               {"neighbors", f.neighbors},
               {"bin_keys", f.binKeys},
               {"start", f.start},
               {"places", f.places},
               {"ellipsoids", f.ellipsoids},
               {"surface", f.surface},
               {"states", f.states},
               {"mixed", f.mixed},
               {"near_bins", f.nearBins},
               {"bin_lists", f.binLists},
               {"lists", f.lists},
               {"field", f.field},
               {"table", f.table},
               {"cases", f.cases},
               {"row_vertices", f.rowVertices},
               {"row_triangles", f.rowTriangles},
               {"first_vertex", f.firstVertex},
               {"edges", f.edges},
               {"vertex_position", f.mesh.positions},
               {"vertex_normal", f.mesh.normals},
               {"vertex_velocity", f.mesh.velocities},
               {"indices", f.mesh.indices}});
}

/// Over as many workgroups as the device has counted.
void SurfaceMesherImpl::addCounted(Graph& graph, std::string_view name, const ComputePipeline* pipeline, uint32_t arguments,
                                   Frame& frame) const {
  add(graph, name, pipeline, {frame.arguments, arguments * 4}, frame);
}

void SurfaceMesherImpl::makeBuffers(Graph& graph, Frame& f) const {
  const uint64_t particles = limits.capacity, blocks = limits.maxBlocks, bins = blocks * kMeshBlockBins, vertices = limits.maxVertices;
  f.counts = graph.create("mesh counts", {kMeshCountWords * 4});
  f.arguments = graph.create("mesh arguments", {kMeshArgumentWords * 4});
  f.keys = graph.create("mesh block keys", {particles * 4});
  f.reached = graph.create("mesh reached", {blocks * 4});
  f.occupied = graph.create("mesh occupied", {blocks * 4});
  f.blocks = graph.create("mesh blocks", {blocks * 4});
  f.neighbors = graph.create("mesh neighbors", {blocks * kMeshNeighbors * 4});
  f.binKeys = graph.create("mesh bin keys", {particles * 4});
  f.places = graph.create("mesh places", {particles * 16});
  f.ellipsoids = graph.create("mesh ellipsoids", {particles * 48});
  f.surface = graph.create("mesh surface bins", {bins * 4});
  f.states = graph.create("mesh states", {bins * 4});
  f.mixed = graph.create("mesh mixed bins", {bins * 4});
  f.nearBins = graph.create("mesh near bins", {bins * 4});
  f.binLists = graph.create("mesh bin lists", {bins * 8});
  f.lists = graph.create("mesh lists", {listed_ * 4});
  f.field = graph.create("mesh field", {corners_ * 4});
  f.cases = graph.create("mesh cases", {corners_ * 4});
  f.firstVertex = graph.create("mesh first vertices", {corners_ * 4});
  f.rowVertices = graph.create("mesh row vertices", {paddedWords(rows_ + 1) * 4});
  f.rowTriangles = graph.create("mesh row triangles", {paddedWords(rows_ + 1) * 4});
  f.edges = graph.create("mesh edges", {vertices * 4});
  f.mesh.positions = graph.create("mesh positions", {vertices * 16});
  f.mesh.normals = graph.create("mesh normals", {vertices * 16});
  f.mesh.velocities = graph.create("mesh velocities", {vertices * 16});
  f.mesh.indices = graph.create("mesh indices", {uint64_t{limits.maxTriangles} * 12});
  addFill(graph, "mesh clear",
          {{&f.counts, 0},
           {&f.arguments, 0},
           {&f.reached, 0},
           {&f.surface, 0},
           {&f.rowVertices, 0},
           {&f.rowTriangles, 0},
           {&f.field, std::bit_cast<uint32_t>(1.0f)}});  // outside
  f.table = graph.create("mesh table", {sizeof table_});
  graph.pass("mesh table", [&](Pass& pass) {
    f.table = pass.write(f.table, Use::CopyTarget, true);
    return [table = f.table, words = &table_](Commands& commands) { commands.update(table, std::as_bytes(std::span(*words))); };
  });
}

/// The distinct keys among `count` sorted ones, their number into a word of the counts.
void SurfaceMesherImpl::addDistinct(Graph& graph, Frame& f, BufferRef sorted, uint32_t count, BufferRef& listed, uint32_t word,
                                    const Scan& scan) const {
  const uint32_t capacity = f.push.capacity;
  f.push.capacity = count;
  f.push.list = word;
  f.sorted = sorted;
  f.ranks = graph.create("mesh ranks", {paddedWords(uint64_t{count} + 1) * 4});
  f.listed = listed;
  const uint64_t groups = divideUp(uint64_t{count} + 1, kMeshGroup);
  add(graph, "mesh flag", pipelines_.flag, groups, f);
  f.ranks = scan.addTo(graph, f.ranks);
  add(graph, "mesh compact", pipelines_.compact, groups, f);
  listed = f.listed;
  f.push.capacity = capacity;
}

/// The blocks that particles reach, sorted, and their neighbors.
void SurfaceMesherImpl::addBlocks(Graph& graph, Frame& f) const {
  const uint64_t overParticles = divideUp(limits.capacity, kMeshGroup), reached = uint64_t{limits.maxBlocks} * kMeshNeighbors;
  add(graph, "mesh keys", pipelines_.keys, overParticles, f);
  const SortedKeys byBlock = blockSort_->addTo(graph, f.keys);
  f.order = byBlock.order;
  addDistinct(graph, f, byBlock.keys, limits.capacity, f.occupied, kMeshOccupied, particleScan_);
  add(graph, "mesh reach", pipelines_.reach, overParticles, f);
  const BufferRef particleKeys = f.keys;
  f.keys = graph.create("mesh reached keys", {reached * 4});
  add(graph, "mesh dilate", pipelines_.dilate, divideUp(reached, kMeshGroup), f);
  const SortedKeys all = reachedSort_->addTo(graph, f.keys);
  f.keys = particleKeys;
  addDistinct(graph, f, all.keys, static_cast<uint32_t>(reached), f.blocks, kMeshBlocksNeeded, reachedScan_);
  add(graph, "mesh arguments", pipelines_.arguments, 1, f);
  addCounted(graph, "mesh neighbors", pipelines_.neighbors, kMeshNeighborGroups, f);
}

/// Particles sorted into the bins of the blocks.
void SurfaceMesherImpl::addBins(Graph& graph, Frame& f) const {
  const uint64_t overParticles = divideUp(limits.capacity, kMeshGroup);
  add(graph, "mesh bin keys", pipelines_.binKeys, overParticles, f);
  const SortedKeys byBin = binSort_->addTo(graph, f.binKeys);
  f.order = byBin.order;
  f.start = byBin.start;
  add(graph, "mesh gather", pipelines_.gather, overParticles, f);
}

void SurfaceMesherImpl::addMesh(Graph& graph, Frame& f) const {
  add(graph, "mesh ellipsoids", pipelines_.ellipsoids, divideUp(limits.capacity, kMeshGroup), f);
  addCounted(graph, "mesh states", pipelines_.states, kMeshBinGroups, f);
  addCounted(graph, "mesh mixed", pipelines_.mixed, kMeshBinGroups, f);
  add(graph, "mesh arguments", pipelines_.nearArguments, 1, f);
  addCounted(graph, "mesh lists", pipelines_.lists, kMeshNearGroups, f);
  addCounted(graph, "mesh field", pipelines_.field, kMeshCornerGroups, f);
  addCounted(graph, "mesh rows", pipelines_.rows, kMeshRowGroups, f);
  f.rowVertices = rowScan_.addTo(graph, f.rowVertices);
  f.rowTriangles = rowScan_.addTo(graph, f.rowTriangles);
  add(graph, "mesh finish", pipelines_.finish, 1, f);
  addCounted(graph, "mesh vertices", pipelines_.vertices, kMeshOutputGroups, f);
  addCounted(graph, "mesh triangles", pipelines_.triangles, kMeshOutputGroups, f);
  addCounted(graph, "mesh shade", pipelines_.shade, kMeshVertexGroups, f);
}

SurfaceMesh SurfaceMesherImpl::addTo(Graph& graph, const FluidState& fluid) {
  Frame frame;
  if (fluid.capacity == 0) {
    SurfaceMesh& empty = frame.mesh;
    for (BufferRef* each : {&empty.positions, &empty.normals, &empty.velocities, &empty.indices}) *each = graph.create("mesh empty", {16});
    empty.counts = graph.create("mesh counts", {kMeshCountWords * 4});
    addFill(graph, "mesh clear",
            {{&empty.positions, 0}, {&empty.normals, 0}, {&empty.velocities, 0}, {&empty.indices, 0}, {&empty.counts, 0}});
    return empty;
  }
  frame.push = {.spacing = fluid.spacing,
                .cell = static_cast<float>(limits.cell),
                .capacity = limits.capacity,
                .particles = fluid.capacity,
                .max_blocks = limits.maxBlocks,
                .max_vertices = limits.maxVertices,
                .max_triangles = limits.maxTriangles,
                .max_listed = static_cast<uint32_t>(listed_),
                .list = 0,
                .velocities = fluid.velocity == BufferRef{} ? 0u : 1u};
  frame.position = fluid.position;
  frame.velocity = fluid.velocity == BufferRef{} ? fluid.position : fluid.velocity;
  frame.particleCount = particleCount(graph, fluid);
  makeBuffers(graph, frame);
  addBlocks(graph, frame);
  addBins(graph, frame);
  addMesh(graph, frame);
  frame.mesh.counts = frame.counts;
  return frame.mesh;
}

}  // namespace rill
