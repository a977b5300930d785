// Pipelines and buffers of the scenery.
#include <algorithm>
#include <string>

#include "gpu/shader_constants.hpp"
#include "gpu/texel_reads.hpp"
#include "render/fluid_renderer_impl.hpp"
#include "views/scenery.hpp"

namespace rill {
namespace {

constexpr Double3 kBehindTank = {-0.5, 0.9, -0.65};  // the studio's light: light through the fluid falls on the table before the tank

/// The table that a tank stands on above the sea of a clear sky.
void addTable(particle_view::SceneRecord& scene) {
  const float size = std::max(scene.domain_max.x - scene.domain_min.x, scene.domain_max.z - scene.domain_min.z);
  scene.table = {0.15f * size, 0.05f * size, 0, 0};
}

}  // namespace

Expected<std::unique_ptr<Scenery>> Scenery::create(Device& device, const Scene& scene, const ParticleSet& particles,
                                                   const TargetFormats& formats, const Environment* environment) {
  auto out = std::make_unique<Scenery>();
  out->environment_ = environment;
  std::optional<Double3> toSun;
  if (environment && environment->sun()) {
    const Float3& to = environment->sun()->direction;
    toSun = {to.x, to.y, to.z};
  }
  const bool tank = scene.look.stage == "tank" && scene.domain;
  if (tank) {
    auto glass = GlassTank::create(device, *scene.domain, particles.origin, formats, environment != nullptr);
    if (!glass) return glass.error();
    out->tank_ = *std::move(glass);
  }
  if (tank && !environment) toSun = kBehindTank;
  ParticleScene host = particleScene(scene, particles, toSun);
  if (tank) {
    host.scene.domain_max.w = 0;
    if (environment && scene.look.sky != "studio" && scene.look.environment.empty()) addTable(host.scene);
  }
  auto buffers = SceneBuffers::create(device, std::move(host));
  if (!buffers) return buffers.error();
  out->buffers_ = *std::move(buffers);
  auto stage = SurfaceStage::create(device);
  if (!stage) return stage.error();
  out->stage_ = *stage;
  if (std::vector<FluidBody> bodies = fluidBodies(scene); bodies.size() > 1) {
    if (auto set = out->stage_.setFluids(device, bodies); !set) return set.error();
    out->fluids_ = std::move(bodies);
  }
  auto meshes = SceneMeshes::create(device, scene);
  if (!meshes) return meshes.error();
  out->meshes_ = *std::move(meshes);
  out->hasRayCast_ = std::ranges::any_of(out->buffers_.host.solids, [](const auto& s) { return s.shape.kind != kShapeMesh; });
  const bool solids = !out->buffers_.host.solids.empty();
  if (scene.look.caustics && (solids || out->hasGround())) {
    auto caustics = Caustics::create(device, solids, out->fluidCount());
    if (!caustics) return caustics.error();
    out->caustics_ = *caustics;
  }
  if (auto made = out->makePipelines(device, formats); !made) return made.error();
  return out;
}

Expected<void> Scenery::makePipelines(Device& device, const TargetFormats& formats) {
  const bool solids = !buffers_.host.solids.empty();
  const uint32_t fluids = fluidCount();
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
  const std::string around = hasGround() ? (solids ? "ground_solids" : "ground") : "sky", sky = environment_ ? "_environment" : "";
  GraphicsPipelineDesc edges = desc("views/scenery_edges_vertex", "views/scenery_edges_fragment");
  edges.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  edges.depthWrite = false;
  edges.blend = Blend::Premultiplied;
  GraphicsPipelineDesc over = edges;
  over.fragment = "views/scenery_edges_over_fluid_fragment";
  std::vector<Wanted> all{{edges_, edges}, {edgesOverFluid_, over}};
  if (!buffers_.host.lines.empty()) {
    GraphicsPipelineDesc lines = edges, linesOver = over;
    lines.vertex = linesOver.vertex = "views/scenery_lines_vertex";
    linesOver.fragment = "views/scenery_lines_over_fluid_fragment";
    all.push_back({lines_, lines});
    all.push_back({linesOverFluid_, linesOver});
  }
  GraphicsPipelineDesc light = desc("views/scenery_solid_light_vertex", "views/scenery_solid_light_fragment");
  light.colors = {};
  light.depth = kShadowFormat;
  light.depthCompare = VK_COMPARE_OP_LESS;
  if (hasRayCast_) all.push_back({solidLight_, light});
  if (hasMeshes()) {
    light.vertex = "views/scenery_mesh_light_vertex";
    light.fragment = {};
    all.push_back({meshLight_, light});
  }
  std::string shaderNames[2][3];
  for (const bool refracted : {false, true}) {
    if (refracted && !caustics_) continue;
    const std::string suffix = sky + (refracted ? "_caustics" : "") + "_fragment";
    auto& [groundShader, solidShader, meshShader] = shaderNames[refracted];
    Drawing& drawing = refracted ? refracted_ : plain_;
    groundShader = texelVariant(device, "views/scenery_" + around + (hasGround() ? suffix : sky + "_fragment"), usesTexelReads(device));
    solidShader = "views/scenery_solid" + suffix;
    meshShader = "views/scenery_mesh" + suffix;
    const auto inShadow = [&](const GraphicsPipeline*& pipeline, std::string_view vertex, std::string_view fragment, VkCompareOp compare) {
      GraphicsPipelineDesc made = desc(vertex, fragment);
      made.depthCompare = compare;
      if (fluids > 1) made.constants = {&fluids, 1};
      all.push_back({pipeline, made});
    };
    inShadow(drawing.ground, "views/scenery_ground_vertex", groundShader, VK_COMPARE_OP_ALWAYS);
    if (hasRayCast_) inShadow(drawing.solid, "views/scenery_solid_vertex", solidShader, VK_COMPARE_OP_GREATER);
    if (hasMeshes()) inShadow(drawing.mesh, "views/scenery_mesh_vertex", meshShader, VK_COMPARE_OP_GREATER);
  }
  for (const Wanted& wanted : all) {
    auto made = graphicsPipeline(device, wanted.desc);
    if (!made) return made.error();
    wanted.pipeline = *made;
  }
  return {};
}

}  // namespace rill
