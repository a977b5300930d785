#include "sph/solid_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/overloaded.hpp"

namespace rill {
namespace {

/// The integral I of the header over [0, h], by five-point Gauss-Legendre quadrature between the kinks of f.
template <class Cosine>
double integral(const SmoothingKernel& kernel, std::array<double, 4> kinks, const Cosine& cosine) {
  constexpr int kPieces = 16;
  constexpr double node[3] = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr double weight[3] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  for (double& k : kinks) k = std::clamp(k, 0.0, kernel.h());
  std::sort(kinks.begin(), kinks.end());
  double sum = 0;
  for (size_t part = 0; part + 1 < kinks.size(); ++part) {
    const double half = (kinks[part + 1] - kinks[part]) / (2 * kPieces);
    if (half <= 0) continue;
    for (int piece = 0; piece < kPieces; ++piece) {
      const double middle = kinks[part] + (2 * piece + 1) * half;
      const auto at = [&](double rho) {
        return kernel.value(rho) * 4 * std::numbers::pi * rho * rho * (1 - std::clamp(cosine(rho), -1.0, 1.0)) / 2;
      };
      sum += half * weight[0] * at(middle);
      for (int n = 1; n < 3; ++n) sum += half * weight[n] * (at(middle - half * node[n]) + at(middle + half * node[n]));
    }
  }
  return sum;
}

/// I_ball / I_half at signed distance s > -R.
double ballOverHalfSpace(const SmoothingKernel& kernel, double R, double s) {
  const double h = kernel.h();
  const double plane = integral(kernel, {0, std::abs(s), h, h}, [&](double rho) { return s / rho; });
  const double ball =
      integral(kernel, {0, std::abs(s), 2 * R + s, h}, [&](double rho) { return (s * (2 * R + s) + rho * rho) / (2 * (R + s) * rho); });
  return ball / plane;
}

template <class HalfSpace>
SolidSample boxOf(const HalfSpace& halfSpaceAt, const Double3& local, const Double3& half) {
  LineSample slab[3];
  for (size_t a = 0; a < 3; ++a) {
    const double x = std::abs(local[a]);
    const LineSample front = halfSpaceAt(x - half[a]);
    const LineSample back = halfSpaceAt(x + half[a]);
    slab[a].value = std::clamp(front.value - back.value, 0.0, 1.0);
    slab[a].slope = (local[a] < 0 ? -1 : 1) * (front.slope - back.slope);
  }
  SolidSample sum;
  sum.value = slab[0].value * slab[1].value * slab[2].value;
  for (size_t a = 0; a < 3; ++a) sum.gradient[a] = slab[a].slope * slab[(a + 1) % 3].value * slab[(a + 2) % 3].value;
  return sum;
}

/// A function of the distance from a sphere, as a sample.
SolidSample radial(const LineSample& along, const SurfacePoint& surface) {
  SolidSample sum{.value = along.value};
  for (size_t a = 0; a < 3; ++a) sum.gradient[a] = along.slope * surface.normal[a];
  return sum;
}

template <class Sphere, class Box>
SolidSample sampleOf(const Shape& shape, const Double3& local, const Sphere& sphereAt, const Box& boxAt) {
  return std::visit(
      Overloaded{[&](const SphereShape& sphere) {
                   const SurfacePoint surface = surfaceAt(sphere, local);
                   return radial(sphereAt(sphere.radius, surface.distance), surface);
                 },
                 [&](const BoxShape& box) { return boxAt(halfExtents(box)); }, [](const MeshShape&) { return SolidSample{}; }},
      shape);
}

}  // namespace

LineSample exactSphere(const SmoothingKernel& kernel, double R, double s) {
  if (s >= solidReach(kernel)) return {};
  // The distance has a kink at the center: clamp just outside of it.
  const double at = std::max(s, -R * (1 - 1e-6)), step = 1e-5 * std::min(R, kernel.spacing());
  const LineSample f = halfSpace(kernel, at);
  const double ratio = ballOverHalfSpace(kernel, R, at);
  const double below = std::max(at - step, -R * (1 - 1e-7));
  const double slope = (ballOverHalfSpace(kernel, R, at + step) - ballOverHalfSpace(kernel, R, below)) / (at + step - below);
  return {f.value * ratio, f.slope * ratio + f.value * slope};
}

SphereTable makeSphereTable(const SmoothingKernel& kernel, double R) {
  SphereTable t;
  t.step = kernel.spacing() / 16;
  const double reach = solidReach(kernel) * (1 - 1e-9);
  t.first = -t.step * std::floor(std::min(R, reach) / t.step);
  t.nodes = static_cast<uint32_t>(std::ceil((reach - t.first) / t.step - 1e-6)) + 2;
  for (uint32_t i = 0; i < t.nodes; ++i) {
    const double s = t.first + i * t.step;
    const LineSample ball = s >= reach ? LineSample{} : exactSphere(kernel, R, s);
    t.table.push_back(static_cast<float>(ball.value));
    t.table.push_back(static_cast<float>(ball.slope));
  }
  return t;
}

LineSample SphereTable::sample(double s) const {
  const double at = std::max(s - first, 0.0) / step;
  if (!(at < nodes - 1)) return {};
  const double node = std::floor(at), t = at - node;
  const float* n = &table[2 * static_cast<size_t>(node)];
  return {n[0] * (1 - t) + n[2] * t, n[1] * (1 - t) + n[3] * t};
}

SolidSample boxSample(const SmoothingKernel& kernel, const Double3& local, const Double3& half) {
  for (size_t a = 0; a < 3; ++a)
    if (std::abs(local[a]) - half[a] >= solidReach(kernel)) return {};
  return boxOf([&](double s) { return halfSpace(kernel, s); }, local, half);
}

SolidSample boxSample(const HalfSpaceTable& table, const Double3& local, const Double3& half) {
  return boxOf([&](double s) { return table.sample(s); }, local, half);
}

SolidSample solidSample(const SmoothingKernel& kernel, const Shape& shape, const Double3& local) {
  return sampleOf(
      shape, local, [&](double radius, double s) { return exactSphere(kernel, radius, s); },
      [&](const Double3& half) { return boxSample(kernel, local, half); });
}

SolidSample solidSample(const HalfSpaceTable& table, const SphereTable& sphere, const Shape& shape, const Double3& local) {
  return sampleOf(
      shape, local, [&](double, double s) { return sphere.sample(s); }, [&](const Double3& half) { return boxSample(table, local, half); });
}

}  // namespace rill
