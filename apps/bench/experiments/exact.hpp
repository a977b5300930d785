#pragma once
// Exact solutions.

namespace rill::bench {

/// A weightless disc that starts with v = A0 (-x, y), in units of its radius R and of A0.
struct EllipticDrop {
  double a = 1, b = 1;  ///< semi-axes over R: the short and the long one
  double rate = 1;      ///< A / A0
};
/// A' = A^2 (a^2 - b^2) / (a^2 + b^2), a' = -A a, b' = A b. `time` is A0 t.
EllipticDrop ellipticDrop(double time);

}  // namespace rill::bench
