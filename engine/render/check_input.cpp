#include "render/check_input.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/words.hpp"
#include "graph/graph_impl.hpp"
#include "render/surface.hpp"
#include "render/view_push.hpp"

namespace rill {
namespace {

constexpr uint32_t kMaxSide = 8192;
constexpr uint64_t kMaxPixels = uint64_t{1} << 24;  // of eight bytes: 128 MiB, which a buffer has on every device

Error badInput(std::string message) { return {ErrorKind::BadInput, std::move(message)}; }
Error invalidValue(const char* type, unsigned value) {
  return badInput("invalid " + std::string(type) + " value " + std::to_string(value));
}
Error outOfRange(const char* field, double value, const char* expected) {
  return badInput(std::string(field) + " is " + shortestNumber(value) + "; expected " + expected);
}
std::string sizeText(uint64_t width, uint64_t height) { return std::to_string(width) + "x" + std::to_string(height); }

Expected<void> checkRigid(const Float4x4& view) {
  for (int r = 0; r < 3; ++r) {
    double square = 0, dot = 0;
    for (int c = 0; c < 3; ++c) {
      square += element(view, r, c) * element(view, r, c);
      dot += element(view, r, c) * element(view, (r + 1) % 3, c);
    }
    if (std::abs(square - 1) > 1e-3 || std::abs(dot) > 1e-3)
      return badInput("FluidView::view is not rigid; expected a rotation and a translation, without scale or shear");
  }
  return {};
}

Expected<void> checkProjection(const Float4x4& p) {
  for (const auto& [row, column] : {std::pair{0, 1}, std::pair{1, 0}, std::pair{2, 0}, std::pair{2, 1}, std::pair{3, 0}, std::pair{3, 1}})
    if (element(p, row, column) != 0) return badInput("FluidView::projection shears; expected one that is centered or shifted");
  const double w = element(p, 3, 2), constant = element(p, 3, 3);
  const bool perspective = w != 0 && constant == 0, orthographic = w == 0 && constant != 0;
  if (!(perspective || orthographic) || element(p, 0, 0) == 0 || element(p, 1, 1) == 0)
    return badInput("FluidView::projection is neither perspective nor orthographic");
  if (perspective ? element(p, 2, 3) == 0 : element(p, 2, 2) == 0)
    return badInput("FluidView::projection gives every point the same depth");
  return {};
}

}  // namespace

Expected<void> checkFormats(const TargetFormats& formats) {
  if (formats.color == VK_FORMAT_UNDEFINED || hasDepth(formats.color))
    return badInput("TargetFormats::color is " + std::to_string(formats.color) + "; expected a VkFormat of colors");
  if (!hasDepth(formats.depth))
    return badInput("TargetFormats::depth is " + std::to_string(formats.depth) + "; expected a VkFormat that holds depth");
  return {};
}

Expected<void> checkViewport(uint32_t width, uint32_t height) {
  constexpr uint64_t kBorder = 2 * surface::kMarginSamples;
  const std::string found = "a picture of " + sizeText(width, height) + " pixels: ";
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide)
    return badInput(found + "width and height must be 1 to " + std::to_string(kMaxSide));
  if ((width + kBorder) * (height + kBorder) > kMaxPixels)
    return badInput(found + "with a border of " + std::to_string(kBorder / 2) + " on each side, expected at most " +
                    std::to_string(kMaxPixels));
  return {};
}

Expected<void> checkView(const FluidView& view) {
  if (auto ok = checkViewport(view.width, view.height); !ok) return ok;
  for (const auto& [name, matrix] : {std::pair{"view", &view.view}, std::pair{"projection", &view.projection}})
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        if (!std::isfinite(element(*matrix, r, c)))
          return badInput("FluidView::" + std::string(name) + " has an element that is not finite");
  if (auto ok = checkRigid(view.view); !ok) return ok;
  if (!(view.focus_m > 0) || !std::isfinite(view.focus_m)) return outOfRange("FluidView::focus_m", view.focus_m, "a distance above 0 (m)");
  return checkProjection(view.projection);
}

Expected<void> checkMethod(SurfaceMethod method) {
  if (size_t(method) > size_t(SurfaceMethod::NarrowRange)) return invalidValue("SurfaceMethod", unsigned(method));
  return {};
}

