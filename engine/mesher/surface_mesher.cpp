#include "rill/surface_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/words.hpp"
#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/graph_impl.hpp"
#include "mesher/cube_table.hpp"
#include "mesher/surface_mesher_impl.hpp"
#include "render/check_input.hpp"

namespace rill {
namespace {

static_assert(size_t(MeshCount::Words) <= kMeshCountWords);
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

Expected<std::unique_ptr<SurfaceMesherImpl>> SurfaceMesherImpl::create(Device& device, const SurfaceMesherDesc& desc) {
  if (auto valid = checkRanges(desc); !valid) return valid.error();
  auto impl = std::make_unique<SurfaceMesherImpl>();
  impl->limits = withDefaults(desc);
  for (auto part : {&SurfaceMesherImpl::setSizes, &SurfaceMesherImpl::makeSorts, &SurfaceMesherImpl::makePipelines})
    if (auto ok = (*impl.*part)(device); !ok) return ok.error();
  impl->table_ = packedCubeTriangles();
  return impl;
}

Expected<void> SurfaceMesherImpl::setSizes(Device& device) {
  binCells_ = static_cast<uint32_t>(std::ceil(1 / limits.cell - 1e-6));
  const uint64_t blockCells = 4 * uint64_t{binCells_}, blocks = limits.maxBlocks, particles = limits.capacity;
  rows_ = blocks * blockCells * blockCells;
  corners_ = rows_ * blockCells;
  const uint64_t reached = blocks * kMeshNeighbors;
  // Without room for lists sums are walks, so lists are not why a mesher is refused or arrays are not read as texels.
  const uint64_t listed = std::min({particles * kMeshListedPerParticle, device.info().maxBufferBytes / 4, uint64_t{UINT32_MAX}});
  const uint64_t texelListed = std::min(listed, kReadTexels);
  texels_ = usesTexelReads(device, std::max({corners_, 3 * particles, texelListed, reached, uint64_t{limits.maxVertices}}));
  listed_ = texels_ ? texelListed : listed;
  bytes = blocks * 4                                     // blocks
          + reached * 4 * 4                              // keys of those reached
          + (blocks * kMeshBlockBins + 2) * 4 * 7        // bins
          + particles * (16 * 4 + 4 * 8)                 // particles
          + listed_ * 4                                  // lists of bins
          + corners_ * 4 * 3                             // field, cases, first vertices
          + (rows_ + 4) * 4 * 2                          // rows
          + uint64_t{limits.maxVertices} * (16 * 3 + 4)  // vertices, edges
          + uint64_t{limits.maxTriangles} * 12;          // indices
  const auto tooLarge = [&](const std::string& why) {
    return meshError(ErrorKind::TooLarge, grouped(blocks) + " blocks, " + grouped(limits.maxVertices) + " vertices and " +
                                              grouped(limits.maxTriangles) + " triangles need " + grouped(bytes) + " bytes; " + why);
  };
  const uint64_t largest = std::max({corners_ * 4, particles * 48, uint64_t{limits.maxVertices} * 16, uint64_t{limits.maxTriangles} * 12,
                                     reached * 4, blocks * kMeshBlockBins * 8});
  if (corners_ >= kMaxMeshCorners || reached > KeySortDesc::kMaxCount || rows_ + 1 > Scan::kMaxCount ||
      blocks * kMeshBlockBins + 1 > maxStartRange(device))
    return tooLarge("expected at most " + grouped(kMaxMeshCorners) + " corners of cells, found " + grouped(corners_));
  if (largest > device.info().maxBufferBytes)
    return tooLarge("one buffer of them has " + grouped(largest) + ", expected at most " + grouped(device.info().maxBufferBytes));
  if (bytes > device.availableBytes()) return tooLarge(grouped(device.availableBytes()) + " are available");
  return {};
}

Expected<void> SurfaceMesherImpl::makeSorts(Device& device) {
  const uint64_t blocks = limits.maxBlocks, particles = limits.capacity, reached = blocks * kMeshNeighbors;
  const auto sort = [&](std::optional<KeySort>& made, const KeySortDesc& keys) -> Expected<void> {
    auto created = KeySort::create(device, keys);
    if (!created) return created.error();
    made.emplace(*std::move(created));
    return {};
  };
  const auto reachedCount = static_cast<uint32_t>(reached);
  if (auto ok = sort(blockSort_, {.count = limits.capacity, .keyRange = KeySortDesc::kMaxKeyRange, .keys = true}); !ok) return ok;
  if (auto ok = sort(reachedSort_, {.count = reachedCount, .keyRange = KeySortDesc::kMaxKeyRange, .keys = true}); !ok) return ok;
  if (auto ok = sort(binSort_, {.count = limits.capacity, .keyRange = blocks * kMeshBlockBins + 1, .start = true}); !ok) return ok;
  const auto scan = [&](Scan& made, uint64_t count) -> Expected<void> {
    auto created = Scan::create(device, static_cast<uint32_t>(count));
    if (!created) return created.error();
    made = *created;
    return {};
  };
  if (auto ok = scan(particleScan_, particles + 1); !ok) return ok;
  if (auto ok = scan(reachedScan_, reached + 1); !ok) return ok;
  if (auto ok = scan(rowScan_, rows_ + 1); !ok) return ok;
  return {};
}

Expected<void> SurfaceMesherImpl::makePipelines(Device& device) {
  ModulePipelines make(device);
  const auto pipeline = [&](std::string_view shader) { return make.make(shader, texels_, {{"BIN_CELLS", binCells_}}); };
  pipelines_ = {.keys = pipeline("mesher/keys"),
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
                .nearArguments = pipeline("mesher/near_arguments"),
                .lists = pipeline("mesher/lists"),
                .field = pipeline("mesher/field"),
                .rows = pipeline("mesher/rows"),
                .finish = pipeline("mesher/finish"),
                .vertices = pipeline("mesher/vertices"),
                .triangles = pipeline("mesher/triangles"),
                .shade = pipeline("mesher/shade")};
  return make.result();
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
