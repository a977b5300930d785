#pragma once
#include <algorithm>
#include <cstdint>

namespace rill::view {

/// A rectangle in the window, in pixels from the top left.
struct Area {
  uint32_t x = 0, y = 0, width = 0, height = 0;
  bool contains(double px, double py) const { return px >= x && py >= y && px < x + double(width) && py < y + double(height); }
  friend bool operator==(const Area&, const Area&) = default;
};

/// A place in the window, in pixels from the top left.
struct Place {
  double x = 0, y = 0;
};

/// The layout of the window: a column of panels at each side, a status line at the bottom, and the image between them.
/// Nothing overlaps.
struct Layout {
  Area left, right, status, picture;
};

/// `scale`: of text and buttons. Without panels the image fills the window.
inline Layout layOut(uint32_t width, uint32_t height, float scale, bool panels) {
  if (!panels) return {.picture = {0, 0, width, height}};
  const auto pixels = [&](double at1) { return static_cast<uint32_t>(at1 * scale); };
  // Columns take at most a third of the width, the status line at most a quarter of the height.
  const uint32_t left = std::min(pixels(286), width / 3), right = std::min(pixels(296), width / 3);
  const uint32_t line = std::min(pixels(26), height / 4), tall = height - line;
  return {{0, 0, left, tall}, {width - right, 0, right, tall}, {0, tall, width, line}, {left, 0, width - left - right, tall}};
}

}  // namespace rill::view
