#include "bench/experiments/exact.hpp"

#include <cmath>

namespace rill::bench {
namespace {

EllipticDrop derivative(const EllipticDrop& at) {
  const double aa = at.a * at.a, bb = at.b * at.b;
  return {-at.rate * at.a, at.rate * at.b, at.rate * at.rate * (aa - bb) / (aa + bb)};
}

EllipticDrop advanced(const EllipticDrop& from, const EllipticDrop& by, double times) {
  return {from.a + times * by.a, from.b + times * by.b, from.rate + times * by.rate};
}

}  // namespace

EllipticDrop ellipticDrop(double time) {
  constexpr int kSteps = 2000;  // classical Runge-Kutta; errors far below float precision
  const double step = time / kSteps;
  EllipticDrop drop;
  for (int k = 0; k < kSteps; ++k) {
    const EllipticDrop k1 = derivative(drop), k2 = derivative(advanced(drop, k1, step / 2)), k3 = derivative(advanced(drop, k2, step / 2)),
                       k4 = derivative(advanced(drop, k3, step));
    drop = advanced(advanced(advanced(advanced(drop, k1, step / 6), k2, step / 3), k3, step / 3), k4, step / 6);
  }
  return drop;
}

}  // namespace rill::bench
