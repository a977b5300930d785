#pragma once
// The appearances that scenes name: the one list of them, for the table of scene keys and for fluidLook().
#include <array>
#include <string_view>

namespace rill {

inline constexpr std::array<std::string_view, 9> kLookNames{"water", "milk", "ink", "clay", "pool", "sea", "river", "honey", "lava"};

}  // namespace rill
