#include "render/view_push.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace rill {
namespace {

constexpr uint32_t kMaxSide = 8192;
constexpr uint64_t kMaxPixels = uint64_t{1} << 24;  // of eight bytes: a buffer's 128 MiB

/// Element of a row and a column.
double at(const Float4x4& m, int row, int column) {
  const Float4& c = m.column[column];
  return row == 0 ? c.x : row == 1 ? c.y : row == 2 ? c.z : c.w;
}

}  // namespace

Expected<void> checkViewport(uint32_t width, uint32_t height) {
  constexpr uint64_t kBorder = 2 * surface::kMarginSamples;
  const auto bad = [&](const std::string& expected) {
    return Error{ErrorKind::BadInput,
                 "a picture of the fluid of " + std::to_string(width) + "x" + std::to_string(height) + " pixels: " + expected};
  };
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide)
    return bad("width and height must be 1 to " + std::to_string(kMaxSide));
  if ((width + kBorder) * (height + kBorder) > kMaxPixels)
    return bad("with " + std::to_string(kBorder) + " more each way at most " + std::to_string(kMaxPixels) + " are possible");
  return {};
}

Expected<void> checkView(const FluidView& view) {
  if (auto ok = checkViewport(view.width, view.height); !ok) return ok;
  const auto bad = [](std::string what) { return Error{ErrorKind::BadInput, "FluidView: " + std::move(what)}; };
  for (const Float4x4* matrix : {&view.view, &view.projection})
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        if (!std::isfinite(at(*matrix, r, c))) return bad("a matrix holds a number that is not finite");
  for (int r = 0; r < 3; ++r) {
    double square = 0, dot = 0;
    for (int c = 0; c < 3; ++c) {
      square += at(view.view, r, c) * at(view.view, r, c);
      dot += at(view.view, r, c) * at(view.view, (r + 1) % 3, c);
    }
    if (std::abs(square - 1) > 1e-3 || std::abs(dot) > 1e-3) return bad("the view matrix is not rigid: it scales or shears");
  }
  if (!(view.focus_m > 0) || !std::isfinite(view.focus_m)) return bad("focus_m must be a distance above 0");
  const Float4x4& p = view.projection;
  for (const auto& [row, column] : {std::pair{0, 1}, std::pair{1, 0}, std::pair{2, 0}, std::pair{2, 1}, std::pair{3, 0}, std::pair{3, 1}})
    if (at(p, row, column) != 0) return bad("the projection shears: only a centered or shifted one is possible");
  const double w = at(p, 3, 2), constant = at(p, 3, 3);
  const bool perspective = w != 0 && constant == 0, orthographic = w == 0 && constant != 0;
  if (!(perspective || orthographic) || at(p, 0, 0) == 0 || at(p, 1, 1) == 0)
    return bad("the projection is neither a perspective nor an orthographic one");
  if (perspective ? at(p, 2, 3) == 0 : at(p, 2, 2) == 0) return bad("the projection gives every point the same depth");
  return {};
}

surface::SurfacePush viewPush(const FluidView& view, const double origin[3]) {
  const Float4x4 &v = view.view, &p = view.projection;
  const bool perspective = at(p, 3, 2) != 0;
  // Depth grows away from the eye: along -z unless the projection says otherwise.
  const double forward = perspective && at(p, 3, 2) > 0 ? 1 : -1;
  const double w = perspective ? std::abs(at(p, 3, 2)) : at(p, 3, 3);
  surface::SurfacePush push{};
  for (int r = 0; r < 3; ++r) {
    const double sign = r == 2 ? forward : 1;
    double moved = at(v, r, 3);
    for (int c = 0; c < 3; ++c) {
      push.rows[4 * r + c] = static_cast<float>(sign * at(v, r, c));
      moved += at(v, r, c) * (origin[c] - view.origin[c]);
    }
    push.rows[4 * r + 3] = static_cast<float>(sign * moved);
  }
  for (int r = 0; r < 2; ++r) {
    push.scale[r] = static_cast<float>(w / at(p, r, r));
    push.shift[r] = static_cast<float>((perspective ? forward * at(p, r, 2) : at(p, r, 3)) / w);
  }
  push.perspective = perspective ? 1.0f : 0.0f;
  const double constant = perspective ? forward * at(p, 2, 2) / w : at(p, 2, 3) / w;
  const double varying = perspective ? at(p, 2, 3) / w : forward * at(p, 2, 2) / w;
  push.depth_map[0] = static_cast<float>(constant);
  push.depth_map[1] = static_cast<float>(varying);
  // Where the target's depth is 0 and where it is 1; an infinite far plane has none.
  const auto depthOf = [&](double stored) { return perspective ? varying / (stored - constant) : (stored - constant) / varying; };
  const double a = depthOf(0), b = depthOf(1);
  double near = perspective ? (std::isfinite(a) && a > 0 ? a : b) : std::min(a, b);
  if (perspective && std::isfinite(b) && b > 0) near = std::min(near, b);
  if (!perspective) {  // depth counts from the near plane, which may lie behind the eye: shaders compare depths by their bits
    push.rows[11] -= static_cast<float>(near);
    push.depth_map[0] += static_cast<float>(varying * near);
    near = 0;
  }
  push.near_depth = static_cast<float>(perspective ? std::max(near, 1e-9) : near);
  push.width = view.width;
  push.height = view.height;
  push.left = view.x;
  push.top = view.y;
  return push;
}

}  // namespace rill
