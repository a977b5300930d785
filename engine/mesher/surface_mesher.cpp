#include "rill/surface_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/words.hpp"
#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/graph_impl.hpp"
#include "graph/shader_pass.hpp"
#include "mesher/cube_table.hpp"
#include "mesher/surface_mesher_impl.hpp"
#include "render/check_input.hpp"
#include "render/particle_count.hpp"

namespace rill {
namespace {

constexpr uint32_t kMaxMeshParticles = 1u << 22;
constexpr uint64_t kMaxMeshCorners = 1u << 30;  // an edge is a corner and two bits for its axis

Error meshError(ErrorKind kind, const std::string& message) { return {kind, "surface mesher: " + message}; }

Expected<void> checkRanges(const SurfaceMesherDesc& desc) {
  if (desc.capacity < 1 || desc.capacity > kMaxMeshParticles)
    return meshError(ErrorKind::BadInput,
                     "capacity is " + grouped(desc.capacity) + "; expected 1 to " + grouped(kMaxMeshParticles) + " particles");
  if (!(desc.cell >= 0.25 && desc.cell <= 1))
    return meshError(ErrorKind::BadInput, "cell is " + shortestNumber(desc.cell) + "; expected 0.25 to 1 (spacings)");
  return {};
}

/// Limits that suit scenes with a surface like that of splashing water in a box.
SurfaceMesherDesc withDefaults(SurfaceMesherDesc desc) {
  const double particles = desc.capacity, finer = 0.25 / (desc.cell * desc.cell);
  const double vertices = std::min(20 * particles, 120 * std::cbrt(particles * particles) + 4096) * finer + 256;
  if (desc.maxBlocks == 0) desc.maxBlocks = desc.capacity / 16 + 512;
  if (desc.maxVertices == 0) desc.maxVertices = static_cast<uint32_t>(vertices);
  if (desc.maxTriangles == 0) desc.maxTriangles = static_cast<uint32_t>(std::min<uint64_t>(2 * uint64_t{desc.maxVertices}, UINT32_MAX / 3));
  return desc;
}

}  // namespace

/// The buffers of one frame.
struct SurfaceMesherImpl::Frame {
  MeshPush push{};
  BufferRef position, velocity, particleCount, counts, arguments, keys, sorted, order, ranks, reached, occupied, blocks, neighbors, binKeys,
      binOrder, start, places, ellipsoids, surface, states, mixed, field, table, cases, rowVertices, rowTriangles, firstVertex, edges,
      listed;
  SurfaceMesh mesh;
};

Expected<std::unique_ptr<SurfaceMesherImpl>> SurfaceMesherImpl::create(Device& device, const SurfaceMesherDesc& desc) {
  if (auto valid = checkRanges(desc); !valid) return valid.error();
  auto impl = std::make_unique<SurfaceMesherImpl>();
  impl->limits = withDefaults(desc);
  const SurfaceMesherDesc& limits = impl->limits;
  impl->binCells_ = static_cast<uint32_t>(std::ceil(1 / desc.cell - 1e-6));
  const uint64_t blockCells = 4 * uint64_t{impl->binCells_}, blocks = limits.maxBlocks, particles = limits.capacity;
  impl->rows_ = blocks * blockCells * blockCells;
  impl->corners_ = impl->rows_ * blockCells;
  const uint64_t reached = blocks * kMeshNeighbors;
  impl->sizes_ = {{"mesh blocks", blocks * 4},
                  {"mesh reached keys", reached * 4 * 4},
                  {"mesh bins", (blocks * kMeshBlockBins + 2) * 4 * 4},
                  {"mesh particles", particles * (16 * 4 + 4 * 8)},
                  {"mesh field", impl->corners_ * 4},
                  {"mesh cases", impl->corners_ * 4},
                  {"mesh first vertices", impl->corners_ * 4},
                  {"mesh rows", (impl->rows_ + 4) * 4 * 2},
                  {"mesh vertices", uint64_t{limits.maxVertices} * 16 * 3},
                  {"mesh edges", uint64_t{limits.maxVertices} * 4},
                  {"mesh indices", uint64_t{limits.maxTriangles} * 12}};
  for (const auto& [name, bytes] : impl->sizes_) impl->bytes += bytes;
  const auto tooLarge = [&](const std::string& why) {
    return meshError(ErrorKind::TooLarge, grouped(blocks) + " blocks, " + grouped(limits.maxVertices) + " vertices and " +
                                              grouped(limits.maxTriangles) + " triangles need " + grouped(impl->bytes) + " bytes; " + why);
  };
  const uint64_t largest = std::max({impl->corners_ * 4, particles * 48, uint64_t{limits.maxVertices} * 16,
                                     uint64_t{limits.maxTriangles} * 12, reached * 4, (blocks * kMeshBlockBins + 2) * 4});
  if (impl->corners_ >= kMaxMeshCorners || reached > KeySortDesc::kMaxCount || impl->rows_ + 1 > Scan::kMaxCount ||
      blocks * kMeshBlockBins + 1 > maxStartRange(device))
    return tooLarge("expected at most " + grouped(kMaxMeshCorners) + " corners of cells, found " + grouped(impl->corners_));
  if (largest > device.info().maxBufferBytes)
    return tooLarge("one buffer of them has " + grouped(largest) + ", expected at most " + grouped(device.info().maxBufferBytes));
  if (impl->bytes > device.availableBytes()) return tooLarge(grouped(device.availableBytes()) + " are available");

  const auto sort = [&](std::optional<KeySort>& made, const KeySortDesc& keys) -> Expected<void> {
    auto created = KeySort::create(device, keys);
    if (!created) return created.error();
    made.emplace(*std::move(created));
    return {};
  };
  const auto reachedCount = static_cast<uint32_t>(reached);
  if (auto ok = sort(impl->blockSort_, {.count = limits.capacity, .keyRange = KeySortDesc::kMaxKeyRange, .keys = true}); !ok)
    return ok.error();
  if (auto ok = sort(impl->reachedSort_, {.count = reachedCount, .keyRange = KeySortDesc::kMaxKeyRange, .keys = true}); !ok)
    return ok.error();
  if (auto ok = sort(impl->binSort_, {.count = limits.capacity, .keyRange = blocks * kMeshBlockBins + 1, .start = true}); !ok)
    return ok.error();
  const auto scan = [&](Scan& made, uint64_t count) -> Expected<void> {
    auto created = Scan::create(device, static_cast<uint32_t>(count));
    if (!created) return created.error();
    made = *created;
    return {};
  };
  if (auto ok = scan(impl->particleScan_, particles + 1); !ok) return ok.error();
  if (auto ok = scan(impl->reachedScan_, reached + 1); !ok) return ok.error();
  if (auto ok = scan(impl->rowScan_, impl->rows_ + 1); !ok) return ok.error();

  ModulePipelines make(device);
  const bool texels = usesTexelReads(device, std::max({impl->corners_, 3 * particles, reached, uint64_t{limits.maxVertices}}));
  const auto pipeline = [&](std::string_view shader) { return make.make(shader, texels, {{"BIN_CELLS", impl->binCells_}}); };
  impl->pipelines_ = {.keys = pipeline("mesher/keys"),
                      .flag = pipeline("mesher/flag"),
                      .compact = pipeline("mesher/compact"),
                      .reach = pipeline("mesher/reach"),
                      .dilate = pipeline("mesher/dilate"),
                      .arguments = pipeline("mesher/arguments"),
                      .neighbors = pipeline("mesher/neighbors"),
                      .binKeys = pipeline("mesher/bin_keys"),
                      .gather = pipeline("mesher/gather"),
                      .ellipsoids = pipeline("mesher/ellipsoids"),
                      .states = pipeline("mesher/states"),
                      .mixed = pipeline("mesher/mixed"),
                      .field = pipeline("mesher/field"),
                      .rows = pipeline("mesher/rows"),
                      .finish = pipeline("mesher/finish"),
                      .vertices = pipeline("mesher/vertices"),
                      .triangles = pipeline("mesher/triangles"),
                      .shade = pipeline("mesher/shade")};
  if (auto made = make.result(); !made) return made.error();
  impl->table_ = packedCubeTriangles();
  return impl;
}

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
          {{&f.counts, 0}, {&f.arguments, 0}, {&f.reached, 0}, {&f.surface, 0}, {&f.rowVertices, 0}, {&f.rowTriangles, 0}});
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

