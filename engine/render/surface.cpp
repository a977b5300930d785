#include "render/surface.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "gpu/device_impl.hpp"
#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/shader_pass.hpp"
#include "shared/no_depth.h"
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

Expected<SurfaceStage> SurfaceStage::create(Device& device, bool storageReads) {
  SurfaceStage stage;
  stage.device_ = &implOf(device);
  stage.storageReads_ = storageReads;
  static_assert(2 * uint64_t{kMaxParticles} <= kReadTexels, "start, center, plane and the inputs of filters are read");
  const bool texels = !storageReads && usesTexelReads(device);
  ModulePipelines pipelines(device);
  stage.particleGroups_ = pipelines.make("render/particle_groups");
  stage.occlude_ = pipelines.make("render/surface_occlude");
  stage.cull_ = pipelines.make("render/surface_cull");
  stage.arguments_ = pipelines.make("render/surface_arguments");
  stage.splat_ = pipelines.make("render/surface_splat");
  stage.pick_ = pipelines.make("render/surface_pick");
  stage.scatter_ = pipelines.make("render/surface_scatter");
  stage.order_ = pipelines.make("render/surface_order");
  stage.tiles_ = pipelines.make("render/surface_tiles");
  stage.compose_ = pipelines.make("render/surface_compose", texels);
  stage.thickness_ = pipelines.make("render/surface_thickness", texels, {{"FLUIDS", 1}});
  stage.shadow_ = pipelines.make("render/fluid_shadow");
  stage.back_ = pipelines.make("render/fluid_back", texels, {{"FLUIDS", 1}});
  stage.thicknessNoScene_ = pipelines.make("render/surface_thickness_no_scene", false, {{"FLUIDS", 1}});
  stage.planes_ = pipelines.make("render/surface_planes", texels);
  stage.blend_ = pipelines.make("render/surface_blend", texels);
  stage.edges_ = pipelines.make("render/surface_edges", texels);
  stage.edgesFiltered_ = pipelines.make("render/surface_edges_filtered", texels);
  stage.normals_ = pipelines.make("render/surface_normals", texels);
  for (const bool vertical : {false, true})
    stage.narrow_[vertical] = pipelines.make("render/surface_narrow", texels, {{"VERTICAL", vertical}});
  if (auto made = pipelines.result(); !made) return made.error();
  auto flow = CurvatureFlow::create(device, texels);
  if (!flow) return flow.error();
  stage.flow_ = *flow;
  // Creates the pipelines of scans of any size, so that addGrid() finds them in the cache.
  if (auto scan = Scan::create(device, 1, storageReads); !scan) return scan.error();
  return stage;
}

SurfaceBuffers SurfaceStage::addTo(Graph& graph, const FluidState& fluid, SurfacePush camera, SurfaceMethod method, bool whole,
                                   double focus, const SurfaceSettings& settings) const {
  assert(fluid.capacity > 0);
  const bool filtered = settings.filter || method == SurfaceMethod::CurvatureFlow || method == SurfaceMethod::NarrowRange;
  Frame frame = makeFrame(fluid, camera, method, focus, settings);
  frame.narrowRange = method == SurfaceMethod::NarrowRange && !settings.filter;
  frame.position = fluid.position;
  frame.out.particles = countParticles(graph, fluid, particleGroups_, kSurfaceGroup);
  addBuffers(graph, fluid, frame, whole);
  addVisible(graph, frame);
  addGrid(graph, fluid, frame);
  if (filtered)
    addFiltered(graph, frame, settings);
  else
    addPlanes(graph, frame);
  addCompose(graph, frame, filtered ? edgesFiltered_ : edges_);
  return frame.out;
}

SurfaceStage::Frame SurfaceStage::makeFrame(const FluidState& fluid, SurfacePush push, SurfaceMethod method, double focus,
                                            const SurfaceSettings& settings) {
  push.spacing = fluid.spacing;
  push.radius = kHardRadius * fluid.spacing;
  push.count = fluid.capacity;
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
  frame.survivors = graph.create("surface survivors", {uint64_t{fluid.capacity} * 4});
  frame.center = graph.create("surface centers", {uint64_t{fluid.capacity} * 16});
  out.tiles = graph.create("surface tiles", {gridCells(out.push.width, out.push.height, kSurfaceTile) * 4});
  out.pixels = graph.create("surface pixels", {uint64_t{out.push.width} * out.push.height * 8});
  out.blocks = graph.create("surface blocks", {frame.sampleBlocks * 4});
  out.samples = graph.create("surface samples", {sampleCount(out.push) * 8});
  if (frame.narrowRange)
    for (BufferRef& buffer : frame.filtered) buffer = graph.create("surface filtered", {sampleCount(out.push) * 4});
  const auto filtered = [&](size_t k) { return frame.narrowRange ? &frame.filtered[k] : nullptr; };
  addFill(graph, "surface clear",
          {{&frame.occluders, kNoDepthBits},
           {&frame.depth, kNoDepthBits},
           {&out.samples, kNoDepthBits},
           {filtered(0), kNoDepthBits},
           {filtered(1), kNoDepthBits},
           {whole ? &out.pixels : nullptr, kNoDepthBits},
           {&frame.start, 0},
           {&out.counters, 0}});
}

