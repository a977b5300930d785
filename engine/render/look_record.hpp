#pragma once
// The appearance of a fluid as the shaders read it.
#include "render/environment.hpp"
#include "render/look_records.h"
#include "render/surface_records.h"
#include "rill/fluid_renderer.hpp"

namespace rill {

/// `thickness`: of the buffer that absorption reads. `environment` may be null.
look::LookRecord lookRecord(const FluidLook& look, const surface::SurfacePush& thickness, const Environment* environment);
/// A uniform buffer with the record, written by a pass of its own.
BufferRef addLook(Graph& graph, const look::LookRecord& record);

}  // namespace rill
