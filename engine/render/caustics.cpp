#include "render/caustics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/shader_pass.hpp"
#include "render/particle_count.hpp"
#include "sort/dispatches.hpp"

namespace rill {
namespace {

using caustics::CausticsRecord, caustics::kCausticFine, caustics::kCausticGroup, caustics::kCausticLevels;

constexpr double kSteepest = 3;        // depth of a horizontal surface per m that its smoothing follows
constexpr double kSurfaceRange = 2.5;  // spacings between neighbors of one surface
constexpr double kMaxFlux = 65535;     // counts of a photon

double product(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Float4 packed(const Double3& v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

uint64_t mapTexels(const SunView& view) { return uint64_t{kCausticFine} * kCausticFine * view.width * view.height; }

/// Counts of a photon, so few that all photons in one texel do not overflow it.
double fluxUnit(const SunView& view) { return std::floor(std::min(kMaxFlux, 4294967295.0 / static_cast<double>(mapTexels(view)))); }

CausticsRecord causticsRecord(const FluidState& fluid, const FluidLook& look, const SunView& view, double thicknessUnit) {
  const Double3 offset{fluid.origin.x - view.origin.x, fluid.origin.y - view.origin.y, fluid.origin.z - view.origin.z};
  const Double3 away{-view.toSun.x, -view.toSun.y, -view.toSun.z};
  CausticsRecord record{};
  record.light[0] = packed(view.u, product(view.u, offset) - view.first_u);
  record.light[1] = packed(view.v, product(view.v, offset) - view.first_v);
  record.light[2] = packed(away, product(away, offset) + view.nearest);
  for (int k = 0; k < 3; ++k)
    record.world[k] = packed({view.u[k], view.v[k], away[k]},
                             view.first_u * view.u[k] + view.first_v * view.v[k] + view.nearest * view.toSun[k] - view.low[k]);
  record.stage = packed({view.high.x - view.low.x, view.high.y - view.low.y, view.high.z - view.low.z}, view.floor ? 1 : 0);
  record.absorption = {look.absorption.x, look.absorption.y, look.absorption.z, look.refractionIndex};
  record.texel = static_cast<float>(view.texel);
  record.depths = static_cast<float>(view.depths);
  record.spacing = fluid.spacing;
  record.thickness = static_cast<float>(thicknessUnit);
  record.flux = static_cast<float>(fluxUnit(view));
  const double height = std::max(view.toSun.y, Caustics::kLowest);
  record.slope = static_cast<float>(std::min(view.v.y / height, kSteepest));
  record.range = static_cast<float>(kSurfaceRange * double{fluid.spacing} / std::max(height, 0.4));
  record.width = view.width;
  record.height = view.height;
  record.particles = fluid.capacity;
  record.closed = view.closed;
  return record;
}

}  // namespace

Expected<Caustics> Caustics::create(Device& device, bool solids, uint32_t fluids) {
  Caustics out;
  out.solids_ = solids;
  const bool texels = usesTexelReads(device);
  ModulePipelines pipelines(device);
  out.particleGroups_ = pipelines.make("render/particle_groups");
  out.depths_ = pipelines.make("render/caustics_depths");
  out.smooth_[0] = pipelines.make("render/caustics_smooth", texels, {{"FLUIDS", fluids}});
  out.smooth_[1] = pipelines.make("render/caustics_smooth_vertical", texels);
  out.slopes_ = pipelines.make("render/caustics_slopes");
  const std::string rays = solids ? "render/caustics_rays_solids" : "render/caustics_rays";
  out.rays_ = pipelines.make(shaderVariant(device, rays, "_several", fluids > 1), texels, {{"FLUIDS", fluids}});
  out.splat_ = pipelines.make(solids ? "render/caustics_splat_solids" : "render/caustics_splat", texels);
  out.resolve_ = pipelines.make(solids ? "render/caustics_resolve_solids" : "render/caustics_resolve", texels);
  out.level_ = pipelines.make("render/caustics_level");
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

std::array<uint32_t, 2> Caustics::levelSize(const SunView& view, uint32_t level) {
  const uint32_t round = (1u << level) - 1;
  return {(kCausticFine * view.width + round) >> level, (kCausticFine * view.height + round) >> level};
}

uint64_t Caustics::mapBytes(const SunView& view, bool solids) {
  uint64_t texels = 0;
  for (uint32_t level = 0; level < kCausticLevels; ++level) {
    const auto [width, height] = levelSize(view, level);
    texels += uint64_t{width} * height;
  }
  return texels * (solids ? 2 : 1) * 8;
}

Caustics::Frame Caustics::addTo(Graph& graph, const FluidState& fluid, const FluidLook& look, const SunView& view, BufferRef thickness,
                                double thicknessUnit, ImageRef solidDepths, BufferRef bodies) const {
  assert(fluid.capacity > 0);
  const CausticsRecord record = causticsRecord(fluid, look, view, thicknessUnit);
  const uint64_t texels = uint64_t{view.width} * view.height, photons = mapTexels(view), layers = solids_ ? 2 : 1;
  BufferRef sun = graph.create("caustics frame", {sizeof record});
  graph.pass("caustics frame", [&](Pass& pass) {
    sun = pass.write(sun, Use::CopyTarget, true);
    return [sun, record](Commands& commands) { commands.update(sun, std::as_bytes(std::span(&record, 1))); };
  });
  Frame out;
  out.unit = double{record.flux};
  out.solids = solids_;
  BufferRef first = graph.create("caustics first depth", {texels * 4}), last = graph.create("caustics last depth", {texels * 4});
  BufferRef rows = graph.create("caustics rows", {texels * 16}), front = graph.create("caustics front", {texels * 16}),
            back = graph.create("caustics back", {texels * 16});
  out.surfaces = graph.create("caustics surfaces", {texels * 16});
  out.landings = graph.create("caustics landings", {photons * 16});
  const auto [fineWidth, fineHeight] = levelSize(view, 0);
  const uint64_t coarse = divideUp(fineWidth, caustics::kCausticCoarse) * divideUp(fineHeight, caustics::kCausticCoarse);
  out.sums = graph.create("caustics sums", {(photons + coarse) * layers * 12});
  out.map = graph.create("caustics map", {mapBytes(view, solids_)});
  addFill(graph, "caustics clear", {{&first, 0xFFFFFFFFu}, {&last, 0}, {&out.sums, 0}});
  const CountedParticles particles = countParticles(graph, fluid, particleGroups_, kCausticGroup);
  const auto add = [&](std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size) {
    addDispatch(graph, name, pipeline, size, NoPush{},
                {{"sun", std::as_const(sun)},
                 {"position", fluid.position},
                 {"particle_count", particles.count},
                 {"thickness", std::as_const(thickness)},
                 {"light_depth", std::as_const(solidDepths)},
                 {"look", std::as_const(bodies)},
                 {"first", first},
                 {"last", last},
                 {"rows", rows},
                 {"smoothed", out.surfaces},
                 {"front", front},
                 {"back", back},
                 {"landings", out.landings},
                 {"sums", out.sums},
                 {"caustics", out.map}});
  };
  add("caustics depths", depths_, particles.groups);
  for (const ComputePipeline* pipeline : smooth_) add("caustics smooth", pipeline, divideUp(texels, kCausticGroup));
  add("caustics slopes", slopes_, divideUp(texels, kCausticGroup));
  add("caustics rays", rays_, divideUp(photons, kCausticGroup));
  add("caustics splat", splat_, divideUp(photons, kCausticGroup));
  add("caustics resolve", resolve_, divideUp(photons, kCausticGroup));
  struct Level {
    uint32_t from, fromWidth, fromHeight, to, toWidth, toHeight, solids;
  };
  uint32_t start = 0;
  for (uint32_t level = 1; level < kCausticLevels; ++level) {
    const auto finer = levelSize(view, level - 1), own = levelSize(view, level);
    const uint32_t finerTexels = finer[0] * finer[1], ownTexels = own[0] * own[1],
                   next = start + static_cast<uint32_t>(layers) * finerTexels;
    for (uint32_t layer = 0; layer < layers; ++layer)
      addDispatch(graph, "caustics level", level_, divideUp(ownTexels, kCausticGroup),
                  Level{start + layer * finerTexels, finer[0], finer[1], next + layer * ownTexels, own[0], own[1], layer},
                  {{"caustics", out.map}});
    start = next;
  }
  return out;
}

}  // namespace rill
