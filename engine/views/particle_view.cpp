#include "views/particle_view.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <utility>

#include "gpu/resources.hpp"
#include "views/particle_records.h"
#include "views/particle_scene.hpp"
#include "views/scene_buffers.hpp"

namespace rill {
namespace {

using namespace particle_view;

constexpr uint32_t kMaxSide = 8192;
constexpr uint64_t kMaxPixels = uint64_t{1} << 25;  // 128 MiB of 4 bytes
constexpr uint32_t kInfinity = 0x7F800000u;         // bits of the float
constexpr double kNearPart = 1e-4;                  // of the distance to the target: where the near plane is at least

uint64_t groupsFor(uint64_t items, uint64_t size) { return (items + size - 1) / size; }
uint64_t tiles(uint64_t width, uint64_t height, uint64_t side) { return groupsFor(width, side) * groupsFor(height, side); }

void storeAxis(const double from[3], float to[3]) {
  for (int a = 0; a < 3; ++a) to[a] = static_cast<float>(from[a]);
}

}  // namespace

class ParticleViewImpl {
 public:
  Expected<void> create(Device& device, const Scene& scene, const ParticleSet& particles);
  BufferRef addTo(Graph& graph, const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc, double time);

  SceneBuffers buffers_;
  const ParticleScene& scene_ = buffers_.host;

 private:
  /// Buffers of one frame, as versions go on.
  struct Frame {
    ViewPush push;
    uint64_t pixels = 0;
    BufferRef scene, poses, edges, depth, winner, light, floor, tint, position, velocity, counters, survivors;
    BufferRef tiles, shaded, rims, picture;
  };

  ViewPush pushFor(const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc, double time) const;
  void addSetup(Graph& graph, const FluidState& fluid, Frame& frame);
  void addSurfaces(Graph& graph, Frame& frame);
  void addLightMap(Graph& graph, Frame& frame);
  BufferRef addMasks(Graph& graph, const Frame& frame, bool light);
  void addVisibility(Graph& graph, Frame& frame);
  void addSplat(Graph& graph, Frame& frame, bool winners);
  void addTint(Graph& graph, Frame& frame);
  void addFloorShadow(Graph& graph, Frame& frame);
  void addClassify(Graph& graph, Frame& frame);
  void addShade(Graph& graph, Frame& frame);

  uint64_t lightTexels() const { return uint64_t{scene_.scene.counts.y} * scene_.scene.counts.z; }
  bool hasFloor() const { return scene_.scene.domain_min.w > 0 && (scene_.scene.counts.w & 4u) != 0; }
  bool hasShadows(const Frame& frame) const { return frame.push.count > 0 || scene_.scene.counts.x > 0; }

