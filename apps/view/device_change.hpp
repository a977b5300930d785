#pragma once
// Continues the simulation on another device, where the user chooses one or the current one is lost.
#include <optional>
#include <string>

#include "view/graphics.hpp"
#include "view/message_box.hpp"
#include "view/shown_scene.hpp"

namespace rill::view {

class DeviceChange {
 public:
  /// `device`: the open one, as ContextDesc::device. The others must outlive it.
  DeviceChange(std::string device, Graphics& graphics, ShownScene& shown, MessageBox& message)
      : device_(std::move(device)), graphics_(graphics), shown_(shown), message_(message) {}

  /// Continues on `device`, or on the same one where that fails.
  Expected<void> change(const std::string& device);
  /// Opens the lost device again, or the one that is there in its place, and continues from the last snapshot. An error ends the
  /// program. `now_s`: real time.
  Expected<void> recover(const Error& lost, double now_s);

 private:
  void close();
  Expected<void> reopen(const std::string& device);

  std::string device_;
  Graphics& graphics_;
  ShownScene& shown_;
  MessageBox& message_;
  std::optional<double> lostAt_s_;  // the last loss
};

}  // namespace rill::view
