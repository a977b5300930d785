#pragma once
// Whether a file was written anew.
#include <filesystem>
#include <system_error>

namespace rill::view {

class FileWatch {
 public:
  explicit FileWatch(std::filesystem::path file) : file_(std::move(file)) { noted(); }
  const std::filesystem::path& file() const { return file_; }
  /// What there is now is known.
  void noted() { read_ = written(); }
  /// Whether there is another than the one that is known (asked at most twice a second of `now_s`). One that is gone, as while it is being
  /// replaced, is looked at again later.
  bool changed(double now_s) {
    if (now_s - asked_s_ < 0.5) return false;
    asked_s_ = now_s;
    return written() != read_;
  }

 private:
  std::filesystem::file_time_type written() const {
    std::error_code missing;
    const auto time = std::filesystem::last_write_time(file_, missing);
    return missing ? read_ : time;
  }

  std::filesystem::path file_;
  std::filesystem::file_time_type read_{};
  double asked_s_ = 0;
};

}  // namespace rill::view
