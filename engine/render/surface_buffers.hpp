#pragma once
#include <array>

#include "render/particle_count.hpp"
#include "render/surface_records.h"
#include "rill/graph.hpp"
#include "rill/vectors.hpp"
#include "sort/dispatches.hpp"

namespace rill {

/// The result of SurfaceStage. Only pixels of listed tiles are written, unless `whole` was set.
struct SurfaceBuffers {
  BufferRef pixels;            ///< two words per pixel, see unpackPixel()
  BufferRef tiles;             ///< indices of tiles with fluid, in any order
  BufferRef samples;           ///< two words per sample: depth (kNoDepthBits: no fluid) and packNormal()
  BufferRef blocks;            ///< indices of blocks of samples with fluid, in any order
  BufferRef counters;          ///< kSurvivorCount ...
  BufferRef arguments;         ///< kSurfaceTileArguments, kTileDraw, kPixelArguments
  CountedParticles particles;  ///< of the state
  surface::SurfacePush push;
};

/// A pixel of SurfaceBuffers::pixels, as shaders/render/surface.glsl packs it.
struct SurfacePixel {
  float depth = 0;  ///< m; infinite: no fluid, or a coverage below 0.5
  Double3 normal;   ///< unit vector in view space
};
SurfacePixel unpackPixel(const uint32_t* words);

/// Cells of `side` x `side` that cover a grid of `width` x `height`.
inline uint64_t gridCells(uint64_t width, uint64_t height, uint64_t side) { return divideUp(width, side) * divideUp(height, side); }

/// The grid of samples, including the margin: sampleGrid() of the shaders.
inline uint64_t sampleColumns(const surface::SurfacePush& push) { return divideUp(push.width, push.step) + 2 * uint64_t{push.margin}; }
inline uint64_t sampleRows(const surface::SurfacePush& push) { return divideUp(push.height, push.step) + 2 * uint64_t{push.margin}; }
inline uint64_t sampleCount(const surface::SurfacePush& push) { return sampleColumns(push) * sampleRows(push); }

}  // namespace rill