Expected<SurfaceMesher> SurfaceMesher::create(Device& device, const SurfaceMesherDesc& desc) {
  auto impl = SurfaceMesherImpl::create(device, desc);
  if (!impl) return impl.error();
  return SurfaceMesher(*std::move(impl));
}

SurfaceMesher::SurfaceMesher(std::unique_ptr<SurfaceMesherImpl> impl) : impl_(std::move(impl)) {}
SurfaceMesher::~SurfaceMesher() = default;
SurfaceMesher::SurfaceMesher(SurfaceMesher&&) noexcept = default;
SurfaceMesher& SurfaceMesher::operator=(SurfaceMesher&&) noexcept = default;

SurfaceMesh SurfaceMesher::addTo(Graph& graph, const FluidState& fluid) {
  auto valid = checkFluid(graph, fluid);
  if (valid && fluid.capacity > impl_->limits.capacity)
    valid = meshError(ErrorKind::BadInput, "FluidState::capacity is " + grouped(fluid.capacity) + "; expected at most " +
                                               grouped(impl_->limits.capacity) + ", the mesher's capacity");
  if (!valid) {
    implOf(graph).fail(valid.error().message);
    return {};
  }
  return impl_->addTo(graph, fluid);
}

const SurfaceMesherDesc& SurfaceMesher::limits() const { return impl_->limits; }
uint64_t SurfaceMesher::bytes() const { return impl_->bytes; }

}  // namespace rill
