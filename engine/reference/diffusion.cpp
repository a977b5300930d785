// Diffusion of concentrations between particles, dc_i/dt = c sum_j w(|q|) (c_j - c_i), w and c of sph/diffusion.hpp.
#include "sph/diffusion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "reference/solver.hpp"
#include "shared/diffusion_steps.h"

namespace rill::reference {

std::vector<double> ReferenceSolver::exchange(const std::vector<double>& c) const {
  std::vector<double> all(size(), 0);
  for (size_t i = 0; i < size(); ++i)
    for (const Pair& pair : pairs(i)) all[i] += pairWeight(glm::length(pair.offset) / kernel_.h()) * (c[pair.j] - c[i]);
  return all;
}

double ReferenceSolver::diffusionRow() const {
  double largest = 0;
  for (size_t i = 0; i < size(); ++i) {
    double row = 0;
    for (const Pair& pair : pairs(i)) row += pairWeight(glm::length(pair.offset) / kernel_.h());
    largest = std::max(largest, row);
  }
  return largest;
}

// Of all concentrations the stages are those that the fastest of them asks for.
void ReferenceSolver::diffuse(double dt) {
  double fastest = 0;
  for (const ReferenceFluid& fluid : settings.fluids) fastest = std::max(fastest, fluid.diffusion);
  const double length = dt * diffusionRate(fastest, kernel_) * diffusionRow();
  size_t component = 0;
  for (const ReferenceFluid& fluid : settings.fluids) {
    if (!(fluid.diffusion > 0)) continue;
    std::vector<double>& c = state.concentration[component++];
    const double rate = diffusionRate(fluid.diffusion, kernel_);
    uint32_t stages = static_cast<uint32_t>(std::ceil(100 * length));
    double each = stages > 0 ? dt / stages : 0;
    if (settings.diffusionStages > 0) {
      stages = shared::diffusionStages(length, static_cast<uint32_t>(settings.diffusionStages));
      each = dt / std::max(length, double(stages));  // of a step that needs more, the rest is left out
    }
    for (uint32_t n = 0; n < stages; ++n) {
      const std::vector<double> change = exchange(c);
      for (size_t i = 0; i < size(); ++i) c[i] += rate * each * change[i];
    }
  }
}

}  // namespace rill::reference
