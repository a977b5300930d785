#pragma once
// Which of several devices a name stands for.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "rill/expected.hpp"

namespace rill::offline {

/// A line for each device: its index and its name.
std::string listDevices(std::span<const std::string> names);

/// The device whose index or whole name is `wanted`, or the only one whose name contains it; case-insensitive. BadInput if none matches,
/// or more than one; the message lists the candidates.
Expected<size_t> chooseDevice(std::span<const std::string> names, std::string_view wanted);

}  // namespace rill::offline
