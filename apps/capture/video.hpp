#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include "rill/expected.hpp"
#include "rill/offline.hpp"
#include "shared/atomic_file.hpp"
#include "shared/fed_program.hpp"

namespace rill::capture {

/// Whether a video of this name can be written: it ends in .mp4, .mkv or .mov.
bool isVideoName(const std::filesystem::path& file);

/// The pictures of a run as a video (H.264, yuv420p, BT.709), encoded by the program ffmpeg while the run goes on. A side of an odd number
/// of pixels gets one more, which repeats the last.
class Video {
 public:
  /// BadInput, naming --video, where the file can't be written or ffmpeg is not there. Touches nothing.
  static Expected<void> check(const std::filesystem::path& file);
  /// Pictures of width x height pixels, `fps` a second; makes the file's folder. What is there of that name stays until finish().
  static Expected<Video> start(const std::filesystem::path& file, uint32_t width, uint32_t height, double fps);

  /// Io with ffmpeg's last words where it has ended; there is no video then.
  Expected<void> add(const offline::Image& image);
  /// The file is whole and there from now on, if there was a picture. Io as for add().
  Expected<void> finish();
  bool finished() const { return finished_; }

 private:
  Video(apps::PartFile part, apps::FedProgram encoder) : part_(std::move(part)), encoder_(std::move(encoder)) {}
  Expected<void> ended();

  // In this order: the encoder ends before its file is removed.
  apps::PartFile part_;
  std::optional<apps::FedProgram> encoder_;  ///< none once it has ended
  uint64_t pictures_ = 0;
  bool finished_ = false;
};

}  // namespace rill::capture
