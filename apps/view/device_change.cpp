#include "view/device_change.hpp"

#include <chrono>
#include <cstdio>
#include <thread>

#include "view/log_error.hpp"

namespace rill::view {

void DeviceChange::close() {
  shown_.release();
  graphics_.close();
}

Expected<void> DeviceChange::reopen(const std::string& device) {
  if (auto opened = graphics_.reopen(device); !opened) return opened;
  return shown_.resume();
}

Expected<void> DeviceChange::change(const std::string& device) {
  if (auto kept = shown_.session().keep(); !kept) return kept;
  graphics_.logValidationMessages();
  Expected<void> changed;
  for (const std::string& next : {device, device_}) {
    close();
    const auto opened = reopen(next);
    if (changed) changed = opened;
    if (!opened) continue;
    device_ = next;
    message_.show(changed ? "The simulation continues on " + graphics_.deviceName() : changed.error().message);
    return {};
  }
  return changed;
}

Expected<void> DeviceChange::recover(const Error& lost, double now_s) {
  constexpr double kTooSoon = 10;  // s; what caused the first loss is likely to cause the next
  if (lostAt_s_ && now_s - *lostAt_s_ < kTooSoon) return Error{lost.kind, lost.message + "; it was lost a moment before, too"};
  lostAt_s_ = now_s;
  graphics_.logValidationMessages();
  close();
  Expected<void> opened = lost;
  for (int tries = 0; !opened && tries < 5; ++tries) {  // a driver that resets its device needs a moment
    if (tries > 0) std::this_thread::sleep_for(std::chrono::seconds(1));
    opened = reopen(device_);
    if (!opened) close();
  }
  if (!opened) return Error{opened.error().kind, lost.message + "\nno new device: " + opened.error().message};
  char from[64];
  std::snprintf(from, sizeof from, "%.4g s", shown_.session().runner().time_s());
  const std::string notice = lost.message + "\nThe simulation continues on " + graphics_.deviceName() + " from " + from;
  logError(notice);
  message_.show(notice);
  return {};
}

}  // namespace rill::view
