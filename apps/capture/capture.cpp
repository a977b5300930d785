#include "capture/capture.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "capture/frame_files.hpp"
#include "capture/record.hpp"
#include "core/words.hpp"
#include "rill/offline.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/message.hpp"
#include "shared/progress.hpp"
#include "shared/scene_folders.hpp"
#include "shared/signals.hpp"

namespace rill::capture {
namespace fs = std::filesystem;
namespace {

class Capture {
 public:
  explicit Capture(const Options& options)
      : options_(options), progress_(options.quiet ? apps::Progress::Style::Quiet : apps::Progress::styleForTerminal()) {}

  int run() {
    if (const auto scene = readScene(); !scene) return refuse(scene.error());
    if (const auto outputs = checkOutputs(); !outputs) return refuse(outputs.error());
    offline::Options settings = offlineOptions(options_, fps_);
    settings.passTimes = options_.passTimes && (options_.stats || options_.explain);
    auto simulation = resumed_ ? offline::Simulation::resume(scene_, *resumed_, settings) : offline::Simulation::open(scene_, settings);
    if (!simulation) return refuse(resumed_ ? aboutCheckpoint(simulation.error()) : simulation.error());
    simulation_ = std::move(*simulation);
    if (resumed_) resumed_->fluid = {};  // uploaded to the device
    if (rendersImages())
      if (const auto ready = simulation_->prepareRender(options_.view, options_.width, options_.height); !ready)
        return refuse(ready.error());
    if (const int signal = apps::signalReceived()) return 128 + signal;
    if (const auto made = createOutputs(); !made) return refuse(made.error());
    announce();

    record_ = std::make_unique<Record>(simulation_->scene(), simulation_->device(), options_.command, first_ > 0 ? (first_ - 1) / fps_ : 0);
    const Expected<void> ran = runFrames();
    progress_.clear();
    int code = apps::kDone;
    if (!ran) code = fail(ran.error());
    if (ran)
      if (const auto written = writeCheckpoint(); !written) code = fail(written.error());
    // After a failure, too: the figures and the video of the frames so far are complete.
    if (const auto finished = files_->finishVideo(); !finished) code = fail(finished.error());
    if (const auto written = files_->writePoses(); !written) code = fail(written.error());
    if (const auto written = files_->writeSeries(record_->frames()); !written) code = fail(written.error());
    if (const auto written = writeStats(); !written) code = fail(written.error());
    if (const auto written = writeGraph(); !written) code = fail(written.error());
    if (const auto reported = report(); !reported) code = fail(reported.error());
    if (code != apps::kDone) return code;
    if (const int signal = apps::signalReceived(); signal && record_->frames() < frames_) return 128 + signal;
    return checkRequirements();
  }

 private:
  bool rendersImages() const { return options_.images || options_.video; }
  Expected<void> readScene() {
    const auto file = apps::SceneFolders::standard().find(options_.scene);
    if (!file) return file.error();
    auto scene = loadScene(*file, options_.overrides);
    if (!scene) return scene.error();
    scene_ = std::move(*scene);
    if (auto known = checkFigures(options_.requirements, Record::figureNames(scene_)); !known) return known.error();
    if (const auto read = readResumed(); !read) return read.error();
    const double frames = options_.frames ? double(*options_.frames) : frameCount(scene_.duration, fps_) - first_;
    if (frames < 1)
      return Error{ErrorKind::BadInput, "--resume: the checkpoint is of frame " + std::to_string(first_ - 1) +
                                            ", at or after the end of the scene's duration; expected --frames"};
    if (first_ + frames > kMaxFrames)
      return Error{ErrorKind::BadInput, "the scene's duration takes more than " + std::to_string(kMaxFrames) + " frames at " +
                                            shortestNumber(fps_) + " frames/s; expected --frames or a lower --fps"};
    frames_ = static_cast<uint32_t>(frames);
    // A scene's name may contain a folder ("validation/x"), which is kept; the folders of a path are not.
    const bool byName = fs::path(options_.scene) != *file;
    const fs::path out = options_.out ? *options_.out : fs::path("out") / (byName ? fs::path(options_.scene) : fs::path(scene_.name));
    files_.emplace(options_, scene_, out, fps_, first_);
    return {};
  }

