// The passes of a step of the whitewater, in order.
#include "graph/import_whole.hpp"
#include "graph/shader_pass.hpp"
#include "render/particle_count.hpp"
#include "whitewater/whitewater_impl.hpp"

namespace rill {

/// The buffers of one frame.
struct WhitewaterImpl::Frame {
  WhitePush push{};
  BufferRef position, velocity, particleCount, solids, meshWords, keys, order, start, place, motion, surface, strain, births, whitePlace,
      whiteMotion, movedPlace, movedMotion, alive, counts, arguments;
};

WhitePush WhitewaterImpl::pushFor(const FluidState& fluid, double seconds, const Double3& gravity) const {
  WhitePush push{};
  push.spacing = fluid.spacing;
  push.seconds = static_cast<float>(seconds);
  push.gravityX = static_cast<float>(gravity.x);
  push.gravityY = static_cast<float>(gravity.y);
  push.gravityZ = static_cast<float>(gravity.z);
  if (desc.domain) {
    const Double3 &low = desc.domain->min, &high = desc.domain->max;
    push.lowX = static_cast<float>(low.x - desc.origin.x);
    push.lowY = static_cast<float>(low.y - desc.origin.y);
    push.lowZ = static_cast<float>(low.z - desc.origin.z);
    push.highX = static_cast<float>(high.x - desc.origin.x);
    push.highY = static_cast<float>(high.y - desc.origin.y);
    push.highZ = static_cast<float>(high.z - desc.origin.z);
    push.walls = 63u & ~uint32_t{desc.domain->open};
    if (desc.domain->outflow) push.walls &= ~(1u << sideBit(desc.domain->outflow->side));
  }
  push.capacity = desc.capacity;
  push.particles = fluid.capacity;
  push.room = desc.room;
  push.bins = bins_;
  push.parcel = static_cast<float>(desc.parcel_m3);
  push.trapping = static_cast<float>(desc.trapping);
  push.breaking = static_cast<float>(desc.breaking);
  push.life = static_cast<float>(desc.life_s);
  push.solids = desc.solids;
  push.seed = static_cast<uint32_t>(desc.seed ^ desc.seed >> 32);
  return push;
}

/// The state at the start goes to the device with the first frame.
void WhitewaterImpl::upload(Graph& graph, Frame& f) {
  if (started_) {
    staging_ = {};  // the frame that read it has been recorded
    return;
  }
  started_ = true;
  const BufferRef start = importWhole(graph, "whitewater start", staging_);
  graph.pass("whitewater start", [&](Pass& pass) {
    pass.read(start, Use::CopySource);
    f.counts = pass.write(f.counts, Use::CopyTarget, true);
    f.whitePlace = pass.write(f.whitePlace, Use::CopyTarget, true);
    f.whiteMotion = pass.write(f.whiteMotion, Use::CopyTarget, true);
    return [start, f, staged = staged_](Commands& commands) {
      commands.copy(start, f.counts, kWhiteCountBytes);
      if (staged == 0) return;
      commands.copy(start, f.whitePlace, staged * 16, kWhiteCountBytes);
      commands.copy(start, f.whiteMotion, staged * 16, kWhiteCountBytes + staged * 16);
    };
  });
}

/// A pass of one dispatch over the frame's buffers, which shaders know by these names.
void WhitewaterImpl::add(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, Frame& f) const {
  addDispatch(graph, name, pipeline, size, f.push,
              {{"position", std::as_const(f.position)},
               {"velocity", std::as_const(f.velocity)},
               {"particle_count", std::as_const(f.particleCount)},
               {"solids", std::as_const(f.solids)},
               {"mesh_words", std::as_const(f.meshWords)},
               {"keys", f.keys},
               {"order", f.order},
               {"start", f.start},
               {"place", f.place},
               {"motion", f.motion},
               {"surface", f.surface},
               {"strain", f.strain},
               {"births", f.births},
               {"white_place", f.whitePlace},
               {"white_motion", f.whiteMotion},
               {"moved_place", f.movedPlace},
               {"moved_motion", f.movedMotion},
               {"alive", f.alive},
               {"counts", f.counts},
               {"arguments", f.arguments}});
}

/// The fluid in the order of the bins, its surface and its strain, and what it emits.
void WhitewaterImpl::addFluid(Graph& graph, Frame& f) const {
  const uint64_t fluid = desc.capacity, over = divideUp(fluid, kWhiteGroup);
  f.keys = graph.create("whitewater keys", {fluid * 4});
  f.place = graph.create("whitewater fluid places", {fluid * 16});
  f.motion = graph.create("whitewater fluid motions", {fluid * 16});
  f.surface = graph.create("whitewater surface", {fluid * 16});
  f.strain = graph.create("whitewater strain", {fluid * 4});
  f.births = graph.create("whitewater births", {paddedWords(fluid + 1) * 4});
  add(graph, "whitewater keys", pipelines_.keys, over, f);
  const SortedKeys sorted = sort_->addTo(graph, f.keys);
  f.order = sorted.order;
  f.start = sorted.start;
  add(graph, "whitewater gather", pipelines_.gather, over, f);
  add(graph, "whitewater surface", pipelines_.surface, over, f);
  addFill(graph, "whitewater clear", {{&f.births, 0}});
  add(graph, "whitewater births", pipelines_.births, over, f);
  f.births = birthScan_.addTo(graph, f.births);
}

WhitewaterState WhitewaterImpl::addTo(Graph& graph, const FluidState& fluid, double seconds, const Double3& gravity) {
  desc.gravity = gravity;
  Frame f;
  f.whitePlace = importWhole(graph, "whitewater places", place_);
  f.whiteMotion = importWhole(graph, "whitewater motions", motion_);
  f.counts = importWhole(graph, "whitewater counts", counts_);
  upload(graph, f);
  if (seconds > 0 && fluid.capacity > 0) {
    f.push = pushFor(fluid, seconds, gravity);
    f.position = fluid.position;
    f.velocity = fluid.velocity;
    f.particleCount = particleCount(graph, fluid);
    f.solids = fluid.boundaries;
    f.meshWords = desc.meshes ? fluid.meshWords : fluid.boundaries;  // not read without meshes
    f.arguments = graph.create("whitewater arguments", {sizeof(VkDispatchIndirectCommand)});
    f.movedPlace = graph.create("whitewater moved places", {uint64_t{desc.room} * 16});
    f.movedMotion = graph.create("whitewater moved motions", {uint64_t{desc.room} * 16});
    f.alive = graph.create("whitewater alive", {paddedWords(uint64_t{desc.room} + 1) * 4});
    add(graph, "whitewater begin", pipelines_.begin, 1, f);
    addFluid(graph, f);
    const DispatchSize old{f.arguments, 0};
    addFill(graph, "whitewater clear", {{&f.alive, 0}});
    add(graph, "whitewater advance", pipelines_.advance, old, f);
    f.alive = aliveScan_.addTo(graph, f.alive);
    add(graph, "whitewater compact", pipelines_.compact, old, f);
    add(graph, "whitewater emit", pipelines_.emit, divideUp(desc.capacity, kWhiteGroup), f);
    add(graph, "whitewater finish", pipelines_.finish, 1, f);
  }
  return {f.whitePlace, f.whiteMotion, f.counts, desc.room};
}

}  // namespace rill
