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

/// The device whose index is `wanted`, whose whole name it is, or whose name alone contains it; upper and lower case are the same. BadInput
/// with the devices to choose from if there is none, or more than one.
Expected<size_t> chooseDevice(std::span<const std::string> names, std::string_view wanted);

}  // namespace rill::offline
