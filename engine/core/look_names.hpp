#pragma once
// The appearances, skies and stages that scenes name: the one list of each, for the table of scene keys and for what draws them.
#include <array>
#include <string_view>

namespace rill {

inline constexpr std::array<std::string_view, 10> kLookNames{"water", "milk",  "ink",   "clay", "pool",
                                                             "sea",   "river", "honey", "lava", "diluted_milk"};
inline constexpr std::array<std::string_view, 3> kSkyNames{"studio", "day", "sunset"};
inline constexpr std::array<std::string_view, 2> kStageNames{"grid", "tank"};

}  // namespace rill
