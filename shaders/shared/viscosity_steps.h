// Chebyshev's iteration for the implicit step of viscosity, (1 + dt L) v = b: its step lengths. Shared by C++ and GLSL.
// See docs/notes/viscosity.md.
#ifndef RILL_SHADERS_SHARED_VISCOSITY_STEPS_H
#define RILL_SHADERS_SHARED_VISCOSITY_STEPS_H

#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#define RILL_STEPS_REAL double
#define RILL_STEPS_UINT std::uint32_t
#define RILL_STEPS_BOOL bool
#define RILL_STEPS_FUNCTION inline
namespace rill::shared {
using std::pow;
using std::sqrt;
#else
#define RILL_STEPS_REAL float
#define RILL_STEPS_UINT uint
#define RILL_STEPS_BOOL bool
#define RILL_STEPS_FUNCTION
#endif

/// The iteration for eigenvalues of 1 + dt L from 1 to a bound. Its residual is a polynomial of them that is 1 at 0 and 0 at 1: rigid
/// motion, and in the limit long waves, are exact. With one step it is an explicit step of viscosity.
struct ViscositySteps {
  RILL_STEPS_UINT count;
  RILL_STEPS_REAL center, halfWidth;  ///< of the eigenvalues that it is for
  RILL_STEPS_REAL decay;              ///< of the residual in a step, in the limit of many
  RILL_STEPS_REAL remaining;          ///< of the residual of any eigenvalue, at most
};

/// The share of the residual up to which steps are added.
#ifdef __cplusplus
constexpr double kViscosityRemaining = 0.2;
#else
const float kViscosityRemaining = 0.2;
#endif

/// As few steps as leave at most kViscosityRemaining; `maxSteps`, at least 1, if more are needed: the longest waves then lose less than
/// they should.
RILL_STEPS_FUNCTION ViscositySteps viscositySteps(RILL_STEPS_REAL bound, RILL_STEPS_UINT maxSteps) {
  ViscositySteps s;
  RILL_STEPS_REAL high = bound > 1.001 ? (bound < 1.0e30 ? bound : 1.0e30) : 1.001;
  for (s.count = 1u;; s.count += 1u) {
    RILL_STEPS_BOOL last = s.count >= maxSteps;
    RILL_STEPS_REAL n = RILL_STEPS_REAL(s.count), angle = 0.785398163397448 / n, square = angle * angle;
    // Its series, since GLSL promises few digits of a sine.
    RILL_STEPS_REAL sine = angle * (1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0)));
    // The largest root of the polynomial is at cos(pi / 2 n) of the half width, down from the center: it is at 1.
    RILL_STEPS_REAL low = (1.0 - high * sine * sine) / (1.0 - sine * sine), least = 0.5 * high / (n * n);
    RILL_STEPS_BOOL reaches = low > 0.0;
    if (last && low < least) low = least;
    s.center = 0.5 * (high + low);
    s.halfWidth = 0.5 * (high - low);
    RILL_STEPS_REAL beyond = low / s.halfWidth;  // of the interval, where the polynomial is 1
    s.decay = 1.0 / (1.0 + beyond + sqrt(beyond * (2.0 + beyond)));
    RILL_STEPS_REAL power = pow(s.decay, n);
    s.remaining = 2.0 * power / (1.0 + power * power);
    if (last || (reaches && s.remaining <= kViscosityRemaining)) return s;
  }
}

/// The ratio of Chebyshev's polynomials of degree k and k + 1 where the residual is 1: a step from direction d is along
/// ratio(k) ratio(k - 1) d + 2 ratio(k) / halfWidth times the residual, and the first one, k = 0, along the residual over `center`.
RILL_STEPS_FUNCTION RILL_STEPS_REAL chebyshevRatio(RILL_STEPS_REAL decay, RILL_STEPS_UINT k) {
  RILL_STEPS_REAL power = pow(decay, RILL_STEPS_REAL(2u * k));
  return decay * (1.0 + power) / (1.0 + power * decay * decay);
}

#ifdef __cplusplus
}  // namespace rill::shared
#endif
#undef RILL_STEPS_REAL
#undef RILL_STEPS_UINT
#undef RILL_STEPS_BOOL
#undef RILL_STEPS_FUNCTION
#endif
