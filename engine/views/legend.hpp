#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "views/color_map.hpp"

namespace rill {

/// Content of a picture's legend.
struct LegendDesc {
  ParticleColor color = ParticleColor::Speed;
  double max = 1;                ///< the value at the map's end: m/s, or density over rest density - 1
  std::optional<double> time_s;  ///< caption "t = 0.50 s"; none: no caption
};

/// Draws a color bar with ticks, a title and the time into the bottom left corner of a picture: width x height RGBA8 sRGB pixels, rows
/// from the top. Its size follows the picture's height; too small a picture gets none.
void drawLegend(std::span<uint8_t> rgba, uint32_t width, uint32_t height, const LegendDesc& legend);

}  // namespace rill
