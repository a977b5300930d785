#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/options.hpp"
#include "capture/output_folder.hpp"
#include "capture/pose_table.hpp"
#include "capture/video.hpp"
#include "rill/offline.hpp"

namespace rill::capture {

/// What the options ask for of each frame: images, video, particles, meshes, poses.
class FrameFiles {
 public:
  /// `folder`: of all but the video. `first`: number of the first frame. Options and scene outlive it.
  FrameFiles(const Options& options, const Scene& scene, std::filesystem::path folder, double fps, uint32_t first)
      : options_(options), scene_(scene), place_(std::move(folder)), fps_(fps), first_(first) {}

  /// Checks that they can be written, before anything is created.
  Expected<void> check() const;
  Expected<void> create();
  Expected<void> write(uint32_t number, double time_s, offline::Simulation& simulation);

  // At the end of `frames` frames, after a failure, too.
  Expected<void> finishVideo() { return video_ ? video_->finish() : Expected<void>(); }
  Expected<void> writePoses() const;
  /// Writes the lists of frames that ParaView opens; with --resume, frames that an earlier capture left are among them.
  Expected<void> writeSeries(size_t frames) const;

  /// Where the frames and poses are, in messages.
  std::vector<std::string> places(size_t frames) const;
  bool videoFinished() const { return video_ && video_->finished(); }

 private:
  bool usesFolder() const;
  Expected<void> writeImages(uint32_t number, offline::Simulation& simulation);
  Expected<void> writeMesh(uint32_t number, double time_s, offline::Simulation& simulation);
  Expected<void> writeParticles(uint32_t number, double time_s, offline::Simulation& simulation) const;
  Expected<void> writeWhitewater(uint32_t number, double time_s, offline::Simulation& simulation) const;

  const Options& options_;
  const Scene& scene_;
  std::filesystem::path place_;
  double fps_;
  uint32_t first_;
  bool meshWarned_ = false;
  std::unique_ptr<OutputFolder> folder_;
  std::optional<Video> video_;
  std::optional<PoseTable> poses_;
};

}  // namespace rill::capture
