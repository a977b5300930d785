#include "view/message_box.hpp"

#include "shared/message.hpp"

namespace rill::view {
namespace {

constexpr double kNotice = 4;  // s

}  // namespace

void MessageBox::show(const std::string& text) {
  text_ = apps::printable(text);
  noticeUntil_s_.reset();
}

void MessageBox::showNotice(const std::string& text) {
  show(text);
  noticeUntil_s_ = now_s_ + kNotice;
}

Expected<void> MessageBox::report(const Expected<void>& done, const std::string& notice) {
  if (done) {
    if (!notice.empty()) showNotice(notice);
    return {};
  }
  const ErrorKind kind = done.error().kind;
  if (kind == ErrorKind::DeviceLost || kind == ErrorKind::Failed) return done;
  show(done.error().message);
  return {};
}

void MessageBox::update(double now_s) {
  now_s_ = now_s;
  if (noticeUntil_s_ && now_s_ > *noticeUntil_s_) show("");
}

}  // namespace rill::view