  const ComputePipeline *edges_ = nullptr, *solidTiles_ = nullptr, *lightTiles_ = nullptr, *surfaces_ = nullptr, *floor_ = nullptr;
  const ComputePipeline *lightSolids_ = nullptr, *project_ = nullptr, *cull_ = nullptr, *arguments_ = nullptr, *splat_ = nullptr,
                        *splatLarge_ = nullptr;
  const ComputePipeline *floorShadow_ = nullptr, *tint_ = nullptr, *classify_ = nullptr, *shadeFluid_ = nullptr, *shadeFloor_ = nullptr;
  const ComputePipeline *shadeSky_ = nullptr, *shadeSolids_ = nullptr, *resolve_ = nullptr, *drawEdges_ = nullptr;
};

Expected<void> ParticleViewImpl::create(Device& device, const Scene& scene, const ParticleSet& particles) {
  auto uploaded = SceneBuffers::create(device, particleScene(scene, particles));
  if (!uploaded) return uploaded.error();
  buffers_ = *std::move(uploaded);

  using enum BindingKind;
  static constexpr BindingKind kStorage[] = {Storage, Storage, Storage, Storage, Storage, Storage};
  static constexpr BindingKind kWithScene[] = {Uniform, Storage, Storage, Storage, Storage, Storage, Storage, Storage};
  struct Wanted {
    const ComputePipeline*& pipeline;
    std::string_view shader;
    std::span<const BindingKind> bindings;
  };
  const std::span<const BindingKind> storage = kStorage, withScene = kWithScene;
  const Wanted all[] = {
      {edges_, "views/particle_edges", withScene.first(2)},
      {solidTiles_, "views/particle_solid_tiles", withScene.first(3)},
      {lightTiles_, "views/particle_light_tiles", withScene.first(3)},
      {surfaces_, "views/particle_surfaces", withScene.first(5)},
      {floor_, "views/particle_floor", withScene.first(3)},
      {lightSolids_, "views/particle_light_solids", withScene.first(5)},
      {project_, "views/particle_project", withScene.first(4)},
      {cull_, "views/particle_cull", storage.first(4)},
      {arguments_, "views/particle_arguments", storage.first(1)},
      {splat_, "views/particle_splat", storage.first(5)},
      {splatLarge_, "views/particle_splat_large", storage.first(5)},
      {floorShadow_, "views/particle_floor_shadow", withScene.first(3)},
      {tint_, "views/particle_tint", withScene.first(8)},
      {classify_, "views/particle_classify", storage.first(4)},
      {shadeFluid_, "views/particle_shade_fluid", withScene.first(8)},
      {shadeFloor_, "views/particle_shade_floor", withScene.first(8)},
      {shadeSky_, "views/particle_shade_sky", withScene.first(7)},
      {shadeSolids_, "views/particle_shade_solids", withScene.first(8)},
      {resolve_, "views/particle_resolve", storage.first(6)},
      {drawEdges_, "views/particle_draw_edges", storage.first(5)},
  };
  for (const Wanted& wanted : all) {
    auto made = computePipeline(device, {.shader = wanted.shader, .bindings = wanted.bindings, .pushConstantBytes = sizeof(ViewPush)});
    if (!made) return made.error();
    wanted.pipeline = *made;
  }
  return {};
}

ViewPush ParticleViewImpl::pushFor(const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc, double time) const {
  const CameraBasis basis = cameraBasis(camera);
  ViewPush push{};
  double distance = 0;
  for (int a = 0; a < 3; ++a) {
    push.eye[a] = static_cast<float>(camera.eye[a] - scene_.origin[a]);
    push.offset[a] = static_cast<float>(fluid.origin[a] - scene_.origin[a]);
    distance = std::hypot(distance, camera.target[a] - camera.eye[a]);
  }
  storeAxis(basis.right, push.right);
  storeAxis(basis.up, push.up);
  storeAxis(basis.forward, push.forward);
  const double focal = 0.5 * desc.height / std::tan(0.5 * camera.fov_y_deg * std::numbers::pi / 180);
  push.focal = static_cast<float>(focal);
  push.radius = 0.5f * fluid.spacing;
  push.near_depth = static_cast<float>(std::max({0.1 * push.radius, distance * kNearPart, 1e-6}));
  push.time = static_cast<float>(time);
  push.count = fluid.count;
  push.width = desc.width;
  push.height = desc.height;
  // A cell can be covered only by a sphere that is several cells wide at the usual distance.
  const double pixels = distance > 0 ? push.radius * focal / distance : 0;
  push.cell = pixels < 10 ? 2 : 4;
  push.compression = desc.color == ParticleColor::Compression ? 1 : 0;
  push.unlit = desc.unlit ? 1 : 0;
  const double scale = desc.scale_max > 0 ? desc.scale_max : (push.compression ? scene_.compression_max : scene_.speed_max);
  push.scale = static_cast<float>(1 / scale);
  return push;
}

void ParticleViewImpl::addSetup(Graph& graph, const FluidState& fluid, Frame& frame) {
  frame.scene = buffers_.importScene(graph);
  frame.counters = graph.create("view counters", {kCounterWords * 4});
  frame.edges = graph.create("view edges", {kEdges * sizeof(EdgeRecord)});
  graph.pass("view clear", [&](Pass& pass) {
    frame.counters = pass.write(frame.counters, Use::CopyTarget, true);
    return [counters = frame.counters](Commands& commands) { commands.fill(counters, 0); };
  });
  graph.pass("view edges", [&](Pass& pass) {
    pass.read(frame.scene, Use::ComputeUniform);
    frame.edges = pass.write(frame.edges, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(edges_, {frame.scene, frame.edges});
    return [kernel, push = frame.push](Commands& commands) { commands.dispatch(kernel, 1, push); };
  });
  if (scene_.solids.empty()) {
    graph.skipped("view poses", "the scene has no solids");
    return;
  }
  frame.poses = buffers_.addPoses(graph, fluid, frame.scene, frame.push);
}

/// Which solids may be seen in which tile.
BufferRef ParticleViewImpl::addMasks(Graph& graph, const Frame& frame, bool light) {
  const uint64_t tileCount =
      light ? tiles(scene_.scene.counts.y, scene_.scene.counts.z, kPixelTile) : tiles(frame.push.width, frame.push.height, kPixelTile);
  const uint64_t words = tileCount * groupsFor(scene_.solids.size(), 32);
  BufferRef masks = graph.create(light ? "view light masks" : "view solid masks", {words * 4});
  graph.pass("view solid tiles", [&](Pass& pass) {
    pass.read(frame.scene, Use::ComputeUniform);
    pass.read(frame.poses, Use::ComputeRead);
    masks = pass.write(masks, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(light ? lightTiles_ : solidTiles_, {frame.scene, frame.poses, masks});
    return [kernel, groups = groupsFor(words, kParticleGroup), push = frame.push](Commands& commands) {
      commands.dispatch(kernel, groups, push);
    };
  });
  return masks;
}

void ParticleViewImpl::addSurfaces(Graph& graph, Frame& frame) {
  const bool bare = scene_.solids.empty();
  BufferRef masks;
  if (!bare) masks = addMasks(graph, frame, false);
  frame.depth = graph.create("view depth", {frame.pixels * 4});
  frame.winner = graph.create("view winner", {frame.pixels * 4});
  graph.pass("view surfaces", [&](Pass& pass) {
    pass.read(frame.scene, Use::ComputeUniform);
    frame.depth = pass.write(frame.depth, Use::ComputeWrite, true);
    frame.winner = pass.write(frame.winner, Use::ComputeWrite, true);
    Kernel kernel;
    if (bare) {
      kernel = pass.kernel(floor_, {frame.scene, frame.depth, frame.winner});
    } else {
      pass.read(frame.poses, Use::ComputeRead);
      pass.read(masks, Use::ComputeRead);
      kernel = pass.kernel(surfaces_, {frame.scene, frame.depth, frame.winner, frame.poses, masks});
    }
    const uint64_t groups = tiles(frame.push.width, frame.push.height, kPixelTile);
    return [kernel, groups, push = frame.push](Commands& commands) { commands.dispatch(kernel, groups, push); };
  });
}

void ParticleViewImpl::addLightMap(Graph& graph, Frame& frame) {
  if (!hasShadows(frame)) return;
  frame.light = graph.create("view light map", {lightTexels() * 4});
  if (scene_.solids.empty()) {
    graph.skipped("view light solids", "the scene has no solids");
    graph.pass("view clear", [&](Pass& pass) {
      frame.light = pass.write(frame.light, Use::CopyTarget, true);
      return [light = frame.light](Commands& commands) { commands.fill(light, kInfinity); };
    });
    return;
  }
  const BufferRef masks = addMasks(graph, frame, true);
  graph.pass("view light solids", [&](Pass& pass) {
    pass.read(frame.scene, Use::ComputeUniform);
    pass.read(frame.poses, Use::ComputeRead);
    pass.read(masks, Use::ComputeRead);
    frame.light = pass.write(frame.light, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(lightSolids_, {frame.scene, frame.light, frame.light, frame.poses, masks});
    const uint64_t groups = tiles(scene_.scene.counts.y, scene_.scene.counts.z, kPixelTile);
    return [kernel, groups, push = frame.push](Commands& commands) { commands.dispatch(kernel, groups, push); };
  });
}

void ParticleViewImpl::addVisibility(Graph& graph, Frame& frame) {
  const uint64_t groups = groupsFor(frame.push.count, kParticleGroup);
  BufferRef occluders = graph.create("view occluders", {tiles(frame.push.width, frame.push.height, frame.push.cell) * 4});
  frame.survivors = graph.create("view survivors", {uint64_t{frame.push.count} * 4});
  graph.pass("view clear", [&](Pass& pass) {
    occluders = pass.write(occluders, Use::CopyTarget, true);
    return [occluders](Commands& commands) { commands.fill(occluders, kInfinity); };
  });
  graph.pass("view project", [&](Pass& pass) {
    pass.read(frame.scene, Use::ComputeUniform);
    pass.read(frame.position, Use::ComputeRead);
    occluders = pass.write(occluders, Use::ComputeWrite);
    frame.light = pass.write(frame.light, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(project_, {frame.scene, frame.position, occluders, frame.light});
    return [kernel, groups, push = frame.push](Commands& commands) { commands.dispatch(kernel, groups, push); };
  });
  graph.pass("view cull", [&](Pass& pass) {
    pass.read(frame.position, Use::ComputeRead);
    pass.read(occluders, Use::ComputeRead);
    frame.counters = pass.write(frame.counters, Use::ComputeWrite);
    frame.survivors = pass.write(frame.survivors, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(cull_, {frame.position, occluders, frame.counters, frame.survivors});
    return [kernel, groups, push = frame.push](Commands& commands) { commands.dispatch(kernel, groups, push); };
  });
  graph.pass("view arguments", [&](Pass& pass) {
    frame.counters = pass.write(frame.counters, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(arguments_, {frame.counters});
    return [kernel, push = frame.push](Commands& commands) { commands.dispatch(kernel, 1, push); };
  });
}

void ParticleViewImpl::addSplat(Graph& graph, Frame& frame, bool winners) {
  for (const bool large : {false, true}) {
    constexpr std::string_view kNames[4] = {"view depth", "view depth large", "view winner", "view winner large"};
    graph.pass(kNames[(winners ? 2 : 0) + (large ? 1 : 0)], [&](Pass& pass) {
      pass.read(frame.position, Use::ComputeRead);
      pass.read(frame.counters, Use::ComputeRead);
      pass.read(frame.counters, Use::Indirect);
      pass.read(frame.survivors, Use::ComputeRead);
      // One of the two is written: the kernel is the same, so that both runs find the very same depths.
      BufferRef& written = winners ? frame.winner : frame.depth;
      pass.read(winners ? frame.depth : frame.winner, Use::ComputeRead);
      written = pass.write(written, Use::ComputeWrite);
      const Kernel kernel =
          pass.kernel(large ? splatLarge_ : splat_, {frame.position, frame.counters, frame.survivors, frame.depth, frame.winner});
      ViewPush push = frame.push;
      push.winners = winners ? 1 : 0;
      return [kernel, counters = frame.counters, offset = 4 * (large ? kLargeArguments : kSmallArguments), push](Commands& commands) {
        commands.dispatchIndirect(kernel, counters, offset, push);
      };
    });
  }
}

void ParticleViewImpl::addTint(Graph& graph, Frame& frame) {
  frame.tint = graph.create("view tint", {std::max<uint64_t>(frame.push.count, 1) * 8});
  graph.pass("view tint", [&](Pass& pass) {
    pass.read(frame.scene, Use::ComputeUniform);
    pass.read(frame.position, Use::ComputeRead);
    pass.read(frame.velocity, Use::ComputeRead);
    pass.read(frame.counters, Use::ComputeRead);
    pass.read(frame.counters, Use::Indirect);
    pass.read(frame.survivors, Use::ComputeRead);
    pass.read(frame.depth, Use::ComputeRead);
    pass.read(frame.light, Use::ComputeRead);
    frame.tint = pass.write(frame.tint, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(
        tint_, {frame.scene, frame.position, frame.velocity, frame.counters, frame.survivors, frame.depth, frame.light, frame.tint});
    return [kernel, counters = frame.counters, push = frame.push](Commands& commands) {
      commands.dispatchIndirect(kernel, counters, 4 * kTintArguments, push);
    };
  });
}

void ParticleViewImpl::addFloorShadow(Graph& graph, Frame& frame) {
  if (!hasFloor() || !hasShadows(frame) || frame.push.unlit) {
    graph.skipped("view floor shadow", !hasFloor()        ? "the domain has no floor"
                                       : frame.push.unlit ? "nothing is lit"
                                                          : "nothing casts a shadow");
    frame.floor = frame.edges;  // not looked at
    return;
  }
  frame.floor = graph.create("view floor light", {lightTexels() * 4});
  graph.pass("view floor shadow", [&](Pass& pass) {
    pass.read(frame.scene, Use::ComputeUniform);
    pass.read(frame.light, Use::ComputeRead);
    frame.floor = pass.write(frame.floor, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(floorShadow_, {frame.scene, frame.light, frame.floor});
    const uint64_t groups = groupsFor(lightTexels(), kParticleGroup);
    return [kernel, groups, push = frame.push](Commands& commands) { commands.dispatch(kernel, groups, push); };
  });
}

void ParticleViewImpl::addClassify(Graph& graph, Frame& frame) {
  const uint64_t tileCount = tiles(frame.push.width, frame.push.height, kShadeTile);
  frame.tiles = graph.create("view tiles", {tileCount * kTileLists * 4});
  graph.pass("view classify", [&](Pass& pass) {
    pass.read(frame.winner, Use::ComputeRead);
    pass.read(frame.edges, Use::ComputeRead);
    frame.counters = pass.write(frame.counters, Use::ComputeWrite);
    frame.tiles = pass.write(frame.tiles, Use::ComputeWrite, true);
    const Kernel kernel = pass.kernel(classify_, {frame.winner, frame.edges, frame.counters, frame.tiles});
    return [kernel, groups = groupsFor(tileCount, kParticleGroup), push = frame.push](Commands& commands) {
      commands.dispatch(kernel, groups, push);
    };
  });
  graph.pass("view arguments", [&](Pass& pass) {
    frame.counters = pass.write(frame.counters, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(arguments_, {frame.counters});
    return [kernel, push = frame.push](Commands& commands) { commands.dispatch(kernel, 1, push); };
  });
}

/// Kernels that run on a list of tiles: each writes the pixels of its own kind, together they write all.
void ParticleViewImpl::addShade(Graph& graph, Frame& frame) {
  frame.shaded = graph.create("view shaded", {frame.pixels * 4});
  frame.rims = graph.create("view rims", {frame.pixels * 4});
  frame.picture = graph.create("view picture", {frame.pixels * 4});
  const auto onTiles = [&](Kernel kernel, uint32_t list) {
    return [kernel, counters = frame.counters, offset = 4 * (kTileArguments + 4 * list), push = frame.push](Commands& commands) {
      commands.dispatchIndirect(kernel, counters, offset, push);
    };
  };
  const auto readLists = [&](Pass& pass) {
    pass.read(frame.counters, Use::ComputeRead);
    pass.read(frame.counters, Use::Indirect);
    pass.read(frame.tiles, Use::ComputeRead);
  };
  const auto backdrop = [&](std::string_view name, const ComputePipeline* pipeline, uint32_t list, bool first, const BufferRef* light) {
    graph.pass(name, [&](Pass& pass) {
      readLists(pass);
      pass.read(frame.scene, Use::ComputeUniform);
      pass.read(frame.winner, Use::ComputeRead);
      for (BufferRef* buffer : {&frame.shaded, &frame.rims, &frame.picture}) *buffer = pass.write(*buffer, Use::ComputeWrite, first);
      if (!light)
        return onTiles(
            pass.kernel(pipeline, {frame.scene, frame.counters, frame.tiles, frame.winner, frame.shaded, frame.rims, frame.picture}), list);
      pass.read(*light, Use::ComputeRead);
      return onTiles(
          pass.kernel(pipeline, {frame.scene, frame.counters, frame.tiles, frame.winner, *light, frame.shaded, frame.rims, frame.picture}),
          list);
    });
  };
  backdrop("view shade sky", shadeSky_, kTilesSky, true, nullptr);
  if (hasFloor()) backdrop("view shade floor", shadeFloor_, kTilesFloor, false, &frame.floor);
  const bool fluid = frame.push.count > 0, solids = !scene_.solids.empty();
  if (fluid) {
    graph.pass("view shade fluid", [&](Pass& pass) {
      readLists(pass);
      pass.read(frame.scene, Use::ComputeUniform);
      for (const BufferRef& buffer : {frame.winner, frame.position, frame.tint}) pass.read(buffer, Use::ComputeRead);
      for (BufferRef* buffer : {&frame.shaded, &frame.rims}) *buffer = pass.write(*buffer, Use::ComputeWrite);
      return onTiles(pass.kernel(shadeFluid_, {frame.scene, frame.counters, frame.tiles, frame.winner, frame.position, frame.tint,
                                               frame.shaded, frame.rims}),
                     kTilesFluid);
    });
  }
  if (solids) {
    graph.pass("view shade solids", [&](Pass& pass) {
      readLists(pass);
      pass.read(frame.scene, Use::ComputeUniform);
      for (const BufferRef& buffer : {frame.winner, frame.poses, frame.light}) pass.read(buffer, Use::ComputeRead);
      for (BufferRef* buffer : {&frame.shaded, &frame.rims}) *buffer = pass.write(*buffer, Use::ComputeWrite);
      return onTiles(pass.kernel(shadeSolids_, {frame.scene, frame.counters, frame.tiles, frame.winner, frame.poses, frame.light,
                                                frame.shaded, frame.rims}),
                     kTilesSolid);
    });
  }
  if (fluid || solids) {
    graph.pass("view resolve", [&](Pass& pass) {
      readLists(pass);
      for (const BufferRef& buffer : {frame.depth, frame.shaded, frame.rims}) pass.read(buffer, Use::ComputeRead);
      frame.picture = pass.write(frame.picture, Use::ComputeWrite);
      return onTiles(pass.kernel(resolve_, {frame.counters, frame.tiles, frame.depth, frame.shaded, frame.rims, frame.picture}),
                     kTilesOutline);
    });
  }
  if (scene_.scene.domain_min.w > 0) {
    graph.pass("view draw edges", [&](Pass& pass) {
      readLists(pass);
      for (const BufferRef& buffer : {frame.depth, frame.edges}) pass.read(buffer, Use::ComputeRead);
      frame.picture = pass.write(frame.picture, Use::ComputeWrite);
      return onTiles(pass.kernel(drawEdges_, {frame.counters, frame.tiles, frame.edges, frame.depth, frame.picture}), kTilesEdge);
    });
  }
}

BufferRef ParticleViewImpl::addTo(Graph& graph, const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc,
                                  double time) {
  Frame frame;
  frame.push = pushFor(fluid, camera, desc, time);
  frame.pixels = uint64_t{desc.width} * desc.height;
  frame.position = fluid.position;
  frame.velocity = fluid.velocity;
  addSetup(graph, fluid, frame);
  addSurfaces(graph, frame);
  addLightMap(graph, frame);
  if (fluid.count > 0) {
    addVisibility(graph, frame);
    addSplat(graph, frame, false);
    addSplat(graph, frame, true);
    addTint(graph, frame);
  } else {
    graph.skipped("view depth", "the scene has no particles");
  }
  addFloorShadow(graph, frame);
  addClassify(graph, frame);
  addShade(graph, frame);
  return frame.picture;
}

Expected<std::unique_ptr<ParticleView>> ParticleView::create(Device& device, const Scene& scene, const ParticleSet& particles) {
  auto impl = std::make_unique<ParticleViewImpl>();
  if (auto ok = impl->create(device, scene, particles); !ok) return ok.error();
  return std::unique_ptr<ParticleView>(new ParticleView(std::move(impl)));
}

ParticleView::ParticleView(std::unique_ptr<ParticleViewImpl> impl) : impl_(std::move(impl)) {}
ParticleView::~ParticleView() = default;

Expected<void> ParticleView::check(const ParticleViewDesc& desc) {
  const bool fits = desc.width >= 1 && desc.height >= 1 && desc.width <= kMaxSide && desc.height <= kMaxSide &&
                    uint64_t{desc.width} * desc.height <= kMaxPixels;
  if (fits) return {};
  return Error{ErrorKind::BadInput, "a picture of " + std::to_string(desc.width) + "x" + std::to_string(desc.height) +
                                        " pixels: width and height must be 1 to " + std::to_string(kMaxSide) +
                                        " and their product at most " + std::to_string(kMaxPixels)};
}

BufferRef ParticleView::addTo(Graph& graph, const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc,
                              double time_s) {
  assert(check(desc));
  return impl_->addTo(graph, fluid, camera, desc, time_s);
}

double ParticleView::scaleMax(ParticleColor color) const {
  return color == ParticleColor::Speed ? impl_->scene_.speed_max : impl_->scene_.compression_max;
}

}  // namespace rill
