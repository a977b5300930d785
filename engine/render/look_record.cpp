#include "render/look_record.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace rill {
namespace {

constexpr Float3 kToSun{-0.30f, 0.84f, 0.45f};

}  // namespace

static_assert(look::kMaxLookFluids == kMaxFluids);

FluidLook withBody(FluidLook look, const FluidBody& body) {
  if (!body.absorption) return look;
  look.absorption = *body.absorption;
  look.scatter = body.scatter;
  look.scattering = look.emission = {0, 0, 0};
  return look;
}

look::LookRecord lookRecord(const FluidLook& given, const surface::SurfacePush& thickness, const Environment* environment,
                            std::span<const FluidBody> fluids) {
  const FluidLook look = fluids.size() == 1 ? withBody(given, fluids.front()) : given;
  look::LookRecord record{};
  record.absorption = {look.absorption.x, look.absorption.y, look.absorption.z, look.refractionIndex};
  record.scatter = {look.scatter.x, look.scatter.y, look.scatter.z, look.opaque ? 1.0f : 0.0f};
  record.emission = {look.emission.x, look.emission.y, look.emission.z, 0};
  record.scattering = {look.scattering.x, look.scattering.y, look.scattering.z, look.meanCosine};
  for (size_t k = 0; k < std::min(fluids.size(), kMaxFluids); ++k) {
    const FluidLook own = withBody(look, fluids[k]);
    record.fluid_absorption[k] = {own.absorption.x, own.absorption.y, own.absorption.z, fluids[k].absorption ? 0.0f : 1.0f};
    record.fluid_scatter[k] = {own.scatter.x, own.scatter.y, own.scatter.z, 0};
  }
  const EnvironmentSun* sun = environment && environment->sun() ? &*environment->sun() : nullptr;
  const Float3 s = look.toSun.value_or(sun ? sun->direction : kToSun);
  const float size = std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
  record.light = size > 0 ? Float4{s.x / size, s.y / size, s.z / size, look.sun} : Float4{0, 1, 0, look.sun};
  record.finish = {look.highlight, static_cast<float>(thickness.step), thickness.unit, look.aeration};
  if (environment) {
    const Float3 above = environment->above(), below = environment->below();
    record.above = {above.x, above.y, above.z, static_cast<float>(environment->width())};
    record.below = {below.x, below.y, below.z, static_cast<float>(environment->height())};
    // Without a sun, as much light as comes from the sky gives fluid and solids their shape.
    const Float3 light = sun ? sun->light : above;
    record.sunlight = {light.x, light.y, light.z, sun ? sun->radius : 0};
  }
  return record;
}

BufferRef addLook(Graph& graph, const look::LookRecord& record) {
  BufferRef buffer = graph.create("fluid look", {sizeof record});
  graph.pass("fluid look", [&](Pass& pass) {
    buffer = pass.write(buffer, Use::CopyTarget, true);
    return [buffer, record](Commands& commands) { commands.update(buffer, std::as_bytes(std::span(&record, 1))); };
  });
  return buffer;
}

}  // namespace rill
