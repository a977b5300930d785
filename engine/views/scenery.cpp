#include "views/scenery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "render/fluid_renderer_impl.hpp"
#include "render/view_push.hpp"

namespace rill {
namespace {

using surface::SurfacePush;

constexpr VkFormat kShadowFormat = VK_FORMAT_D32_SFLOAT;
constexpr Double3 kBehindTank = {-0.5, 0.9, -0.65};  // the studio's light: light through the fluid falls on the table before the tank
constexpr uint32_t kEdgeVertices = 6, kEdgeCount = 12, kSolidVertices = 36;

Float3 xyz(const Float4& v) { return {v.x, v.y, v.z}; }

VkClearValue depthClear(float depth) {
  VkClearValue value{};
  value.depthStencil = {depth, 0};
  return value;
}

}  // namespace

FluidView fluidView(const CameraView& camera, uint32_t width, uint32_t height, double spacing, const CameraOffset& offset) {
  const CameraBasis basis = cameraBasis(camera);
  FluidView view;
  double distance = 0;
  const auto set = [](Float4& column, double x, double y, double z) {
    column = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0};
  };
  for (int a = 0; a < 3; ++a) {
    view.origin[a] = camera.eye[a] + offset.right_m * basis.right[a] + offset.up_m * basis.up[a];
    distance = std::hypot(distance, camera.target[a] - camera.eye[a]);
    set(view.view.column[a], basis.right[a], basis.up[a], -basis.forward[a]);
  }
  const double focal = 1 / std::tan(0.5 * camera.fov_y_deg * std::numbers::pi / 180);
  const double near = std::max({0.1 * spacing, 1e-4 * distance, 1e-6});
  view.projection.column[0] = {static_cast<float>(focal * height / width), 0, 0, 0};
  view.projection.column[1] = {0, static_cast<float>(-focal), 0, 0};
  const double x = 2 * offset.x_px / width - focal * height / width * offset.right_m / offset.focus_m;
  const double y = 2 * offset.y_px / height + focal * offset.up_m / offset.focus_m;
  view.projection.column[2] = {static_cast<float>(x), static_cast<float>(y), 0, -1};
  view.projection.column[3] = {0, 0, static_cast<float>(near), 0};
  view.width = width;
  view.height = height;
  view.focus_m = distance;
  return view;
}

