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

#include "capture/output_folder.hpp"
#include "capture/pose_table.hpp"
#include "capture/record.hpp"
#include "capture/video.hpp"
#include "core/words.hpp"
#include "rill/offline.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/exr.hpp"
#include "shared/mesh_file.hpp"
#include "shared/message.hpp"
#include "shared/pipeline_cache_folder.hpp"
#include "shared/ply.hpp"
#include "shared/png.hpp"
#include "shared/progress.hpp"
#include "shared/scene_folders.hpp"
#include "shared/signals.hpp"
#include "shared/vtk_file.hpp"

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
    offline::Options settings;
    settings.device = options_.device.name;
    settings.deviceOrigin = options_.device.origin;
    settings.reads = options_.reads;
    settings.pipelineCache = apps::pipelineCacheFolder();
    settings.orbit_degPerS = options_.orbit_degPerS;
    settings.exposure_stops = options_.exposure_stops;
    settings.film = options_.film.film(fps_);
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

    if (options_.exportPoses) poses_.emplace(scene_);
    if (poses_ && first_ > 0) poses_->keep(folder_->file("poses.csv"), first_);
    record_ = std::make_unique<Record>(simulation_->scene(), simulation_->device(), options_.command, first_ > 0 ? (first_ - 1) / fps_ : 0);
    const Expected<void> ran = runFrames();
    progress_.clear();
    int code = apps::kDone;
    if (!ran) code = fail(ran.error());
    if (ran)
      if (const auto written = writeCheckpoint(); !written) code = fail(written.error());
    // After a failure, too: the figures and the video of the frames so far are complete.
    if (video_)
      if (const auto finished = video_->finish(); !finished) code = fail(finished.error());
    if (poses_)
      if (const auto written = apps::writeFile(folder_->file("poses.csv"), poses_->text()); !written) code = fail(written.error());
    if (const auto written = writeSeries(); !written) code = fail(written.error());
    if (const auto written = writeStats(); !written) code = fail(written.error());
    if (const auto written = writeGraph(); !written) code = fail(written.error());
    if (const auto reported = report(); !reported) code = fail(reported.error());
    if (code != apps::kDone) return code;
    if (const int signal = apps::signalReceived(); signal && record_->frames() < frames_) return 128 + signal;
    return checkRequirements();
  }

 private:
  bool rendersImages() const { return options_.images || options_.video; }
  bool writesFrames() const {
    return options_.images || options_.exportPly || options_.exportMesh || options_.exportVtk || options_.exportPoses;
  }

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
    out_ = options_.out ? *options_.out : fs::path("out") / (byName ? fs::path(options_.scene) : fs::path(scene_.name));
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
    if (options_.video)
      if (auto valid = Video::check(*options_.video); !valid) return valid;
    return writesFrames() ? apps::checkFolderPlace("--out", out_) : Expected<void>();
  }

  Expected<void> createOutputs() {
    for (const auto& [option, file] :
         {std::pair{"--stats", &options_.stats}, std::pair{"--graph", &options_.graph}, std::pair{"--checkpoint", &options_.checkpoint}})
      if (*file && !apps::isSpecialFile(**file) && (*file)->has_parent_path())
        if (auto made = apps::makeFolder(option, (*file)->parent_path()); !made) return made;
    if (writesFrames()) {
      auto folder = OutputFolder::prepare(out_, options_.resume.has_value());
      if (!folder) return folder.error();
      folder_ = std::make_unique<OutputFolder>(std::move(*folder));
    }
    if (options_.video) {
      auto video = Video::start(*options_.video, options_.width, options_.height, fps_);
      if (!video) return video.error();
      video_.emplace(*std::move(video));
    }
    return {};
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
      if (auto written = writeFrame(number, time_s); !written) return written;
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

  Expected<void> writeFrame(uint32_t k, double time_s) {
    if (options_.exr) {
      auto image = simulation_->renderLinear(options_.width, options_.height);
      if (!image) return image.error();
      if (auto written = apps::writeExr(folder_->frame(k, "exr"), *image); !written) return written;
    }
    if (options_.video || (options_.images && !options_.exr)) {
      auto image = simulation_->render(options_.view, options_.width, options_.height);
      if (!image) return image.error();
      if (options_.images && !options_.exr)
        if (auto written = apps::writePng(folder_->frame(k, "png"), *image); !written) return written;
      if (video_)
        if (auto added = video_->add(*image); !added) return added;
    }
    if (poses_)
      if (auto added = poses_->add(k, time_s, *simulation_); !added) return added;
    if (auto written = writeMesh(k, time_s); !written || !(options_.exportPly || options_.exportVtk)) return written;
    auto particles = simulation_->particles();
    if (!particles) return particles.error();
    if (options_.exportPly)
      if (auto written = apps::writePly(folder_->frame(k, "ply"), *particles, time_s); !written) return written;
    if (auto written = writeWhitewater(k, time_s); !written) return written;
    return options_.exportVtk ? apps::writeFile(folder_->frame(k, "vtu"), apps::encodeVtu(*particles, time_s)) : Expected<void>();
  }

  /// Beside the particles, where the scene has whitewater.
  Expected<void> writeWhitewater(uint32_t k, double time_s) {
    if (!options_.exportPly || !scene_.look.whitewater) return {};
    auto particles = simulation_->whitewater();
    if (!particles) return particles.error();
    return apps::writeFile(folder_->frame(k, "whitewater.ply"), apps::encodeWhitewaterPly(*particles, time_s));
  }

  Expected<void> writeMesh(uint32_t k, double time_s) {
    if (!options_.exportMesh) return {};
    auto mesh = simulation_->mesh(options_.meshCell);
    if (!mesh) return mesh.error();
    if (mesh->tooFar > 0 && !meshWarned_) {
      message("warning: frame " + std::to_string(k) + ": " + grouped(mesh->tooFar) + " particles are too far away to be in the mesh");
      meshWarned_ = true;
    }
    auto bytes = apps::encodeMesh(*mesh, time_s, options_.meshFormat);
    if (!bytes) return bytes.error();
    return apps::writeFile(folder_->frame(k, apps::meshExtension(options_.meshFormat)), *bytes);
  }

  /// Writes the lists of frames that ParaView opens; with --resume, frames that an earlier capture left are among them.
  Expected<void> writeSeries() const {
    const auto write = [&](bool wanted, const char* name, const char* extension) -> Expected<void> {
      if (!wanted) return {};
      std::vector<std::pair<double, std::string>> files;
      for (uint32_t k = 0; k < first_ + static_cast<uint32_t>(record_->frames()); ++k) {
        std::error_code ignored;
        const fs::path file = folder_->frame(k, extension);
        if (k >= first_ || fs::exists(file, ignored)) files.emplace_back(k / fps_, file.filename().string());
      }
      return apps::writeFile(folder_->file(name), apps::encodePvd(files));
    };
    if (auto written = write(options_.exportVtk, "particles.pvd", "vtu"); !written) return written;
    return write(options_.exportMesh && options_.meshFormat == apps::MeshFormat::Vtp, "mesh.pvd", "mesh.vtp");
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
    const bool particles = options_.exportPly || options_.exportVtk;
    if (!options_.quiet && (options_.images || particles || options_.exportMesh) && record_->frames() > 0) {
      const auto last = static_cast<uint32_t>(first_ + record_->frames() - 1);
      const char* kind = options_.exr          ? "exr"
                         : options_.images     ? "png"
                         : options_.exportPly  ? "ply"
                         : options_.exportMesh ? apps::meshExtension(options_.meshFormat)
                                               : "vtu";
      message("frames: " + folder_->frame(first_, kind).string() +
              (last > first_ ? " to " + folder_->frame(last, kind).filename().string() : ""));
    }
    if (!options_.quiet && poses_) message("poses: " + folder_->file("poses.csv").string());
    if (!options_.quiet)
      for (const std::string& warning : record_->warnings()) message(warning);
    if (!options_.quiet && video_ && video_->finished()) message("video: " + options_.video->string());
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
  fs::path out_;
  uint32_t frames_ = 0;  // of this run
  uint32_t first_ = 0;   // number of the first one
  double fps_ = 60;
  std::optional<offline::Checkpoint> resumed_;
  bool meshWarned_ = false;
  uint32_t checkpointed_ = 0;  // frames of this run at the last checkpoint
  apps::Progress progress_;
  std::optional<offline::Simulation> simulation_;
  std::unique_ptr<OutputFolder> folder_;
  std::optional<Video> video_;
  std::optional<PoseTable> poses_;
  std::unique_ptr<Record> record_;
};

}  // namespace

double frameCount(double duration_s, double fps) {
  // 0.3 * 60 is slightly below 18 in binary: a millionth of a frame of tolerance keeps frame 18.
  return std::floor(duration_s * fps + 1e-6) + 1;
}

int runCapture(const Options& options) { return Capture(options).run(); }

}  // namespace rill::capture
