#include "sph/half_space.hpp"

#include <algorithm>
#include <cmath>

namespace rill {
namespace {

constexpr int kStepsPerSpacing = 16;

}  // namespace

double solidReach(const SmoothingKernel& kernel) { return kernel.h() - kernel.spacing() / 2; }

LineSample exactPlane(const SmoothingKernel& kernel, double s) {
  LineSample sum;
  const double d = kernel.spacing(), h = kernel.h();
  const int reach = static_cast<int>(std::ceil(h / d));
  for (double behind = std::max(s, 0.0) + d / 2; behind < h; behind += d)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k) {
        const double square = behind * behind + d * d * (j * j + k * k);
        if (square >= h * h) continue;
        const double r = std::sqrt(square);
        sum.value += kernel.value(r);
        sum.slope += kernel.gradientOverR(r) * behind;
      }
  return sum;
}

LineSample halfSpace(const SmoothingKernel& kernel, double s) {
  const double distance = std::abs(s), near = 1 - 2 * distance / kernel.spacing();
  LineSample f = exactPlane(kernel, distance);
  if (near > 0) {
    const double gap = 0.5 - exactPlane(kernel, 0).value;
    f.value += gap * near * near;
    f.slope -= gap * 4 * near / kernel.spacing();
  }
  if (s < 0) f.value = 1 - f.value;
  return f;
}

HalfSpaceTable makeHalfSpaceTable(const SmoothingKernel& kernel) {
  HalfSpaceTable t;
  t.step = kernel.spacing() / kStepsPerSpacing;
  // Nodes up to the first at or beyond the reach, and a guard node.
  t.nodes = static_cast<uint32_t>(std::ceil(solidReach(kernel) / t.step - 1e-9)) + 2;
  for (uint32_t i = 0; i < t.nodes; ++i) {
    const LineSample f = i * t.step >= solidReach(kernel) * (1 - 1e-9) ? LineSample{} : halfSpace(kernel, i * t.step);
    t.table.push_back(static_cast<float>(f.value));
    t.table.push_back(static_cast<float>(f.slope));
  }
  return t;
}

LineSample HalfSpaceTable::sample(double s) const {
  LineSample f;
  if (const double at = std::abs(s) / step; at < nodes - 1) {
    const double node = std::floor(at), t = at - node;
    const float* n = &table[2 * static_cast<size_t>(node)];
    f = {n[0] * (1 - t) + n[2] * t, n[1] * (1 - t) + n[3] * t};
  }
  if (s < 0) f.value = 1 - f.value;
  return f;
}

}  // namespace rill