  /// Reads the checkpoint of --resume, which gives the number of the first frame and the frame rate.
  Expected<void> readResumed() {
    fps_ = options_.fps;
    if (!options_.resume) return {};
    auto read = offline::loadCheckpoint(*options_.resume);
    if (!read) return aboutResume(read.error());
    if (!(read->fps > 0) || read->frame >= kMaxFrames)
      return aboutResume({ErrorKind::BadInput, inQuotes(options_.resume->string()) +
                                                   ": found a checkpoint without a frame number, expected one that rill-capture wrote"});
    if (options_.fpsGiven && options_.fps != read->fps)
      return Error{ErrorKind::BadInput, "--fps: " + shortestNumber(options_.fps) + " was given; expected " + shortestNumber(read->fps) +
                                            ", the frame rate of the checkpoint"};
    fps_ = read->fps;
    first_ = static_cast<uint32_t>(read->frame + 1);
    resumed_ = std::move(*read);
    return {};
  }

  /// Checks that all outputs can be written, before a device is opened and before anything is created.
  Expected<void> checkOutputs() const {
    if (options_.stats)
      if (auto place = apps::checkFilePlace("--stats", *options_.stats); !place) return place;
    if (options_.graph)
      if (auto place = apps::checkFilePlace("--graph", *options_.graph); !place) return place;
    if (options_.checkpoint)
      if (auto place = apps::checkFilePlace("--checkpoint", *options_.checkpoint); !place) return place;
    return files_->check();
  }

  Expected<void> createOutputs() {
    for (const auto& [option, file] :
         {std::pair{"--stats", &options_.stats}, std::pair{"--graph", &options_.graph}, std::pair{"--checkpoint", &options_.checkpoint}})
      if (*file && !apps::isSpecialFile(**file) && (*file)->has_parent_path())
        if (auto made = apps::makeFolder(option, (*file)->parent_path()); !made) return made;
    return files_->create();
  }

  void announce() {
    if (options_.quiet) return;
    for (const std::string& warning : simulation_->warnings()) message("warning: " + warning);
    message(scene_.name + ": " + grouped(simulation_->start().positions.size()) + " particles, " + grouped(frames_) +
            (frames_ == 1 ? " frame, " : " frames, ") + (resumed_ ? "resumed at " + std::to_string(first_) + ", " : "") +
            simulation_->device().name);
  }

  Expected<void> runFrames() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    Clock::time_point lastCheckpoint = begin;
    for (uint32_t k = 0; k < frames_ && !apps::signalReceived(); ++k) {
      const uint32_t number = first_ + k;
      if (number > 0)
        if (auto ran = simulation_->advance(1.0 / fps_); !ran) return ran;
      const double time_s = number / fps_;
      if (auto written = files_->write(number, time_s, *simulation_); !written) return written;
      auto stats = simulation_->stats();
      if (!stats) return stats.error();
      const double error = stats->densityErrorMean;
      record_->add(time_s, std::move(*stats));
      char about[64];
      std::snprintf(about, sizeof about, "t %.3f s  error %.3f %%", time_s, 100 * error);
      progress_.show({"frame", k + 1, frames_, about, std::chrono::duration<double>(Clock::now() - begin).count()});
      if (options_.checkpointEvery_s &&
          std::chrono::duration<double>(Clock::now() - lastCheckpoint).count() >= *options_.checkpointEvery_s) {
        if (auto written = writeCheckpoint(); !written) return written;
        lastCheckpoint = Clock::now();
      }
    }
    return {};
  }

  /// Writes a checkpoint of the last frame, if --checkpoint is given and it is not written yet.
  Expected<void> writeCheckpoint() {
    const auto frames = static_cast<uint32_t>(record_->frames());
    if (!options_.checkpoint || frames == checkpointed_) return {};
    auto taken = simulation_->checkpoint(first_ + frames - 1, fps_);
    if (!taken) return taken.error();
    if (auto written = apps::writeFile(*options_.checkpoint, offline::encodeCheckpoint(*taken)); !written) return written;
    checkpointed_ = frames;
    return {};
  }