/// A pass of one dispatch over the frame's buffers, which shaders know by these names.
void SurfaceStage::add(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, Frame& f) const {
  addDispatch(graph, name, pipeline, size, f.out.push,
              {{"position", f.position},
               {"particle_count", f.out.particles.count},
               {"occluders", f.occluders},
               {"survivors", f.survivors},
               {"depth", f.depth},
               {"start", f.start},
               {"rank", f.rank},
               {"arrived", f.arrived},
               {"center", f.center},
               {"plane", f.plane},
               {"before", f.before},
               {"filtered", f.before},
               {"after", f.after},
               {"edges", f.edges},
               {"counters", f.out.counters},
               {"arguments", f.out.arguments},
               {"tiles", f.out.tiles},
               {"blocks", f.out.blocks},
               {"samples", f.out.samples},
               {"surface", f.out.pixels}});
}
/// Over as many workgroups as the device has counted.
void SurfaceStage::addCounted(Graph& graph, std::string_view name, const ComputePipeline* pipeline, uint32_t arguments, Frame& f) const {
  add(graph, name, pipeline, {f.out.arguments, arguments * 4}, f);
}

/// Dispatch arguments from the counts so far.
void SurfaceStage::addArguments(Graph& graph, Frame& frame) const { add(graph, "surface arguments", arguments_, 1, frame); }

/// Particles that are not occluded, the depth of their spheres, and the tiles that these cover.
void SurfaceStage::addVisible(Graph& graph, Frame& frame) const {
  const SurfacePush& push = frame.out.push;
  const uint64_t tiles = gridCells(push.width, push.height, kSurfaceTile);
  add(graph, "surface occlude", occlude_, frame.out.particles.groups, frame);
  add(graph, "surface cull", cull_, frame.out.particles.groups, frame);
  addArguments(graph, frame);
  addCounted(graph, "surface splat", splat_, kSurvivorArguments, frame);
  add(graph, "surface tiles", tiles_, divideUp(std::max(tiles, frame.sampleBlocks), kSurfaceGroup), frame);
}

/// Surface particles, sorted into the cells of the screen grid.
void SurfaceStage::addGrid(Graph& graph, const FluidState& fluid, Frame& frame) const {
  frame.rank = graph.create("surface ranks", {uint64_t{fluid.capacity} * 8});
  frame.arrived = graph.create("surface arrived", {uint64_t{fluid.capacity} * 8});
  addCounted(graph, "surface pick", pick_, kSurvivorArguments, frame);
  addArguments(graph, frame);
  auto scan = Scan::create(*device_->device, static_cast<uint32_t>(frame.cells + 1), storageReads_,
                           {"surface scan", "surface scan reduce", "surface scan tiles", "surface scan apply"});
  assert(scan && "its pipelines were made in create()");
  frame.start = scan->addTo(graph, frame.start);
  addCounted(graph, "surface scatter", scatter_, kSurvivorArguments, frame);
  addCounted(graph, "surface order", order_, kSurfaceArguments, frame);
}

/// A plane per particle, then their blend.
void SurfaceStage::addPlanes(Graph& graph, Frame& frame) const {
  frame.plane = graph.create("surface planes", {uint64_t{frame.out.push.count} * 32});
  addCounted(graph, "surface planes", planes_, kSurfaceArguments, frame);
  addCounted(graph, "surface blend", blend_, kSampleBlockArguments, frame);
}

/// Smoothed depth and its normals.
void SurfaceStage::addFiltered(Graph& graph, Frame& frame, const SurfaceSettings& settings) const {
  frame.before = frame.depth;
  if (settings.filter) {
    frame.before = settings.filter(graph, frame.before, frame.out.push);
  } else if (!frame.narrowRange) {
    frame.before = flow_.addTo(graph, frame.before, frame.out, frame.sampleSide, settings.flow_time, settings.flow_levels);
  } else {
    for (uint32_t k = 0; k < kNarrowPasses; ++k)
      for (const bool vertical : {false, true}) {
        frame.after = frame.filtered[vertical];
        addCounted(graph, "surface narrow range", narrow_[vertical], kSampleBlockArguments, frame);
        frame.before = frame.filtered[vertical] = frame.after;
      }
  }
  addCounted(graph, "surface normals", normals_, kSampleBlockArguments, frame);
}

/// From samples to pixels of the tiles with fluid, then pixels at edges.
void SurfaceStage::addCompose(Graph& graph, Frame& frame, const ComputePipeline* edges) const {
  frame.edges = graph.create("surface edge pixels", {uint64_t{frame.out.push.width} * frame.out.push.height * 4});
  addCounted(graph, "surface compose", compose_, kSurfaceTileArguments, frame);
  addArguments(graph, frame);
  addCounted(graph, "surface edges", edges, kEdgeArguments, frame);
}

}  // namespace rill
