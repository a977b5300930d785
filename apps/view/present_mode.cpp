#include "view/present_mode.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/words.hpp"
#include "shared/words.hpp"

namespace rill::view {
namespace {

constexpr std::pair<VkPresentModeKHR, std::string_view> kModes[] = {{VK_PRESENT_MODE_FIFO_KHR, "fifo"},
                                                                    {VK_PRESENT_MODE_MAILBOX_KHR, "mailbox"},
                                                                    {VK_PRESENT_MODE_IMMEDIATE_KHR, "immediate"},
                                                                    {VK_PRESENT_MODE_FIFO_RELAXED_KHR, "fifo-relaxed"}};

}  // namespace

std::string_view presentModeName(VkPresentModeKHR mode) {
  for (const auto& [known, name] : kModes)
    if (known == mode) return name;
  return {};
}

std::optional<VkPresentModeKHR> presentModeNamed(std::string_view name) {
  for (const auto& [mode, known] : kModes)
    if (known == name) return mode;
  return std::nullopt;
}

std::string presentModeNames() {
  std::vector<std::string> names;
  for (const auto& row : kModes) names.emplace_back(row.second);
  return apps::joined(names);
}

Expected<void> checkPresentMode(VkPresentModeKHR mode, std::span<const VkPresentModeKHR> offered) {
  if (std::ranges::find(offered, mode) != offered.end()) return {};
  std::vector<std::string> names;
  for (const VkPresentModeKHR other : offered)
    if (const std::string_view name = presentModeName(other); !name.empty()) names.emplace_back(name);
  return Error{ErrorKind::BadInput,
               "--present: " + inQuotes(presentModeName(mode)) + " is not offered by this window; expected " + apps::joined(names)};
}

}  // namespace rill::view
