#include "views/scene_buffers.hpp"

#include <algorithm>
#include <cstring>

#include "gpu/device_impl.hpp"
#include "gpu/module_pipelines.hpp"
#include "graph/shader_pass.hpp"
#include "sort/dispatches.hpp"

namespace rill {

std::span<const EmbeddedShader> viewsShaders();  // generated

namespace {

using particle_view::kParticleGroup, particle_view::PlacedSolid, particle_view::SceneRecord, particle_view::ViewPush;

/// A host-written buffer with the bytes of `data`; at least one element, so that it can be bound.
template <class T>
Expected<Buffer> upload(Device& device, std::string_view name, std::span<const T> data) {
  Expected<Buffer> buffer = createBuffer(device, name, std::max<uint64_t>(data.size_bytes(), sizeof(T)), MemoryKind::Upload);
  if (!buffer) return buffer;
  std::memset(buffer->mapped(), 0, buffer->size());
  if (!data.empty()) std::memcpy(buffer->mapped(), data.data(), data.size_bytes());
  return buffer;
}

}  // namespace

void bringViewShaders(Device& device) { implOf(device).shaders.add(viewsShaders()); }

Expected<SceneBuffers> SceneBuffers::create(Device& device, ParticleScene host) {
  bringViewShaders(device);
  SceneBuffers out;
  out.host = std::move(host);
  const auto keep = [](Buffer& target, Expected<Buffer> made) -> Expected<void> {
    if (!made) return made.error();
    target = *std::move(made);
    return {};
  };
  if (auto ok = keep(out.scene, upload<SceneRecord>(device, "view: scene", {&out.host.scene, 1})); !ok) return ok.error();
  if (auto ok = keep(out.solids, upload<particle_view::SceneSolid>(device, "view: solids", out.host.solids)); !ok) return ok.error();
  if (auto ok = keep(out.keyframes, upload<KeyframeRecord>(device, "view: keyframes", out.host.keyframes)); !ok) return ok.error();
  if (auto ok = keep(out.lines, upload<particle_view::LineRecord>(device, "view: lines", out.host.lines)); !ok) return ok.error();
  ModulePipelines pipelines(device);
  out.poses = pipelines.make("views/particle_poses");
  out.drivenPoses = pipelines.make("views/particle_driven_poses");
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

BufferRef SceneBuffers::importScene(Graph& graph) const {
  return graph.import("view scene", {scene.handle(), 0, scene.size(), Use::Nothing, Use::Nothing});
}

BufferRef SceneBuffers::importLines(Graph& graph) const {
  return graph.import("view lines", {lines.handle(), 0, lines.size(), Use::Nothing, Use::Nothing});
}

BufferRef SceneBuffers::importKeyframes(Graph& graph) const {
  return graph.import("view keyframes", {keyframes.handle(), 0, keyframes.size(), Use::Nothing, Use::Nothing});
}

BufferRef SceneBuffers::addPoses(Graph& graph, const FluidState& fluid, BufferRef sceneRef, const ViewPush& push) const {
  const BufferRef solidRecords = graph.import("view solids", {solids.handle(), 0, solids.size(), Use::Nothing, Use::Nothing});
  const BufferRef keys = importKeyframes(graph);
  BufferRef out = graph.create("view poses", {host.solids.size() * sizeof(PlacedSolid)});
  const bool driven = fluid.solids != BufferRef{};
  addDispatch(graph, "view poses", driven ? drivenPoses : poses, divideUp(host.solids.size(), kParticleGroup), push,
              {{"scene", sceneRef}, {"solids", solidRecords}, {"keyframes", keys}, {"placed", out}, {"fluidSolids", fluid.solids}});
  return out;
}

}  // namespace rill
