#pragma once
#include <cmath>

namespace rill {

inline float f(double value) { return static_cast<float>(value); }

inline double length(const double v[3]) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace rill
