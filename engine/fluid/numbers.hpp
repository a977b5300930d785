#pragma once
#include <cmath>

#include "rill/vectors.hpp"

namespace rill {

inline float f(double value) { return static_cast<float>(value); }

inline double length(const Double3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace rill
