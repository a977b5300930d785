#pragma once
// Surface tension as the energy of samples: points around each particle that no neighbor covers. See docs/notes/surface-tension.md.
//
// Around a particle at x_i lie kTensionSamples points q_ik = x_i + r u_k, u_k the corners of a regular dodecahedron. With
//   c_ik = C sum_j W(|q_ik - x_j| / s) over j other than i,   W(l) = max(0, 1 - l^2)^3,   S(c) = max(0, 1 - c)^2,
// the energy is
//   E = A sum_ik w(y_ik) S(c_ik),   A = a sigma d^2 4 pi (r/d)^2 / kTensionSamples,
// w = 1 in air; at walls and solids, y away from the nearest one, it goes from -cos(contact angle) at y <= 0 to 1 at y >= d, so that wet
// area has the energy that Young's equation asks for. Its gradient is the force: linear momentum is kept exactly, and energy but for the
// time step. Inside the fluid c >= 1: there is no force.
#include <array>

#include "rill/vectors.hpp"
#include "shared/surface_tension.h"

namespace rill {

/// Unit vectors to the samples, in the order in which the shaders keep them: shaders/fluid/surface_samples.glsl.
std::array<Double3, kTensionSamples> tensionDirections();

/// w of a distance from the nearest wall or solid, in spacings, and its slope over that.
struct TensionWeight {
  double value = 1, slope = 0;
};
TensionWeight tensionWeight(double distance, double wettingCosine);

/// The acceleration of a particle by a sample of its own is  -rate w (1 - c) sum_j (1 - l^2)^2 (q - x_j), 1/s^2, and each x_j has the
/// opposite one; where w changes there is  -wall S w' n  besides, m/s^2, n pointing away from the wall. `tension`: N/m, `density`: kg/m^3,
/// `spacing`: m.
struct TensionRates {
  double rate = 0, wall = 0;
};
TensionRates tensionRates(double tension, double density, double spacing);

/// The longest stable step, s; infinite without tension.
double capillaryStep(double tension, double density, double spacing);

}  // namespace rill