  Expected<void> writeStats() const { return options_.stats ? apps::writeFile(*options_.stats, record_->json()) : Expected<void>(); }

  Expected<void> writeGraph() const {
    if (!options_.graph) return {};
    return apps::writeFile(*options_.graph, options_.images ? simulation_->pictureDot() : simulation_->graphDot());
  }

  /// Prints the table of passes (--explain) and the figures: on standard output, or on standard error where the JSON of
  /// --stats goes to standard output.
  Expected<void> report() const {
    const bool jsonOnStdout = options_.stats && apps::isStandardOutput(*options_.stats);
    std::string text;
    if (options_.explain)
      text = record_->passTable() + record_->sleepText() + offline::memoryTable(simulation_->transientMemory()) +
             offline::readsText(simulation_->device());
    if (!options_.quiet && record_->frames() > 0 && !jsonOnStdout) {
      if (!text.empty()) text += "\n";
      for (const Figure& figure : record_->figures()) {
        char line[128];
        const int unit = static_cast<int>(figure.unit.size());
        if (std::isfinite(figure.value))
          std::snprintf(line, sizeof line, "%-24s %.6g %.*s", figure.name.c_str(), figure.value, unit, figure.unit.data());
        else
          std::snprintf(line, sizeof line, "%-24s -", figure.name.c_str());
        text += line;
        while (text.back() == ' ') text.pop_back();
        text += "\n";
      }
    }
    if (!options_.quiet)
      for (const std::string& place : files_->places(record_->frames())) message(place);
    if (!options_.quiet)
      for (const std::string& warning : record_->warnings()) message(warning);
    if (!options_.quiet && files_->videoFinished()) message("video: " + options_.video->string());
    if (!options_.quiet && checkpointed_ > 0)
      message("checkpoint: " + options_.checkpoint->string() + ", frame " + std::to_string(first_ + checkpointed_ - 1));
    return text.empty() ? Expected<void>() : apps::writeStream(jsonOnStdout ? STDERR_FILENO : STDOUT_FILENO, apps::printable(text));
  }

  int checkRequirements() const {
    const std::vector<std::string> failed = failures(options_.requirements, record_->figures());
    for (const std::string& text : failed) message(text);
    return failed.empty() ? apps::kDone : apps::kRequireFailed;
  }

  static Error aboutResume(const Error& error) { return {error.kind, "--resume: " + error.message}; }
  /// Adds the file name to an error about a checkpoint that does not fit the scene or the device.
  Error aboutCheckpoint(const Error& error) const {
    return error.kind == ErrorKind::BadInput ? aboutResume({error.kind, inQuotes(options_.resume->string()) + ": " + error.message})
                                             : error;
  }
  int refuse(const Error& error) const {
    message(error.message);
    return apps::exitCodeBeforeRun(error);
  }
  int fail(const Error& error) const {
    message(error.message);
    return apps::kFailed;
  }
  void message(const std::string& text) const { apps::printMessage("rill-capture", text); }

  const Options& options_;
  Scene scene_;
  uint32_t frames_ = 0;  // of this run
  uint32_t first_ = 0;   // number of the first one
  double fps_ = 60;
  std::optional<offline::Checkpoint> resumed_;
  uint32_t checkpointed_ = 0;  // frames of this run at the last checkpoint
  apps::Progress progress_;
  std::optional<offline::Simulation> simulation_;
  std::optional<FrameFiles> files_;
  std::unique_ptr<Record> record_;
};

}  // namespace

double frameCount(double duration_s, double fps) {
  // 0.3 * 60 is slightly below 18 in binary: a millionth of a frame of tolerance keeps frame 18.
  return std::floor(duration_s * fps + 1e-6) + 1;
}

int runCapture(const Options& options) { return Capture(options).run(); }

}  // namespace rill::capture
