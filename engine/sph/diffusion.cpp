#include "sph/diffusion.hpp"

namespace rill {

double diffusionRate(double diffusivity, const SmoothingKernel& kernel) {
  return 6 * diffusivity / (kernel.h() * kernel.h() * pairMoment(kernel, 2));
}

double diffusionRow(const SmoothingKernel& kernel) { return pairMoment(kernel, 0); }

}  // namespace rill
