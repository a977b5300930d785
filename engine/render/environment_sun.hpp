#pragma once
// The sun of an environment map, taken out of it.
#include <optional>

#include "rill/environment.hpp"

namespace rill {

/// Replaces the texels of the sun's disc by what is around it and returns the sun. Without a sun nothing changes. The light of the map and
/// the sun together stays the same.
std::optional<EnvironmentSun> takeSun(EnvironmentPicture& picture);

}  // namespace rill
