#include "render/view_push.hpp"

#include <algorithm>
#include <cmath>

namespace rill {
surface::SurfacePush viewPush(const FluidView& view, const Double3& origin) {
  const Float4x4 &v = view.view, &p = view.projection;
  const bool perspective = element(p, 3, 2) != 0;
  // The view direction is -z unless the projection's w grows along +z.
  const double forward = perspective && element(p, 3, 2) > 0 ? 1 : -1;
  const double w = perspective ? std::abs(element(p, 3, 2)) : element(p, 3, 3);
  surface::SurfacePush push{};
  for (int r = 0; r < 3; ++r) {
    const double sign = r == 2 ? forward : 1;
    double moved = element(v, r, 3);
    for (int c = 0; c < 3; ++c) {
      push.rows[4 * r + c] = static_cast<float>(sign * element(v, r, c));
      moved += element(v, r, c) * (origin[c] - view.origin[c]);
    }
    push.rows[4 * r + 3] = static_cast<float>(sign * moved);
  }
  for (int r = 0; r < 2; ++r) {
    push.scale[r] = static_cast<float>(w / element(p, r, r));
    push.shift[r] = static_cast<float>((perspective ? forward * element(p, r, 2) : element(p, r, 3)) / w);
  }
  push.perspective = perspective ? 1.0f : 0.0f;
  const double constant = perspective ? forward * element(p, 2, 2) / w : element(p, 2, 3) / w;
  const double varying = perspective ? element(p, 2, 3) / w : forward * element(p, 2, 2) / w;
  push.depth_map[0] = static_cast<float>(constant);
  push.depth_map[1] = static_cast<float>(varying);
  // View depth where the target's depth is 0 and where it is 1; not finite for an infinite far plane.
  const auto depthOf = [&](double stored) { return perspective ? varying / (stored - constant) : (stored - constant) / varying; };
  const double a = depthOf(0), b = depthOf(1);
  double near = perspective ? (std::isfinite(a) && a > 0 ? a : b) : std::min(a, b);
  if (perspective && std::isfinite(b) && b > 0) near = std::min(near, b);
  if (!perspective) {  // depth starts at the near plane, which may be behind the eye: shaders compare the bits of depths, which must be
                       // positive
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
