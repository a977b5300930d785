#pragma once
#include <cstdint>
#include <string>

namespace rill::bench {

/// "1k", "500k", "4M", of whole thousands: in the name of a case, where 1000 would be found in 10000 as well.
inline std::string countName(uint32_t count) {
  return count % 1'000'000 == 0 ? std::to_string(count / 1'000'000) + "M" : std::to_string(count / 1000) + "k";
}

}  // namespace rill::bench
