#include "views/scenery.hpp"

#include "render/fluid_renderer_impl.hpp"
#include "render/view_push.hpp"

namespace rill {
namespace {

using surface::SurfacePush;

constexpr uint32_t kEdgeVertices = 6, kEdgeCount = 12;

}  // namespace

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

SceneTargets Scenery::addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view, const FluidLook& look,
                            double time_s, BufferRef texels) const {
  const bool solids = !buffers_.host.solids.empty();
  SurfacePush camera = viewPush(view, buffers_.host.origin);
  camera.spacing = fluid.spacing;
  const BufferRef scene = buffers_.importScene(graph);
  const SurfacePush light = SurfaceStage::thicknessPush(lightPush(fluid, fluid.origin), fluid, 1);
  const bool lands = solids || hasGround();
  BufferRef thickness;
  if (lands && fluid.capacity > 0)
    thickness = stage_.addThickness(graph, kFluidShadow, fluid, light, {}, nullptr,
                                    SurfaceStage::Of::EachFluid);  // a particle spans five texels at most
  else
    graph.skipped(kFluidShadow.pass, lands ? "there are no particles" : "there is nothing that it falls on");
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
  const BufferRef caustics = addCaustics(graph, fluid, look, thickness, double{light.unit}, lightDepth, record);
  const bool plain = caustics == BufferRef{};
  const Drawing& drawing = plain ? plain_ : refracted_;
  BufferRef shadow;
  if (plain && lands) shadow = stage_.addShadow(graph, light, thickness);
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