Expected<std::unique_ptr<Scenery>> Scenery::create(Device& device, const Scene& scene, const ParticleSet& particles,
                                                   const TargetFormats& formats, const Environment* environment) {
  auto out = std::make_unique<Scenery>();
  out->environment_ = environment;
  std::optional<Double3> toSun;
  if (environment && environment->sun()) {
    const Float3& to = environment->sun()->direction;
    toSun = {to.x, to.y, to.z};
  }
  if (scene.look.stage == "tank" && scene.domain) {
    auto glass = GlassTank::create(device, *scene.domain, particles.origin, formats, environment != nullptr);
    if (!glass) return glass.error();
    out->tank_ = *std::move(glass);
  }
  if (out->tank_ && !environment) toSun = kBehindTank;
  ParticleScene host = particleScene(scene, particles, toSun);
  if (out->tank_) host.scene.domain_max.w = 0;  // no grid
  auto buffers = SceneBuffers::create(device, std::move(host));
  if (!buffers) return buffers.error();
  out->buffers_ = *std::move(buffers);
  auto stage = SurfaceStage::create(device);
  if (!stage) return stage.error();
  out->stage_ = *stage;
  if (std::vector<FluidBody> bodies = fluidBodies(scene); bodies.size() > 1) out->fluids_ = std::move(bodies);
  const auto fluids = static_cast<uint32_t>(std::max<size_t>(out->fluids_.size(), 1));
  if (fluids > 1)
    if (auto set = out->stage_.setFluids(device, out->fluids_); !set) return set.error();
  auto meshes = SceneMeshes::create(device, scene);
  if (!meshes) return meshes.error();
  out->meshes_ = *std::move(meshes);
  out->hasRayCast_ = std::ranges::any_of(out->buffers_.host.solids, [](const auto& s) { return s.shape.kind != kShapeMesh; });
  const bool solids = !out->buffers_.host.solids.empty();
  const std::span<const VkFormat> color{&formats.color, 1};
  struct Wanted {
    const GraphicsPipeline*& pipeline;
    GraphicsPipelineDesc desc;
  };
  const auto desc = [&](std::string_view vertex, std::string_view fragment) {
    return GraphicsPipelineDesc{.vertex = vertex,
                                .fragment = fragment,
                                .colors = color,
                                .depth = formats.depth,
                                .depthCompare = VK_COMPARE_OP_GREATER,
                                .depthWrite = true};
  };
  const std::string around = out->hasGround() ? (solids ? "ground_solids" : "ground") : "sky", sky = environment ? "_environment" : "";
  if (scene.look.caustics && (solids || out->hasGround())) {
    auto caustics = Caustics::create(device, solids, fluids);
    if (!caustics) return caustics.error();
    out->caustics_ = *caustics;
  }
  GraphicsPipelineDesc edges = desc("views/scenery_edges_vertex", "views/scenery_edges_fragment");
  edges.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  edges.depthWrite = false;
  edges.blend = Blend::Premultiplied;
  GraphicsPipelineDesc over = edges;
  over.fragment = "views/scenery_edges_over_fluid_fragment";
  std::vector<Wanted> all{{out->edges_, edges}, {out->edgesOverFluid_, over}};
  if (!out->buffers_.host.lines.empty()) {
    GraphicsPipelineDesc lines = edges, linesOver = over;
    lines.vertex = linesOver.vertex = "views/scenery_lines_vertex";
    linesOver.fragment = "views/scenery_lines_over_fluid_fragment";
    all.push_back({out->lines_, lines});
    all.push_back({out->linesOverFluid_, linesOver});
  }
  GraphicsPipelineDesc light = desc("views/scenery_solid_light_vertex", "views/scenery_solid_light_fragment");
  light.colors = {};
  light.depth = kShadowFormat;
  light.depthCompare = VK_COMPARE_OP_LESS;
  if (out->hasRayCast_) all.push_back({out->solidLight_, light});
  if (out->hasMeshes()) {
    light.vertex = "views/scenery_mesh_light_vertex";
    light.fragment = {};
    all.push_back({out->meshLight_, light});
  }
  std::string shaderNames[2][3];
  for (const bool refracted : {false, true}) {
    if (refracted && !out->caustics_) continue;
    const std::string suffix = sky + (refracted ? "_caustics" : "") + "_fragment";
    auto& [groundShader, solidShader, meshShader] = shaderNames[refracted];
    Drawing& drawing = refracted ? out->refracted_ : out->plain_;
    groundShader = "views/scenery_" + around + (out->hasGround() ? suffix : sky + "_fragment");
    solidShader = "views/scenery_solid" + suffix;
    meshShader = "views/scenery_mesh" + suffix;
    const auto inShadow = [&](const GraphicsPipeline*& pipeline, std::string_view vertex, std::string_view fragment, VkCompareOp compare) {
      GraphicsPipelineDesc made = desc(vertex, fragment);
      made.depthCompare = compare;
      if (fluids > 1) made.constants = {&fluids, 1};
      all.push_back({pipeline, made});
    };
    inShadow(drawing.ground, "views/scenery_ground_vertex", groundShader, VK_COMPARE_OP_ALWAYS);
    if (out->hasRayCast_) inShadow(drawing.solid, "views/scenery_solid_vertex", solidShader, VK_COMPARE_OP_GREATER);
    if (out->hasMeshes()) inShadow(drawing.mesh, "views/scenery_mesh_vertex", meshShader, VK_COMPARE_OP_GREATER);
  }
  for (const Wanted& wanted : all) {
    auto made = graphicsPipeline(device, wanted.desc);
    if (!made) return made.error();
    wanted.pipeline = *made;
  }
  return out;
}

Float3 Scenery::toSun() const { return xyz(buffers_.host.scene.light_to); }

SunView Scenery::sunView() const {
  const particle_view::SceneRecord& scene = buffers_.host.scene;
  const auto wide = [](const Float4& v) { return Double3{double{v.x}, double{v.y}, double{v.z}}; };
  SunView view;
  view.origin = buffers_.host.origin;
  view.u = wide(scene.light_u);
  view.v = wide(scene.light_v);
  view.toSun = wide(scene.light_to);
  view.first_u = double{scene.light_u.w};
  view.first_v = double{scene.light_v.w};
  view.nearest = double{scene.light_to.w};
  view.texel = double{scene.light_texel.x};
  view.depths = double{scene.light_texel.y};
  view.width = scene.counts.y;
  view.height = scene.counts.z;
  view.floor = hasGround();
  if (hasDomain()) {
    view.low = wide(scene.domain_min);
    view.high = wide(scene.domain_max);
    view.closed = scene.counts.w;
  }
  return view;
}

