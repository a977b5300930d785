#pragma once
// An environment on the device.
#include <memory>
#include <optional>

#include "gpu/resources.hpp"
#include "rill/environment.hpp"
#include "rill/float3.hpp"
#include "rill/graph.hpp"

namespace rill {

class Environment {
 public:
  /// BadInput for a picture of another size than it says or may be, OutOfMemory.
  static Expected<std::unique_ptr<Environment>> create(Device& device, const EnvironmentPicture& picture);

  /// The texels, for the passes of one frame; with a pass before that copies them until a frame that did has completed.
  BufferRef addTo(Graph& graph);

  uint32_t width() const { return width_; }
  uint32_t height() const { return width_ / 2; }
  /// What a white surface that looks straight up, and one that looks down, gets of its light.
  Float3 above() const { return above_; }
  Float3 below() const { return below_; }

 private:
  explicit Environment(DeviceImpl& device) : device_(device) {}

  DeviceImpl& device_;
  uint32_t width_ = 0;
  Float3 above_, below_;
  Buffer texels_, staging_;         // staging_: none once it has been copied
  std::optional<uint64_t> copied_;  // the frame that was recorded with the copy first
};

}  // namespace rill
