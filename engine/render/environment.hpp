#pragma once
// An environment map on the device.
#include <memory>
#include <optional>

#include "gpu/resources.hpp"
#include "rill/environment.hpp"
#include "rill/graph.hpp"
#include "rill/vectors.hpp"

namespace rill {

class Environment {
 public:
  /// BadInput if the number of texels does not match the size or the size is not allowed; OutOfMemory.
  static Expected<std::unique_ptr<Environment>> create(Device& device, EnvironmentPicture picture);

  /// The texels of all levels, for the passes of one frame. Until a frame with the copy has completed, a pass copies them.
  BufferRef addTo(Graph& graph);

  uint32_t width() const { return width_; }
  uint32_t height() const { return width_ / 2; }
  /// Radiance reflected by a white surface that faces up, and by one that faces down, without the sun's light.
  Float3 above() const { return above_; }
  Float3 below() const { return below_; }
  /// The sun, whose disc is not in the texels.
  const std::optional<EnvironmentSun>& sun() const { return sun_; }

 private:
  explicit Environment(DeviceImpl& device) : device_(device) {}

  DeviceImpl& device_;
  uint32_t width_ = 0;
  Float3 above_, below_;
  std::optional<EnvironmentSun> sun_;
  Buffer texels_, staging_;         // staging_: released after the copy
  std::optional<uint64_t> copied_;  // the first frame recorded with the copy
};

}  // namespace rill
