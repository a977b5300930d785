#include "render/surface.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "gpu/device_impl.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/step.hpp"
#include "sort/dispatches.hpp"

namespace rill {
namespace {

using namespace surface;

constexpr float kHardRadius = 0.9f;  // spacings: spheres that leave no gap between surface particles
constexpr uint32_t kMaxStep = 16;
constexpr uint32_t kNarrowPasses = 2;

static_assert(kMarginSamples % kCellSamples == 0);

double metersAPixel(const SurfacePush& camera, double depth) {
  return std::abs(double{camera.scale[1]}) * 2 / camera.height * (camera.perspective > 0 ? depth : 1.0);
}

/// A margin as wide in spacings as the default's, in whole cells.
uint32_t marginSamples(double samples) {
  const double finer = std::max(samples / SurfaceSettings{}.samples, 1.0);
  return kMarginSamples / kCellSamples * static_cast<uint32_t>(std::ceil(finer)) * kCellSamples;
}

}  // namespace

uint32_t sampleStep(const SurfacePush& camera, float spacing, double depth, double samples) {
  const double meters = metersAPixel(camera, depth);
  const double pixels = spacing / std::max(meters, 1e-30) / samples;  // of the widest allowed sample
  return pixels >= kMaxStep ? kMaxStep : std::bit_floor(static_cast<uint32_t>(std::max(pixels, 1.0)));
}

Expected<SurfaceStage> SurfaceStage::create(Device& device) {
  SurfaceStage stage;
  stage.device_ = &implOf(device);
  using enum BindingKind;
  static constexpr BindingKind kStorage[] = {Storage, Storage, Storage, Storage, Storage, Storage, Storage, Storage},
                               kTexels[] = {TexelUint, TexelFloat4, TexelFloat4, Storage, Storage, Storage, Storage, Storage},
                               kTexelsToPlanes[] = {TexelUint, TexelFloat4, Storage, Storage},
                               kTexelSamples[] = {TexelUint, Storage, Storage, Storage},
                               kTexelsToNormals[] = {TexelUint, TexelFloat4, TexelUint, Storage, Storage, Storage, Storage};
  const auto storage = [](size_t bindings) { return std::span(kStorage).first(bindings); };
  const struct {
    const ComputePipeline*& pipeline;
    std::string_view shader;
    std::span<const BindingKind> bindings;
  } all[] = {
      {stage.occlude_, "render/surface_occlude", storage(2)},
      {stage.cull_, "render/surface_cull", storage(4)},
      {stage.arguments_, "render/surface_arguments", storage(2)},
      {stage.splat_, "render/surface_splat", storage(4)},
      {stage.pick_, "render/surface_pick", storage(6)},
      {stage.scatter_, "render/surface_scatter", storage(6)},
      {stage.order_, "render/surface_order", storage(5)},
      {stage.planes_[0], "render/surface_planes", storage(4)},
      {stage.blend_[0], "render/surface_blend", storage(7)},
      {stage.tiles_, "render/surface_tiles", storage(4)},
      {stage.compose_, "render/surface_compose", storage(6)},
      {stage.edges_[0], "render/surface_edges", storage(8)},
      {stage.thickness_, "render/surface_thickness", storage(4)},
      {stage.normals_[0], "render/surface_normals", storage(7)},
      {stage.edgesFiltered_[0], "render/surface_edges_filtered", storage(8)},
      {stage.thicknessNoScene_, "render/surface_thickness_no_scene", storage(3)},
      {stage.planes_[1], "render/surface_planes_texel", kTexelsToPlanes},
      {stage.blend_[1], "render/surface_blend_texel", std::span(kTexels).first(7)},
      {stage.edges_[1], "render/surface_edges_texel", kTexels},
      {stage.normals_[1], "render/surface_normals_texel", kTexelsToNormals},
      {stage.edgesFiltered_[1], "render/surface_edges_filtered_texel", kTexels},
  };
  for (const auto& row : all) {
    auto made = computePipeline(device, {.shader = row.shader, .bindings = row.bindings, .pushConstantBytes = sizeof(SurfacePush)});
    if (!made) return made.error();
    row.pipeline = *made;
  }
  for (const bool texels : {false, true})
    for (uint32_t vertical = 0; vertical < 2; ++vertical) {
      const uint32_t constants[] = {vertical};
      auto made = computePipeline(device, {.shader = texels ? "render/surface_narrow_texel" : "render/surface_narrow",
                                           .bindings = texels ? std::span<const BindingKind>(kTexelSamples) : storage(4),
                                           .pushConstantBytes = sizeof(SurfacePush),
                                           .constants = constants});
      if (!made) return made.error();
      stage.narrow_[texels][vertical] = *made;
    }
  auto flow = CurvatureFlow::create(device);
  if (!flow) return flow.error();
  stage.flow_ = *flow;
  // Creates the pipelines of scans of any size, so that addGrid() finds them in the cache.
  if (auto scan = Scan::create(device, Scan::kMaxCount); !scan) return scan.error();
  return stage;
}

SurfaceBuffers SurfaceStage::addTo(Graph& graph, const FluidState& fluid, SurfacePush camera, SurfaceMethod method, bool whole,
                                   double focus, const SurfaceSettings& settings) const {
  assert(fluid.count > 0);
  const bool filtered = settings.filter || method == SurfaceMethod::CurvatureFlow || method == SurfaceMethod::NarrowRange;
  Frame frame = makeFrame(fluid, camera, method, focus, settings);
  const uint64_t maxTexels = std::max({2 * uint64_t{fluid.count}, paddedWords(frame.cells + 1), sampleCount(frame.out.push)});
  frame.storageReads = settings.storage_reads;
  frame.texels = !frame.storageReads && usesTexelReads(*device_->device, maxTexels);
  frame.narrowRange = method == SurfaceMethod::NarrowRange && !settings.filter;
  addBuffers(graph, fluid, frame, whole);
  addVisible(graph, fluid, frame);
  addGrid(graph, fluid, frame);
  if (filtered)
    addFiltered(graph, frame, settings);
  else
    addPlanes(graph, frame);
  addCompose(graph, frame, (filtered ? edgesFiltered_ : edges_)[frame.texels], whole);
  return frame.out;
}

SurfaceStage::Frame SurfaceStage::makeFrame(const FluidState& fluid, SurfacePush push, SurfaceMethod method, double focus,
                                            const SurfaceSettings& settings) {
  push.spacing = fluid.spacing;
  push.radius = kHardRadius * fluid.spacing;
  push.count = fluid.count;
  const double sampleSide = std::max(metersAPixel(push, focus) * push.step, 1e-6 * fluid.spacing);
  push.margin = marginSamples(std::min(2 * settings.samples, push.spacing / sampleSide));
  Frame frame;
  push.smoothing = static_cast<float>(method == SurfaceMethod::NarrowRange ? settings.narrow_sigma : settings.fit_reach);
  frame.sampleSide = sampleSide;
  const uint64_t columns = sampleColumns(push), rows = sampleRows(push);
  frame.occluderCells = gridCells(columns, rows, kOccluderSamples);
  frame.cells = gridCells(columns, rows, kCellSamples);
  frame.sampleBlocks = gridCells(columns, rows, kSampleBlock);
  frame.out.push = push;
  return frame;
}

/// Creates and clears the buffers that several parts share.
void SurfaceStage::addBuffers(Graph& graph, const FluidState& fluid, Frame& frame, bool whole) {
  SurfaceBuffers& out = frame.out;
  frame.occluders = graph.create("surface occluders", {frame.occluderCells * 4});
  frame.depth = graph.create("surface hard depth", {sampleCount(out.push) * 4});
  frame.start = graph.create("surface cells", {paddedWords(frame.cells + 1) * 4});
  out.counters = graph.create("surface counters", {kSurfaceCounterWords * 4});
  out.arguments = graph.create("surface arguments", {kSurfaceArgumentWords * 4});
  frame.survivors = graph.create("surface survivors", {uint64_t{fluid.count} * 4});
  frame.center = graph.create("surface centers", {uint64_t{fluid.count} * 16});
  out.tiles = graph.create("surface tiles", {gridCells(out.push.width, out.push.height, kSurfaceTile) * 4});
  out.pixels = graph.create("surface pixels", {uint64_t{out.push.width} * out.push.height * 8});
  out.blocks = graph.create("surface blocks", {frame.sampleBlocks * 4});
  out.samples = graph.create("surface samples", {sampleCount(out.push) * 8});
  if (frame.narrowRange)
    for (BufferRef& buffer : frame.filtered) buffer = graph.create("surface filtered", {sampleCount(out.push) * 4});
  const auto filtered = [&](size_t k) { return frame.narrowRange ? &frame.filtered[k] : nullptr; };
  addFill(graph, "surface clear",
          {{&frame.occluders, kInfiniteBits},
           {&frame.depth, kInfiniteBits},
           {&out.samples, kInfiniteBits},
           {filtered(0), kInfiniteBits},
           {filtered(1), kInfiniteBits},
           {whole ? &out.pixels : nullptr, kInfiniteBits},
           {&frame.start, 0},
           {&out.counters, 0}});
}

/// Dispatch arguments from the counts so far.
void SurfaceStage::addArguments(Graph& graph, SurfaceBuffers& out) const {
  addStep(graph, "surface arguments", arguments_, {reads(out.counters), fresh(out.arguments)}, 1, out.push);
}

/// Particles that are not occluded, the depth of their spheres, and the tiles that these cover.
void SurfaceStage::addVisible(Graph& graph, const FluidState& fluid, Frame& frame) const {
  SurfaceBuffers& out = frame.out;
  const uint64_t particles = divideUp(fluid.count, kSurfaceGroup), tiles = gridCells(out.push.width, out.push.height, kSurfaceTile);
  addStep(graph, "surface occlude", occlude_, {reads(fluid.position), writes(frame.occluders)}, particles, out.push);
  addStep(graph, "surface cull", cull_, {reads(fluid.position), reads(frame.occluders), writes(out.counters), fresh(frame.survivors)},
          particles, out.push);
  addArguments(graph, out);
  addStep(graph, "surface splat", splat_, {reads(fluid.position), writes(out.counters), reads(frame.survivors), writes(frame.depth)},
          StepGroups(out.arguments, kSurvivorArguments), out.push);
  addStep(graph, "surface tiles", tiles_, {reads(frame.depth), writes(out.counters), fresh(out.tiles), fresh(out.blocks)},
          divideUp(std::max(tiles, frame.sampleBlocks), kSurfaceGroup), out.push);
}

/// Surface particles, sorted into the cells of the screen grid.
void SurfaceStage::addGrid(Graph& graph, const FluidState& fluid, Frame& frame) const {
  SurfaceBuffers& out = frame.out;
  BufferRef rank = graph.create("surface ranks", {uint64_t{fluid.count} * 4});
  BufferRef arrived = graph.create("surface arrived", {uint64_t{fluid.count} * 4});
  const auto survivorGroups = [&] { return StepGroups(out.arguments, kSurvivorArguments); };
  addStep(graph, "surface pick", pick_,
          {reads(fluid.position), writes(out.counters), reads(frame.survivors), reads(frame.depth), writes(frame.start), fresh(rank)},
          survivorGroups(), out.push);
  addArguments(graph, out);
  auto scan = Scan::create(*device_->device, static_cast<uint32_t>(frame.cells + 1), frame.storageReads,
                           {"surface scan", "surface scan reduce", "surface scan tiles", "surface scan apply"});
  assert(scan && "its pipelines were made in create()");
  frame.start = scan->addTo(graph, frame.start);
  addStep(graph, "surface scatter", scatter_,
          {reads(fluid.position), reads(out.counters), reads(frame.survivors), reads(frame.start), reads(rank), fresh(arrived)},
          survivorGroups(), out.push);
  addStep(graph, "surface order", order_,
          {reads(fluid.position), writes(out.counters), reads(frame.start), reads(arrived), fresh(frame.center)},
          StepGroups(out.arguments, kSurfaceArguments), out.push);
}

/// A plane per particle, then their blend.
void SurfaceStage::addPlanes(Graph& graph, Frame& frame) const {
  SurfaceBuffers& out = frame.out;
  frame.plane = graph.create("surface planes", {uint64_t{out.push.count} * 32});
  addStep(graph, "surface planes", planes_[frame.texels],
          {frame.arrayOf(frame.start), frame.arrayOf(frame.center), fresh(frame.plane), writes(out.counters)},
          StepGroups(out.arguments, kSurfaceArguments), out.push);
  addStep(graph, "surface blend", blend_[frame.texels],
          {frame.arrayOf(frame.start), frame.arrayOf(frame.center), frame.arrayOf(frame.plane), reads(frame.depth), writes(out.samples),
           writes(out.counters), reads(out.blocks)},
          StepGroups(out.arguments, kSampleBlockArguments), out.push);
}

/// Smoothed depth and its normals.
void SurfaceStage::addFiltered(Graph& graph, Frame& frame, const SurfaceSettings& settings) const {
  SurfaceBuffers& out = frame.out;
  const StepGroups blocks(out.arguments, kSampleBlockArguments);
  BufferRef from = frame.depth;
  if (settings.filter) {
    from = settings.filter(graph, from, out.push);
  } else if (!frame.narrowRange) {
    from = flow_.addTo(graph, from, out, frame.sampleSide, settings.flow_time, settings.flow_levels, frame.texels);
  } else {
    uint32_t steps = 0;
    for (uint32_t k = 0; k < kNarrowPasses; ++k)
      for (const ComputePipeline* pipeline : narrow_[frame.texels]) {
        BufferRef& to = frame.filtered[steps++ % 2];
        addStep(graph, "surface narrow range", pipeline, {frame.arrayOf(from), writes(to), writes(out.counters), reads(out.blocks)}, blocks,
                out.push);
        from = to;
      }
  }
  addStep(graph, "surface normals", normals_[frame.texels],
          {frame.arrayOf(frame.start), frame.arrayOf(frame.center), frame.arrayOf(from), reads(frame.depth), writes(out.samples),
           writes(out.counters), reads(out.blocks)},
          blocks, out.push);
  frame.plane = frame.center;  // bound, not read
}

/// From samples to pixels of the tiles with fluid, then pixels at edges.
void SurfaceStage::addCompose(Graph& graph, Frame& frame, const ComputePipeline* edges, bool whole) const {
  SurfaceBuffers& out = frame.out;
  BufferRef listed = graph.create("surface edge pixels", {uint64_t{out.push.width} * out.push.height * 4});
  addStep(graph, "surface compose", compose_,
          {reads(frame.depth), reads(out.samples), writes(out.counters), reads(out.tiles), whole ? writes(out.pixels) : fresh(out.pixels),
           fresh(listed)},
          StepGroups(out.arguments, kSurfaceTileArguments), out.push);
  addArguments(graph, out);
  addStep(graph, "surface edges", edges,
          {frame.arrayOf(frame.start), frame.arrayOf(frame.center), frame.arrayOf(frame.plane), reads(frame.depth), reads(out.samples),
           writes(out.counters), reads(listed), writes(out.pixels)},
          StepGroups(out.arguments, kEdgeArguments), out.push);
}

}  // namespace rill
