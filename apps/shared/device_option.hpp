#pragma once
#include <optional>
#include <string>

#include "rill/expected.hpp"

namespace rill::apps {

/// Help of --device.
inline constexpr const char* kDeviceHelp = "name of a device, a part that no other has, or its index (default: $RILL_DEVICE)";

/// Which device the user asks for, and where.
struct DeviceOption {
  std::string name;    ///< as ContextDesc::device; empty: none in particular
  std::string origin;  ///< "--device" or "RILL_DEVICE", for messages; empty where `name` is
};

/// `given`: the value of --device where that is on the command line; otherwise RILL_DEVICE counts, unless it is unset or empty. BadInput
/// for an empty `given`.
Expected<DeviceOption> deviceOption(const std::optional<std::string>& given);

}  // namespace rill::apps
