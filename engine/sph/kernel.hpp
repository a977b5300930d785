#pragma once
// The smoothing kernel K = d^3 W: dimensionless, and calibrated so that the rest lattice has exactly the rest density.
#include "rill/scene.hpp"

namespace rill {

/// A radial kernel with support radius h for particles with spacing d and volume d^3: rho_i / rho0 = sum_j K(|x_i - x_j|).
///
///   Wendland C2 (Wendland 1995; Dehnen and Aly 2012, table 1): K = a (1-q)^4 (1+4q), (dK/dr)/r = -20 a (1-q)^3 / h^2, q = r/h.
///   Poly6Spiky (Mueller, Charypar and Gross 2003; Macklin and Mueller 2013): K = a (1-q^2)^3, and the gradient of another kernel,
///   (dK/dr)/r = -45 d^3 (1-q)^2 / (pi h^4 r), which is not the derivative of K. The inconsistency adds energy.
///
/// `a` normalizes the sum over the cubic lattice, including the particle itself, to 1. The spiky gradient has its analytic factor.
class SmoothingKernel {
 public:
  /// `h`: support radius, m, > 0. `d`: spacing, m, > 0. h/d is 1.2 .. 4 in a scene.
  SmoothingKernel(KernelChoice choice, double h, double d);

  /// K at distance `r` >= 0 (m): dimensionless, >= 0; 0 for r >= h.
  double value(double r) const;

  /// (dK/dr)/r at `r`, 1/m^2, <= 0; 0 for r >= h. grad_i K(x_i - x_j) = gradientOverR(r) (x_i - x_j). For Poly6Spiky 0 at r = 0.
  double gradientOverR(double r) const;

  KernelChoice choice() const { return choice_; }
  double h() const { return h_; }        ///< support radius, m
  double spacing() const { return d_; }  ///< d, m

  /// `a`, dimensionless: K = a (1-q)^4 (1+4q), or a (1-q^2)^3.
  double valueScale() const { return valueScale_; }

  /// 1/m^2 and negative for Wendland: gradientOverR = scale (1-q)^3. 1/m and negative for Poly6Spiky: gradientOverR = scale (1-q)^2 / r.
  double gradientScale() const { return gradientScale_; }

  /// D_rest: sum of |grad K|^2 over the rest lattice, 1/m^2. The denominator of lambda at rest (Macklin and Mueller 2013, eq. 11).
  double restGradientSum() const { return restGradientSum_; }

  /// sigma^2: sum of K x^2 over the rest lattice, m^2. XSPH with coefficient c per step dt has the viscosity nu = c sigma^2 / (2 dt).
  double secondMoment() const { return secondMoment_; }

  /// -1/3 of the sum of x . grad K over the rest lattice: what the sum makes of a gradient of 1. 0.95 for Wendland with h = 2 d.
  double gradientOfUnit() const { return gradientOfUnit_; }

 private:
  KernelChoice choice_;
  double h_, d_;
  double valueScale_ = 1, gradientScale_ = 0;
  double restGradientSum_ = 0, secondMoment_ = 0, gradientOfUnit_ = 0;
};

}  // namespace rill
