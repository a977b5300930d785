#pragma once
// How far a substep of the device may be from that of the reference, in spacings.
#include "fluid/rig.hpp"

namespace rill::test {
namespace substep_test {

using SubstepTest = FluidTest;

inline constexpr double kOne = 2e-4;  // after one substep
inline constexpr double kTen = 1e-3;  // after ten
inline constexpr double kAgeing = 0.1;

}  // namespace substep_test
}  // namespace rill::test
