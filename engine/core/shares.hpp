#pragma once
// Shares of the fluids that diffuse in a particle, as FluidState::concentration has them.
#include <span>

#include "rill/vectors.hpp"

namespace rill {

/// The components of shares, in the order of diffusingFluids().
inline constexpr float Float4::*kShares[] = {&Float4::x, &Float4::y, &Float4::z, &Float4::w};

/// Of a particle of `fluid` that has not mixed. `diffusing`: indices of the fluids that diffuse, at most four.
template <class Index>
Float4 unmixed(std::span<const Index> diffusing, size_t fluid) {
  Float4 shares{};
  for (size_t k = 0; k < diffusing.size(); ++k) shares.*kShares[k] = diffusing[k] == fluid ? 1.0F : 0.0F;
  return shares;
}

}  // namespace rill
