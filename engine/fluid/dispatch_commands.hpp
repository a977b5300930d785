#pragma once
// The dispatches that the device switches on and off (shaders/fluid/dispatch_commands.glsl): one command for each start and extent.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "shared/fluid_records.h"
#include "sort/dispatches.hpp"

namespace rill {

constexpr uint32_t kNoCommand = 0xFFFFFFFF;

class DispatchCommands {
 public:
  /// The command over `over` that `start` starts, of `groups` workgroups; in x the particles a group where it is over particles. Equal ones
  /// share a command.
  uint32_t shared(uint32_t start, uint32_t over, GroupCount groups) {
    const auto found = std::ranges::find(shapes_, shape(start, over, groups));
    if (found != shapes_.end()) return static_cast<uint32_t>(found - shapes_.begin());
    return add(start, over, groups);
  }
  /// A new command.
  uint32_t add(uint32_t start, uint32_t over, GroupCount groups) {
    shapes_.push_back(shape(start, over, groups));
    return count() - 1;
  }
  uint32_t count() const { return static_cast<uint32_t>(shapes_.size()); }
  /// What the device reads: groups in x and y, and in place of z, which is 1, the start and what it is over.
  const std::vector<std::array<uint32_t, 3>>& shapes() const { return shapes_; }
  static constexpr uint64_t offset(uint32_t command) { return uint64_t{command} * 12; }

 private:
  static std::array<uint32_t, 3> shape(uint32_t start, uint32_t over, GroupCount groups) {
    assert(groups[2] <= 1);
    return {groups[0], groups[1], start << 4 | over};
  }
  std::vector<std::array<uint32_t, 3>> shapes_;
};

}  // namespace rill
