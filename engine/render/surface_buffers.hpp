#pragma once
#include "render/surface_records.h"
#include "rill/graph.hpp"

namespace rill {

/// What a surface is handed on as. Only pixels of the listed tiles are written, unless it was asked for as a whole.
struct SurfaceBuffers {
  BufferRef pixels;          ///< two words a pixel, as unpackPixel() reads them
  BufferRef tiles;           ///< numbers of the tiles that hold fluid, in any order
  BufferRef samples;         ///< two words a sample, depth and normal: packNormal(); infinite where there is no fluid
  BufferRef blocks;          ///< numbers of the blocks of samples that hold fluid, in any order
  BufferRef counters;        ///< kSurvivorCount ...
  BufferRef arguments;       ///< kSurfaceTileArguments, kTileDraw, kPixelArguments
  uint64_t sampleCount = 0;  ///< of the picture with its margin
  surface::SurfacePush push;
};

}  // namespace rill
