#pragma once
// What shaders/shared/mixture.glsl takes of the fluids that diffuse.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "rill/scene.hpp"
#include "shared/fluid_records.h"

namespace rill {

struct MixtureConstants {
  std::array<uint32_t, kMaxDiffusing> diffusing{};  ///< indices; kNoFluid behind the last
  uint32_t carrier = kNoFluid;                      ///< the first that does not diffuse
};

/// `diffuses`: of each fluid.
inline MixtureConstants mixtureConstants(const std::vector<bool>& diffuses) {
  MixtureConstants m;
  m.diffusing.fill(kNoFluid);
  size_t found = 0;
  for (size_t k = 0; k < diffuses.size(); ++k)
    if (diffuses[k] && found < kMaxDiffusing) m.diffusing[found++] = static_cast<uint32_t>(k);
  const auto carrier = std::ranges::find(diffuses, false);
  if (carrier != diffuses.end()) m.carrier = static_cast<uint32_t>(carrier - diffuses.begin());
  return m;
}

}  // namespace rill
