#pragma once
// A camera as the shaders read it.
#include "render/surface_records.h"
#include "rill/expected.hpp"
#include "rill/fluid_renderer.hpp"

namespace rill {

/// For positions that are stored relative to `origin`. `view` is one that FluidRenderer::check() allows.
surface::SurfacePush viewPush(const FluidView& view, const double origin[3]);

/// The size alone.
Expected<void> checkViewport(uint32_t width, uint32_t height);
Expected<void> checkView(const FluidView& view);

}  // namespace rill
