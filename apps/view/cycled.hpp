#pragma once
#include <algorithm>
#include <string>
#include <vector>

namespace rill::view {

/// The name `step` places after `name`, cyclic, with `step` from -1 to 1; the first one where `name` is not in the list.
inline std::string cycled(const std::vector<std::string>& names, const std::string& name, int step) {
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) return names.empty() ? name : names.front();
  const auto count = static_cast<int>(names.size());
  return names[static_cast<size_t>((static_cast<int>(at - names.begin()) + step + count) % count)];
}

}  // namespace rill::view
