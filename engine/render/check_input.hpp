#pragma once
// What FluidRenderer accepts from a host. Each check fails with BadInput that names the value, what was found and what is expected.
#include "rill/expected.hpp"
#include "rill/fluid_renderer.hpp"

namespace rill {

Expected<void> checkFormats(const TargetFormats& formats);
Expected<void> checkViewport(uint32_t width, uint32_t height);
Expected<void> checkView(const FluidView& view);
Expected<void> checkMethod(SurfaceMethod method);
Expected<void> checkData(SurfaceData data);
Expected<void> checkBodies(std::span<const FluidBody> fluids);
Expected<void> checkLook(const FluidLook& look);
/// `graph` has the size of the positions. A ref of another graph is left to the pass that reads it.
Expected<void> checkFluid(Graph& graph, const FluidState& fluid);
/// The viewport lies within the targets.
Expected<void> checkTargets(Graph& graph, const SceneTargets& targets, const FluidView& view);

}  // namespace rill
