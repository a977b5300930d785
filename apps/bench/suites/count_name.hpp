#pragma once
#include <cstdint>
#include <string>

namespace rill::bench {

/// Formats thousands as "1k", "500k", "4M", so that --only 1k does not match 10k by its digits alone.
inline std::string countName(uint32_t count) {
  return count % 1'000'000 == 0 ? std::to_string(count / 1'000'000) + "M" : std::to_string(count / 1000) + "k";
}

}  // namespace rill::bench
