#pragma once
// The appearance of a fluid as the shaders read it.
#include "render/environment.hpp"
#include "render/look_records.h"
#include "render/surface_records.h"
#include "rill/fluid_renderer.hpp"

namespace rill {

/// The look of a scene whose only fluid has this body.
FluidLook withBody(FluidLook look, const FluidBody& body);
/// `thickness`: of the buffer that absorption reads. `environment` may be null. `fluids`: as FluidRenderer::setFluids().
look::LookRecord lookRecord(const FluidLook& look, const surface::SurfacePush& thickness, const Environment* environment,
                            std::span<const FluidBody> fluids = {});
/// A uniform buffer with the record, written by a pass of its own.
BufferRef addLook(Graph& graph, const look::LookRecord& record);

}  // namespace rill
