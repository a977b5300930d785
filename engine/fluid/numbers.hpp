#pragma once

namespace rill {

inline float f(double value) { return static_cast<float>(value); }

}  // namespace rill
