#include "views/legend.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace rill {
namespace {

struct Canvas {
  std::span<uint8_t> rgba;
  int width, height;

  /// Blends a rectangle, clipped to the picture.
  void fill(int x0, int y0, int x1, int y1, const uint8_t color[3], double alpha) {
    for (int y = std::max(y0, 0); y < std::min(y1, height); ++y) {
      for (int x = std::max(x0, 0); x < std::min(x1, width); ++x) {
        uint8_t* pixel = &rgba[4 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x))];
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<uint8_t>(std::lround(pixel[c] + alpha * (color[c] - pixel[c])));
      }
    }
  }

  void text(int x, int y, int scale, const std::string& words, const uint8_t color[3]) {
    struct Vertex {
      float x, y, z;
      uint8_t color[4];
    };
    std::vector<Vertex> vertices(words.size() * 24 + 64);
    std::string copy = words;
    const int quads = stb_easy_font_print(0, 0, copy.data(), nullptr, vertices.data(), static_cast<int>(vertices.size() * sizeof(Vertex)));
    for (int q = 0; q < quads; ++q) {
      const Vertex &a = vertices[static_cast<size_t>(4 * q)], &b = vertices[static_cast<size_t>(4 * q + 2)];
      fill(x + static_cast<int>(a.x) * scale, y + static_cast<int>(a.y) * scale, x + static_cast<int>(b.x) * scale,
           y + static_cast<int>(b.y) * scale, color, 1);
    }
  }
};

int textWidth(const std::string& words, int scale) {
  std::string copy = words;
  return stb_easy_font_width(copy.data()) * scale;
}

/// The largest of 1, 2, 2.5, 5 times a power of ten with at most four steps in `range`.
double tickStep(double range) {
  const double base = std::pow(10.0, std::floor(std::log10(range / 4)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0, 10.0}) {
    if (range / (factor * base) < 4.0001) return factor * base;
  }
  return 10 * base;
}

std::string number(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", value);
  return digits;
}

constexpr uint8_t kInk[3] = {32, 36, 42}, kPaper[3] = {250, 250, 250};

}  // namespace

void drawLegend(std::span<uint8_t> rgba, uint32_t width, uint32_t height, const LegendDesc& legend) {
  assert(rgba.size() >= size_t{4} * width * height);
  Canvas canvas{rgba, static_cast<int>(width), static_cast<int>(height)};
  const int scale = std::max(1, static_cast<int>(std::lround(height / 400.0)));
  const int line = 8 * scale, pad = 6 * scale, margin = 8 * scale, thick = 7 * scale;
  const bool compression = legend.color == ParticleColor::Compression;
  const std::string title = compression ? "compression  %" : "speed  m/s";
  char caption[48] = "";
  if (legend.time_s) std::snprintf(caption, sizeof caption, "t = %.2f s", *legend.time_s);
  const int words = textWidth(title, scale) + (legend.time_s ? textWidth(caption, scale) + 14 * scale : 0);
  const int bar = std::min(std::max(static_cast<int>(0.28 * height) + 40 * scale, words), canvas.width - 2 * (margin + pad) - 12 * scale);
  const double range = legend.max > 0 && std::isfinite(legend.max) ? legend.max * (compression ? 100 : 1) : 1;

  const int boxWidth = bar + 2 * pad + 10 * scale, boxHeight = 2 * pad + 2 * line + thick + 8 * scale;
  const int left = margin, top = canvas.height - margin - boxHeight;
  if (bar < 30 * scale || top < 0 || textWidth(title, scale) > bar || 5 * boxWidth > 2 * canvas.width) return;

  canvas.fill(left, top, left + boxWidth, top + boxHeight, kPaper, 0.62);
  const int x = left + pad + 3 * scale;
  int y = top + pad;
  canvas.text(x, y, scale, title, kInk);
  if (words <= bar) canvas.text(x + bar - textWidth(caption, scale), y, scale, caption, kInk);
  y += line + 4 * scale;
  for (int k = 0; k < bar; ++k) {
    const Float3 c = mapColor(legend.color, (k + 0.5) / bar);
    const uint8_t color[3] = {srgbByte(c.x), srgbByte(c.y), srgbByte(c.z)};
    canvas.fill(x + k, y, x + k + 1, y + thick, color, 1);
  }
  const int frame = std::max(1, scale / 2);
  canvas.fill(x - frame, y - frame, x + bar + frame, y, kInk, 0.8);
  canvas.fill(x - frame, y + thick, x + bar + frame, y + thick + frame, kInk, 0.8);
  canvas.fill(x - frame, y, x, y + thick, kInk, 0.8);
  canvas.fill(x + bar, y, x + bar + frame, y + thick, kInk, 0.8);
  y += thick + frame;
  const double step = tickStep(range);
  int free = -1000;  // where the last label ended
  for (int k = 0; k * step <= range * 1.0001; ++k) {
    const int at = x + static_cast<int>(std::lround(k * step / range * bar));
    canvas.fill(at - frame, y, at - frame + std::max(1, scale), y + 2 * scale, kInk, 0.8);
    const std::string label = number(k * step);
    const int size = textWidth(label, scale) - scale, start = at - size / 2;
    if (start <= free + 2 * scale) continue;
    canvas.text(start, y + 4 * scale, scale, label, kInk);
    free = start + size;
  }
}

}  // namespace rill
