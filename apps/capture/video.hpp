#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include "rill/expected.hpp"
#include "rill/offline.hpp"
#include "shared/atomic_file.hpp"
#include "shared/piped_process.hpp"

namespace rill::capture {

/// True for names that end in .mp4, .mkv or .mov.
bool isVideoName(const std::filesystem::path& file);

/// The images of a run as a video (H.264, yuv420p, BT.709), encoded by the program ffmpeg during the run. An odd width or
/// height is padded by repeating the last column or row.
class Video {
 public:
  /// BadInput where the file cannot be written or ffmpeg is missing. Creates nothing.
  static Expected<void> check(const std::filesystem::path& file);
  /// Starts ffmpeg for images of width x height pixels; creates the file's folder. An existing file stays until finish().
  static Expected<Video> start(const std::filesystem::path& file, uint32_t width, uint32_t height, double fps);

  /// Adds an image. Io with the end of ffmpeg's output where it has exited; then there is no video.
  Expected<void> add(const offline::Image& image);
  /// Completes the file and puts it in its place, if there is at least one image. Io as for add().
  Expected<void> finish();
  bool finished() const { return finished_; }

 private:
  Video(apps::PartFile part, apps::PipedProcess encoder) : part_(std::move(part)), encoder_(std::move(encoder)) {}
  Expected<void> finishEncoder();

  // In this order: the encoder exits before its part file is removed.
  apps::PartFile part_;
  std::optional<apps::PipedProcess> encoder_;  ///< none after it has exited
  uint64_t frames_ = 0;
  bool finished_ = false;
};

}  // namespace rill::capture
