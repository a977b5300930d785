#include "shared/device_option.hpp"

#include <cstdlib>

#include "shared/option_text.hpp"

namespace rill::apps {

Expected<DeviceOption> deviceOption(const std::optional<std::string>& given) {
  if (given && given->empty()) return badInput("--device", *given, "part of a device's name, or its index");
  if (given) return DeviceOption{*given, "--device"};
  if (const char* named = std::getenv("RILL_DEVICE"); named && *named) return DeviceOption{named, "RILL_DEVICE"};
  return DeviceOption{};
}

}  // namespace rill::apps