/// The light map's frame as an orthographic camera, for positions relative to `origin`.
SurfacePush Scenery::lightPush(const FluidState& fluid, const Double3& origin) const {
  const particle_view::SceneRecord& scene = buffers_.host.scene;
  SurfacePush push{};
  const Float4* axes[2] = {&scene.light_u, &scene.light_v};
  const auto along = [&](const Float4& axis) {
    return axis.x * (origin[0] - buffers_.host.origin[0]) + axis.y * (origin[1] - buffers_.host.origin[1]) +
           axis.z * (origin[2] - buffers_.host.origin[2]);
  };
  const uint32_t size[2] = {scene.counts.y, scene.counts.z};
  for (int r = 0; r < 2; ++r) {
    const Float4& axis = *axes[r];
    const float row[4] = {axis.x, axis.y, axis.z, static_cast<float>(along(axis))};
    std::copy_n(row, 4, push.rows + 4 * r);
    // Texel k is at axis.w + k texels, and the middle of pixel k.
    const float texels = static_cast<float>(size[r]);
    push.scale[r] = 0.5f * scene.light_texel.x * texels;
    push.shift[r] = 1.0f / texels - 1.0f - axis.w / push.scale[r];
  }
  const float depth[4] = {-scene.light_to.x, -scene.light_to.y, -scene.light_to.z,
                          static_cast<float>(scene.light_to.w - along(scene.light_to))};
  std::copy_n(depth, 4, push.rows + 8);
  push.depth_map[0] = 0;
  push.depth_map[1] = 1 / scene.light_texel.y;
  push.near_depth = -1e30f;
  push.width = size[0];
  push.height = size[1];
  push.step = 1;
  push.spacing = fluid.spacing;
  return push;
}

/// Depth of the solids from the light.
ImageRef Scenery::addSolidShadows(Graph& graph, BufferRef poses, const SceneMeshes::Refs& meshes, const SurfacePush& light) const {
  ImageRef depth = graph.create("scenery light depth", {kShadowFormat, light.width, light.height});
  graph.pass("scenery shadows", [&](Pass& pass) {
    depth = pass.write(depth, Use::DepthTarget, Load::Clear, depthClear(1));
    Kernel solid, triangles;
    if (hasRayCast_) solid = bindNamed(pass, solidLight_, {{"placed", poses}});
    if (hasMeshes())
      triangles = bindNamed(pass, meshLight_, {{"placed", poses}, {"mesh_parts", meshes.parts}, {"mesh_triangles", meshes.triangles}});
    return [this, solid, triangles, light](Commands& commands) {
      if (hasRayCast_) commands.draw(solid, kSolidVertices, static_cast<uint32_t>(buffers_.host.solids.size()), light);
      if (hasMeshes()) meshes_.draw(commands, triangles, light);
    };
  });
  return depth;
}

/// The solids into the targets; `lit` is what their shaders read.
void Scenery::addSolids(Graph& graph, SceneTargets& targets, const SurfacePush& camera, const Drawing& drawing,
                        std::span<const Named> lit) const {
  if (hasRayCast_) {
    graph.pass("scenery solids", [&](Pass& pass) {
      targets.color = pass.write(targets.color, Use::ColorTarget);
      targets.depth = pass.write(targets.depth, Use::DepthTarget);
      const Kernel kernel = bindNamed(pass, drawing.solid, lit);
      return [kernel, camera, count = static_cast<uint32_t>(buffers_.host.solids.size())](Commands& commands) {
        commands.draw(kernel, kSolidVertices, count, camera);
      };
    });
  } else {
    graph.skipped("scenery solids", "all solids are meshes");
  }
  if (!hasMeshes()) {
    graph.skipped("scenery meshes", "no solid is a mesh");
    return;
  }
  graph.pass("scenery meshes", [&](Pass& pass) {
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Kernel kernel = bindNamed(pass, drawing.mesh, lit);
    return [this, kernel, camera](Commands& commands) { meshes_.draw(commands, kernel, camera); };
  });
}

/// The map of caustics; empty where there are none.
BufferRef Scenery::addCaustics(Graph& graph, const FluidState& fluid, const FluidLook& look, BufferRef shadow, double unit,
                               ImageRef lightDepth, BufferRef record) const {
  if (!caustics_) return {};
  const SunView view = sunView();
  const char* reason = fluid.capacity == 0                ? "there are no particles"
                       : look.opaque                      ? "the look is opaque"
                       : view.toSun.y < Caustics::kLowest ? "the sun is too low"
                                                          : nullptr;
  if (reason) {
    graph.skipped("caustics rays", reason);
    return {};
  }
  return caustics_->addTo(graph, fluid, look, view, shadow, unit, lightDepth, record).map;
}