Expected<void> checkData(SurfaceData data) {
  if (size_t(data) > size_t(SurfaceData::Thickness)) return invalidValue("SurfaceData", unsigned(data));
  return {};
}

Expected<void> checkLook(const FluidLook& look) {
  if (!(look.refractionIndex >= 1 && look.refractionIndex <= 10))
    return outOfRange("FluidLook::refractionIndex", double{look.refractionIndex}, "1 to 10");
  for (const float coefficient : {look.scattering.x, look.scattering.y, look.scattering.z})
    if (!(coefficient >= 0 && coefficient <= 1e6f)) return outOfRange("FluidLook::scattering", double{coefficient}, "0 to 1e6 (1/m)");
  if (!(std::abs(look.meanCosine) <= 0.99f)) return outOfRange("FluidLook::meanCosine", double{look.meanCosine}, "-0.99 to 0.99");
  if (!(look.aeration >= 0 && look.aeration <= 1)) return outOfRange("FluidLook::aeration", double{look.aeration}, "0 to 1");
  return {};
}

Expected<void> checkBodies(std::span<const FluidBody> fluids) {
  if (fluids.size() > kMaxFluids)
    return badInput("found " + std::to_string(fluids.size()) + " fluids; expected at most " + std::to_string(kMaxFluids));
  if (const auto diffusing = std::ranges::count(fluids, true, &FluidBody::diffuses); diffusing > std::ptrdiff_t{kMaxDiffusing})
    return badInput("found " + std::to_string(diffusing) + " fluids that diffuse; expected at most " + std::to_string(kMaxDiffusing));
  for (const FluidBody& body : fluids) {
    if (!body.absorption) continue;
    for (const float rate : {body.absorption->x, body.absorption->y, body.absorption->z})
      if (!(rate >= 0 && rate <= 1e6f)) return outOfRange("FluidBody::absorption", double{rate}, "0 to 1e6 (1/m)");
    for (const float share : {body.scatter.x, body.scatter.y, body.scatter.z})
      if (!(share >= 0 && share <= 1)) return outOfRange("FluidBody::scatter", double{share}, "0 to 1");
  }
  return {};
}

Expected<void> checkFluid(Graph& graph, const FluidState& fluid) {
  if (fluid.capacity == 0) return {};
  if (fluid.capacity > SurfaceStage::kMaxParticles)
    return badInput("FluidState::capacity is " + std::to_string(fluid.capacity) + "; expected at most " +
                    std::to_string(SurfaceStage::kMaxParticles));
  if (!(fluid.spacing > 0 && std::isfinite(fluid.spacing)))
    return outOfRange("FluidState::spacing", double{fluid.spacing}, "a length above 0 (m)");
  for (const double v : fluid.origin)
    if (!std::isfinite(v)) return outOfRange("FluidState::origin", v, "finite numbers (m)");
  const auto& resources = implOf(graph).resources;
  const BufferRef position = fluid.position;
  if (position.index >= resources.size() || resources[position.index].isImage) return {};
  if (const uint64_t bytes = resources[position.index].size; bytes < uint64_t{fluid.capacity} * 16)
    return badInput("FluidState::position has " + std::to_string(bytes) + " bytes; expected 16 for each of its " +
                    std::to_string(fluid.capacity) + " particles");
  return {};
}

Expected<void> checkTargets(Graph& graph, const SceneTargets& targets, const FluidView& view) {
  const auto& resources = implOf(graph).resources;
  for (const ImageRef target : {targets.color, targets.depth}) {
    if (target.index >= resources.size() || !resources[target.index].isImage) continue;  // the pass that reads it reports that
    const ResourceData& image = resources[target.index];
    if (uint64_t{view.x} + view.width <= image.width() && uint64_t{view.y} + view.height <= image.height()) continue;
    return badInput("the fluid's viewport of " + sizeText(view.width, view.height) + " pixels at " + std::to_string(view.x) + ", " +
                    std::to_string(view.y) + " does not lie within a target of " + sizeText(image.width(), image.height()));
  }
  return {};
}

}  // namespace rill
