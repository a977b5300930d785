#include "offline/device_choice.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace rill::offline {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return out;
}

std::string line(std::span<const std::string> names, size_t index) { return "\n  " + std::to_string(index) + "  " + names[index]; }

}  // namespace

std::string listDevices(std::span<const std::string> names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) text += line(names, i);
  return text;
}

Expected<size_t> chooseDevice(std::span<const std::string> names, std::string_view wanted) {
  if (!wanted.empty() && wanted.size() <= 3 && std::ranges::all_of(wanted, [](unsigned char c) { return std::isdigit(c); }))
    if (const size_t index = std::stoul(std::string(wanted)); index < names.size()) return index;
  std::vector<size_t> whole, partly;
  for (size_t i = 0; i < names.size(); ++i) {
    if (lower(names[i]) == lower(wanted)) whole.push_back(i);
    if (lower(names[i]).find(lower(wanted)) != std::string::npos) partly.push_back(i);
  }
  const std::vector<size_t>& fits = whole.empty() ? partly : whole;
  if (fits.size() == 1) return fits.front();
  if (fits.empty())
    return Error{ErrorKind::BadInput, "no Vulkan device matches '" + std::string(wanted) + "'. Available devices:" + listDevices(names)};
  std::string several = "'" + std::string(wanted) + "' fits " + std::to_string(fits.size()) +
                        " Vulkan devices; expected the whole name of one, or its index:";
  for (const size_t i : fits) several += line(names, i);
  return Error{ErrorKind::BadInput, std::move(several)};
}

}  // namespace rill::offline
