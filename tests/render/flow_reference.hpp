#pragma once
// Maps of depth, and a step of curvature flow over one in double precision.
#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "render/surface_rig.hpp"
#include "shared/no_depth.h"

namespace rill::test {

inline constexpr float kNone = std::bit_cast<float>(kNoDepthBits);
inline bool isDepth(double z) { return z < double{kNone}; }
inline constexpr double kH = double{kSpacing};

/// Depth a sample, rows from the top.
struct Map {
  int columns = 0, rows = 0;
  std::vector<float> z;

  Map(int across, int down, float value) : columns(across), rows(down), z(size_t(across) * size_t(down), value) {}
  float& at(int x, int y) { return z[size_t(y) * size_t(columns) + size_t(x)]; }
  float at(int x, int y) const { return z[size_t(y) * size_t(columns) + size_t(x)]; }
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < columns && y < rows; }
};

/// A filter's result, and the smallest margin of its decisions (m, or samples of a reach).
struct Wanted {
  double z = 0;
  double margin = 1;
  bool cut = false;  ///< a bound took effect
};

/// m that a sample is wide at a depth.
inline double sideAt(const surface::SurfacePush& push, double z) {
  return std::abs(double{push.scale[1]}) * 2 / push.height * push.step * (push.perspective > 0 ? z : 1);
}

/// Depth difference (m) above which neighboring samples are of two surfaces.
inline double edgeAt(const surface::SurfacePush& push, double z) { return std::max(kH, 3.3 * sideAt(push, z)); }

// Depth as a function of both directions across, moved by half the mean curvature of its graph: dz/dt = (trace H - g.H.g / (1 + g.g)) / 2
// with its gradient g and second derivatives H. Differences are taken of 1 / z in perspective, of which -z^2 makes differences of z.
// The whole time is shared among as many equal steps as it takes of `share` of a sample's square at most; `turn` is one of them, or past
// the last.
inline Wanted flowed(const Map& map, const surface::SurfacePush& push, int x, int y, double share, int turn = 0) {
  const double z = double{map.at(x, y)}, side = sideAt(push, z), edge = edgeAt(push, z);
  const auto linear = [&](double depth) { return push.perspective > 0 ? 1 / depth : depth; };
  Wanted wanted;
  const auto neighbor = [&](int dx, int dy) {
    return double{map.at(std::clamp(x + dx, 0, map.columns - 1), std::clamp(y + dy, 0, map.rows - 1))};
  };
  const auto sees = [&](double other) {
    wanted.margin = std::min(wanted.margin, std::abs(std::abs(other - z) - edge));
    return std::abs(other - z) < edge;
  };
  const auto value = [&](int dx, int dy) {
    const double there = neighbor(dx, dy), opposite = neighbor(-dx, -dy);
    if (sees(there)) return linear(there);
    return sees(opposite) ? 2 * linear(z) - linear(opposite) : linear(z);
  };
  const double meters = push.perspective > 0 ? -z * z : 1;
  const auto slope = [&](int dx, int dy) { return meters * (value(dx, dy) - value(-dx, -dy)) / (2 * side); };
  const auto bend = [&](int dx, int dy) { return meters * (value(dx, dy) - 2 * linear(z) + value(-dx, -dy)) / (side * side); };
  const double g[2] = {slope(1, 0), slope(0, 1)};
  const double mixed = meters * (value(1, 1) - value(-1, 1) - value(1, -1) + value(-1, -1)) / (4 * side * side);
  const double hessian[2][2] = {{bend(1, 0), mixed}, {mixed, bend(0, 1)}};
  double along = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) along += g[i] * hessian[i][j] * g[j];
  const double rate = 0.5 * (hessian[0][0] + hessian[1][1] - along / (1 + g[0] * g[0] + g[1] * g[1]));
  const double steps = std::ceil(double{push.smoothing} / (share * side * side)), time = turn < steps ? double{push.smoothing} / steps : 0;
  wanted.cut = std::abs(time * rate) > 0.25 * kH;
  wanted.z = z + std::clamp(time * rate, -0.25 * kH, 0.25 * kH);
  return wanted;
}

}  // namespace rill::test
