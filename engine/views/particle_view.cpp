#include "views/particle_view.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "gpu/module_pipelines.hpp"
#include "render/mixture.hpp"

namespace rill {
namespace {

using namespace particle_view;

constexpr uint32_t kMaxSide = 8192;
constexpr uint64_t kMaxPixels = uint64_t{1} << 25;  // 128 MiB of 4 bytes
constexpr double kMinNear = 1e-4;                   // of the distance to the target: the nearest near plane

void storeAxis(const Double3& from, float to[3]) {
  for (int a = 0; a < 3; ++a) to[a] = static_cast<float>(from[a]);
}

}  // namespace

Expected<std::unique_ptr<ParticleView>> ParticleView::create(Device& device, const Scene& scene, const ParticleSet& particles) {
  auto uploaded = SceneBuffers::create(device, particleScene(scene, particles));
  if (!uploaded) return uploaded.error();
  auto out = std::make_unique<ParticleView>();
  out->buffers_ = *std::move(uploaded);

  std::vector<std::pair<const ComputePipeline*&, const char*>> all = {
      {out->edges_, "edges"},
      {out->solidTiles_, "solid_tiles"},
      {out->lightTiles_, "light_tiles"},
      {out->rays_.surfaces, "surfaces"},
      {out->floor_, "floor"},
      {out->rays_.lightSolids, "light_solids"},
      {out->project_, "project"},
      {out->cull_, "cull"},
      {out->arguments_, "arguments"},
      {out->splat_, "splat"},
      {out->splatLarge_, "splat_large"},
      {out->floorShadow_, "floor_shadow"},
      {out->tint_, "tint"},
      {out->classify_, "classify"},
      {out->shadeFluid_, "shade_fluid"},
      {out->shadeFloor_, "shade_floor"},
      {out->shadeShadowedFloor_, "shade_floor_shadows"},
      {out->shadeSky_, "shade_sky"},
      {out->rays_.shadeSolids, "shade_solids"},
      {out->resolve_, "resolve"},
      {out->drawEdges_, "draw_edges"},
  };
  const bool meshes = std::ranges::any_of(out->scene().solids, [](const SceneSolid& s) { return s.shape.kind == kShapeMesh; });
  if (meshes) {
    all.emplace_back(out->meshRays_.surfaces, "surfaces_meshes");
    all.emplace_back(out->meshRays_.lightSolids, "light_solids_meshes");
    all.emplace_back(out->meshRays_.shadeSolids, "shade_solids_meshes");
  }
  for (const auto& [pipeline, shader] : all) {
    auto made = computePipeline(device, {.shader = std::string("views/particle_") + shader});
    if (!made) return made.error();
    pipeline = *made;
  }
  if (!diffusingFluids(scene).empty()) {
    std::vector<bool> diffuses;
    for (const FluidMaterial& fluid : scene.fluids) diffuses.push_back(fluid.diffusion > 0);
    const MixtureConstants m = mixtureConstants(diffuses);
    ModulePipelines pipelines(device);
    out->mixedTint_ = pipelines.make("views/particle_tint_mixed", false,
                                     {{"DIFFUSING_0", m.diffusing[0]},
                                      {"DIFFUSING_1", m.diffusing[1]},
                                      {"DIFFUSING_2", m.diffusing[2]},
                                      {"DIFFUSING_3", m.diffusing[3]},
                                      {"CARRIER", m.carrier}});
    if (auto made = pipelines.result(); !made) return made.error();
  }
  auto groups = computePipeline(device, {.shader = "render/particle_groups"});
  if (!groups) return groups.error();
  out->particleGroups_ = *groups;
  return out;
}

ViewPush ParticleView::pushConstants(const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc, double time_s) const {
  const CameraBasis basis = cameraBasis(camera);
  ViewPush push{};
  double distance = 0;
  for (int a = 0; a < 3; ++a) {
    push.eye[a] = static_cast<float>(camera.eye[a] - scene().origin[a]);
    push.offset[a] = static_cast<float>(fluid.origin[a] - scene().origin[a]);
    distance = std::hypot(distance, camera.target[a] - camera.eye[a]);
  }
  storeAxis(basis.right, push.right);
  storeAxis(basis.up, push.up);
  storeAxis(basis.forward, push.forward);
  const double focal = 0.5 * desc.height / std::tan(0.5 * camera.fov_y_deg * std::numbers::pi / 180);
  push.focal = static_cast<float>(focal);
  push.radius = 0.5f * fluid.spacing;
  push.near_depth = static_cast<float>(std::max({0.1 * push.radius, distance * kMinNear, 1e-6}));
  push.time = static_cast<float>(time_s);
  push.count = fluid.capacity;
  push.width = desc.width;
  push.height = desc.height;
  // A sphere covers a cell only where it is several cells wide.
  const double pixels = distance > 0 ? push.radius * focal / distance : 0;
  push.cell = pixels < 10 ? 2 : 4;
  push.coloring = desc.color == ParticleColor::Fluid ? kByFluid : desc.color == ParticleColor::Compression ? kByCompression : kBySpeed;
  push.unlit = desc.unlit ? 1 : 0;
  const double scale = desc.scale_max > 0 ? desc.scale_max : scaleMax(desc.color);
  push.scale = static_cast<float>(1 / scale);
  return push;
}

BufferRef ParticleView::addTo(Graph& graph, const FluidState& fluid, const CameraView& camera, const ParticleViewDesc& desc,
                              double time_s) const {
  assert(check(desc));
  Frame frame;
  frame.push = pushConstants(fluid, camera, desc, time_s);
  frame.pixels = uint64_t{desc.width} * desc.height;
  frame.position = fluid.position;
  frame.velocity = fluid.velocity;
  frame.concentration = fluid.concentration;
  if (meshRays_.surfaces) frame.meshWords = fluid.meshWords;
  if (fluid.capacity > 0) frame.particles = countParticles(graph, fluid, particleGroups_, kParticleGroup);
  addSetup(graph, fluid, frame);
  addSurfaces(graph, frame);
  addLightMap(graph, frame);
  if (fluid.capacity > 0) {
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

Expected<void> ParticleView::check(const ParticleViewDesc& desc) {
  const bool fits = desc.width >= 1 && desc.height >= 1 && desc.width <= kMaxSide && desc.height <= kMaxSide &&
                    uint64_t{desc.width} * desc.height <= kMaxPixels;
  if (fits) return {};
  return Error{ErrorKind::BadInput, "a picture of " + std::to_string(desc.width) + "x" + std::to_string(desc.height) +
                                        " pixels: width and height must be 1 to " + std::to_string(kMaxSide) +
                                        " and their product at most " + std::to_string(kMaxPixels)};
}

double ParticleView::scaleMax(ParticleColor color) const {
  return color == ParticleColor::Compression ? scene().compression_max : scene().speed_max;
}

}  // namespace rill
