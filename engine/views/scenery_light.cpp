// Light on the scenery: the sun's map, shadows of solids, caustics.
#include <algorithm>

#include "views/scenery.hpp"

namespace rill {
namespace {

using surface::SurfacePush;

VkClearValue depthClear(float depth) {
  VkClearValue value{};
  value.depthStencil = {depth, 0};
  return value;
}

}  // namespace

Float3 Scenery::toSun() const {
  const Float4& to = buffers_.host.scene.light_to;
  return {to.x, to.y, to.z};
}

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

/// The map of caustics; empty where there are none.
BufferRef Scenery::addCaustics(Graph& graph, const FluidState& fluid, const FluidLook& look, BufferRef thickness, double unit,
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
  return caustics_->addTo(graph, fluid, look, view, thickness, unit, lightDepth, record).map;
}

}  // namespace rill
