#pragma once
// Detects that a file was modified.
#include <filesystem>
#include <system_error>

namespace rill::view {

class FileWatch {
 public:
  explicit FileWatch(std::filesystem::path file) : file_(std::move(file)) { acknowledge(); }
  const std::filesystem::path& file() const { return file_; }
  /// Marks the current version as seen.
  void acknowledge() { read_ = written(); }
  /// True where the file has changed since acknowledge(); checked at most twice per second of `now_s`. A missing file, as
  /// while it is being replaced, counts as unchanged.
  bool changed(double now_s) {
    if (now_s - checked_s_ < 0.5) return false;
    checked_s_ = now_s;
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
  double checked_s_ = 0;
};

}  // namespace rill::view