SceneTargets Scenery::addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view, const FluidLook& look,
                            double time_s, BufferRef texels) const {
  const bool solids = !buffers_.host.solids.empty();
  SurfacePush camera = viewPush(view, buffers_.host.origin);
  camera.spacing = fluid.spacing;
  const BufferRef scene = buffers_.importScene(graph);
  const SurfacePush light = SurfaceStage::thicknessPush(lightPush(fluid, fluid.origin), fluid, 1);
  BufferRef shadow;
  if (solids || hasGround())
    shadow = stage_.addThickness(graph, kFluidShadow, fluid, light, {}, nullptr,
                                 SurfaceStage::Of::EachFluid);  // a particle spans five texels at most
  else
    graph.skipped(kFluidShadow.pass, "there is nothing that it falls on");
  const BufferRef record = addLook(graph, lookRecord(look, light, environment_, fluids_));
  BufferRef poses;
  ImageRef lightDepth;
  const SceneMeshes::Refs meshes = hasMeshes() ? meshes_.addTo(graph) : SceneMeshes::Refs{};
  if (solids) {
    particle_view::ViewPush push{};
    push.time = static_cast<float>(time_s);
    for (int a = 0; a < 3; ++a) push.offset[a] = static_cast<float>(fluid.origin[a] - buffers_.host.origin[a]);
    poses = buffers_.addPoses(graph, fluid, scene, push);
    lightDepth = addSolidShadows(graph, poses, meshes, lightPush(fluid, buffers_.host.origin));
  } else {
    graph.skipped("scenery solids", "the scene has no solids");
  }
  const BufferRef caustics = addCaustics(graph, fluid, look, shadow, double{light.unit}, lightDepth, record);
  const Drawing& drawing = caustics == BufferRef{} ? plain_ : refracted_;
  const Named lit[] = {{"scene", scene},      {"look", record},        {"fluid_shadow", shadow},     {"light_depth", lightDepth},
                       {"placed", poses},     {"environment", texels}, {"mesh_parts", meshes.parts}, {"mesh_triangles", meshes.triangles},
                       {"caustics", caustics}};
  graph.pass("scenery ground", [&](Pass& pass) {
    targets.color = pass.write(targets.color, Use::ColorTarget, Load::Discard);
    targets.depth = pass.write(targets.depth, Use::DepthTarget, Load::Discard);
    const Kernel kernel = bindNamed(pass, drawing.ground, lit);
    return [kernel, camera](Commands& commands) { commands.draw(kernel, 3, 1, camera); };
  });
  if (solids) addSolids(graph, targets, camera, drawing, lit);
  addLines(graph, "scenery outlines", targets, lines_, camera, time_s);
  if (tank_) tank_->addTo(graph, targets, camera, GlassTank::Part::Behind, record, texels);
  if (!hasEdges()) return targets;
  graph.pass("scenery edges", [&](Pass& pass) {
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Kernel kernel = bindNamed(pass, edges_, {{"scene", scene}});
    return [kernel, camera](Commands& commands) { commands.draw(kernel, kEdgeVertices, kEdgeCount, camera); };
  });
  return targets;
}

// Outlines of mouths and drains. `pixels`: as of addOverFluid(), where the pipeline reads them.
void Scenery::addLines(Graph& graph, std::string_view name, SceneTargets& targets, const GraphicsPipeline* pipeline,
                       const SurfacePush& camera, double time_s, BufferRef pixels) const {
  if (buffers_.host.lines.empty()) return;
  struct LinePush {
    SurfacePush view;
    float time;
  };
  const BufferRef lines = buffers_.importLines(graph), keyframes = buffers_.importKeyframes(graph);
  graph.pass(name, [&](Pass& pass) {
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Kernel kernel = bindNamed(pass, pipeline, {{"lines", lines}, {"keyframes", keyframes}, {"surface", pixels}});
    const auto count = static_cast<uint32_t>(buffers_.host.lines.size());
    return [kernel, count, push = LinePush{camera, static_cast<float>(time_s)}](Commands& commands) {
      commands.draw(kernel, kEdgeVertices, count, push);
    };
  });
}

SceneTargets Scenery::addOverFluid(Graph& graph, SceneTargets targets, const FluidView& view, const FluidLook& look, double time_s,
                                   BufferRef pixels, BufferRef texels) const {
  const SurfacePush camera = viewPush(view, buffers_.host.origin);
  if (tank_) tank_->addTo(graph, targets, camera, GlassTank::Part::Front, addLook(graph, lookRecord(look, {}, environment_)), texels);
  if (pixels == BufferRef{}) return targets;
  addLines(graph, "scenery outlines over fluid", targets, linesOverFluid_, camera, time_s, pixels);
  if (!hasEdges()) return targets;
  const BufferRef scene = buffers_.importScene(graph);
  graph.pass("scenery edges over fluid", [&](Pass& pass) {
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Kernel kernel = bindNamed(pass, edgesOverFluid_, {{"scene", scene}, {"surface", pixels}});
    return [kernel, camera](Commands& commands) { commands.draw(kernel, kEdgeVertices, kEdgeCount, camera); };
  });
  return targets;
}

}  // namespace rill
