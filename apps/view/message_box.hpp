#pragma once
// The message over the image: an error until the user closes it, a notice for a few seconds.
#include <optional>
#include <string>

#include "rill/expected.hpp"

namespace rill::view {

class MessageBox {
 public:
  /// Shows `text` until it is closed or replaced; nothing where it is empty.
  void show(const std::string& text);
  void showNotice(const std::string& text);
  /// Shows the error of `done`, else `notice` unless it is empty. Returns errors of the device, which end the program.
  Expected<void> report(const Expected<void>& done, const std::string& notice = {});
  /// Call in each frame: removes a notice after its time. `now_s`: real time.
  void update(double now_s);

  std::string& text() { return text_; }  ///< empty: nothing is shown

 private:
  std::string text_;
  double now_s_ = 0;
  std::optional<double> noticeUntil_s_;
};

}  // namespace rill::view
