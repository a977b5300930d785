#include "sph/no_slip.hpp"

#include <algorithm>
#include <cmath>

#include "sph/viscosity.hpp"

namespace rill {

double noSlipLength(const SmoothingKernel& kernel, double s) {
  const double d = kernel.spacing(), h = kernel.h(), y = std::max(s, d / 2);
  const int reach = static_cast<int>(std::ceil(h / d));
  double moment = 0;
  for (double behind = y + d / 2; behind < h; behind += d)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k)
        moment += behind * pairWeight(std::sqrt(behind * behind + d * d * (j * j + k * k)) / h) * d * d * j * j / (h * h);
  const double slope = -exactPlane(kernel, y).slope;
  return slope > 0 ? moment / (y * slope) : 0;
}

std::vector<float> makeNoSlipTable(const SmoothingKernel& kernel) {
  const HalfSpaceTable plane = makeHalfSpaceTable(kernel);
  std::vector<float> table(plane.nodes, 0.0f);
  for (uint32_t i = 0; i < plane.nodes; ++i)
    if (i * plane.step < solidReach(kernel) * (1 - 1e-9)) table[i] = static_cast<float>(noSlipLength(kernel, i * plane.step));
  return table;
}

double sampleNoSlip(const std::vector<float>& table, double step, double s) {
  const double at = std::max(s, 0.0) / step, node = std::floor(at), t = at - node;
  if (at >= static_cast<double>(table.size() - 1)) return 0;
  const auto n = static_cast<size_t>(node);
  return table[n] * (1 - t) + table[n + 1] * t;
}

}  // namespace rill
