#pragma once
#include <array>

#include "render/surface_records.h"
#include "rill/graph.hpp"
#include "sort/dispatches.hpp"

namespace rill {

/// What a surface is handed on as. Only pixels of the listed tiles are written, unless it was asked for as a whole.
struct SurfaceBuffers {
  BufferRef pixels;     ///< two words a pixel, as unpackPixel() reads them
  BufferRef tiles;      ///< numbers of the tiles that hold fluid, in any order
  BufferRef samples;    ///< two words a sample, depth and normal: packNormal(); infinite where there is no fluid
  BufferRef blocks;     ///< numbers of the blocks of samples that hold fluid, in any order
  BufferRef counters;   ///< kSurvivorCount ...
  BufferRef arguments;  ///< kSurfaceTileArguments, kTileDraw, kPixelArguments
  surface::SurfacePush push;
};

/// A pixel of SurfaceBuffers::pixels, as shaders/render/surface.glsl packs it.
struct SurfacePixel {
  float depth = 0;               ///< m; infinite: no fluid, or less than half a pixel of it
  std::array<double, 3> normal;  ///< unit vector in view space
};
SurfacePixel unpackPixel(const uint32_t* words);

/// Cells of `side` x `side` that cover a grid of `width` x `height`.
inline uint64_t gridCells(uint64_t width, uint64_t height, uint64_t side) { return divideUp(width, side) * divideUp(height, side); }

/// Samples a row and rows of them, of the picture with its margin: sampleGrid() of the shaders.
inline uint64_t sampleColumns(const surface::SurfacePush& push) { return divideUp(push.width, push.step) + 2 * uint64_t{push.margin}; }
inline uint64_t sampleRows(const surface::SurfacePush& push) { return divideUp(push.height, push.step) + 2 * uint64_t{push.margin}; }
inline uint64_t sampleCount(const surface::SurfacePush& push) { return sampleColumns(push) * sampleRows(push); }

}  // namespace rill
