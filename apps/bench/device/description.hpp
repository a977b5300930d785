#pragma once
// What a device is: its limits, and the variants of shaders that Rill chooses for it.
#include <string>

#include "bench/bench.hpp"
#include "rill/device.hpp"

namespace rill::bench {

struct DeviceDescription {
  std::string name;
  std::string identity;         ///< name, driver and version of Vulkan, in a line
  std::string variants;         ///< clusters, subgroups and reads, in a line
  uint64_t availableBytes = 0;  ///< of device memory
  Table table;
  Json result;  ///< the choices
};

DeviceDescription describeDevice(const Device& device);

}  // namespace rill::bench
