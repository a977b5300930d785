#include "capture/playback.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "capture/output_folder.hpp"
#include "capture/record.hpp"
#include "capture/video.hpp"
#include "core/words.hpp"
#include "fill/ply_reader.hpp"
#include "rill/player.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/exr.hpp"
#include "shared/message.hpp"
#include "shared/ply.hpp"
#include "shared/png.hpp"
#include "shared/progress.hpp"
#include "shared/scene_folders.hpp"
#include "shared/signals.hpp"

namespace rill::capture {
namespace fs = std::filesystem;
namespace {

void message(const std::string& text) { apps::printMessage("rill-capture", text); }

struct FrameFile {
  fs::path particles;
  std::optional<fs::path> whitewater = {};  ///< the file beside it, of the same name
};

fs::path whitewaterOf(const fs::path& particles) { return fs::path(particles).replace_extension("whitewater.ply"); }

/// DIR/*.ply in order of their names, without meshes, at most `most`. Unless `quiet`, says where whitewater is not drawn.
Expected<std::vector<FrameFile>> filesIn(const fs::path& folder, const Scene& scene, std::optional<uint32_t> most, bool quiet) {
  std::error_code error;
  std::vector<FrameFile> frames;
  std::set<fs::path> whitewater;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().string();
    if (name.ends_with(".whitewater.ply"))
      whitewater.insert(at->path());
    else if (name.ends_with(".ply") && !name.ends_with(".mesh.ply"))
      frames.push_back({at->path()});
  }
  if (error) return Error{ErrorKind::BadInput, "--play: cannot read the folder " + inQuotes(folder.string()) + ": " + error.message()};
  if (frames.empty())
    return Error{ErrorKind::BadInput, "--play: " + inQuotes(folder.string()) + " contains no .ply file; expected a folder of frames"};
  std::ranges::sort(frames, {}, &FrameFile::particles);
  if (most && *most < frames.size()) frames.resize(*most);
  size_t found = 0;
  const FrameFile* without = nullptr;
  for (FrameFile& frame : frames) {
    const bool has = whitewater.contains(whitewaterOf(frame.particles));
    found += has;
    if (has && scene.look.whitewater) frame.whitewater = whitewaterOf(frame.particles);
    if (!has && !without) without = &frame;
  }
  if (found > 0 && !scene.look.whitewater && !quiet)
    message("warning: --play: whitewater (" + grouped(found) +
            " of .whitewater.ply) is not drawn: look.whitewater is false (--set rill=0.2 look.whitewater=true)");
  else if (found > 0 && without && !quiet)
    message("warning: --play: " + inQuotes(without->particles.string()) + " has no .whitewater.ply beside it: there drops are white");
  return frames;
}

/// The particles of a file, relative to the first one to keep precision far from the origin.
/// `warned`: says once where a file has no velocities; null: nothing needs them.
Expected<offline::PlayedFrame> readFrame(const FrameFile& file, const Scene& scene, bool* warned) {
  const auto refused = [](const Error& error) { return Error{error.kind, "--play: " + error.message}; };
  auto opened = PlyFile::open(file.particles, scene.fluids.size(), diffusingFluids(scene));
  if (!opened) return refused(opened.error());
  auto particles = opened->read();
  if (!particles) return refused(particles.error());
  if (warned && !*warned && particles->velocities.empty() && !particles->positions.empty()) {
    message("warning: --shutter: " + inQuotes(file.particles.string()) +
            " has no velocities (vx, vy, vz): its fluid is drawn without motion blur");
    *warned = true;
  }
  offline::PlayedFrame frame;
  if (!particles->positions.empty()) frame.origin = particles->positions.front();
  frame.positions.reserve(particles->positions.size());
  for (const Double3& p : particles->positions)
    frame.positions.push_back(
        {static_cast<float>(p.x - frame.origin.x), static_cast<float>(p.y - frame.origin.y), static_cast<float>(p.z - frame.origin.z)});
  frame.velocities = std::move(particles->velocities);
  frame.fluids = std::move(particles->fluids);
  frame.concentrations = std::move(particles->concentrations);
  if (!file.whitewater) return frame;
  auto whitewater = apps::readWhitewaterPly(*file.whitewater);
  if (!whitewater) return refused(whitewater.error());
  frame.whitewater = *std::move(whitewater);
  return frame;
}

class Playback {
 public:
  explicit Playback(const Options& options) : options_(options), withoutVelocities_(options.quiet) {}

  /// Reads the scene, finds the files and opens what is written. Nothing is written before all of it is possible.
  Expected<void> prepare() {
    const auto found = apps::SceneFolders::standard().find(options_.scene);
    if (!found) return found.error();
    auto scene = loadScene(*found, options_.overrides);
    if (!scene) return scene.error();
    auto files = filesIn(*options_.play, *scene, options_.frames, options_.quiet);
    if (!files) return files.error();
    files_ = *std::move(files);
    const bool byName = fs::path(options_.scene) != *found;
    const fs::path out = options_.out ? *options_.out : fs::path("out") / (byName ? fs::path(options_.scene) : fs::path(scene->name));
    if (auto places = checkPlaces(out); !places) return places;

    auto player = offline::Player::open(*std::move(scene), offlineOptions(options_, options_.fps));
    if (!player) return player.error();
    player_.emplace(*std::move(player));
    if (auto ready = player_->prepareRender(options_.view, options_.width, options_.height); !ready) return ready;
    return openOutputs(out);
  }

  /// Draws all frames. Returns the exit code.
  int run() {
    apps::Progress progress(options_.quiet ? apps::Progress::Style::Quiet : apps::Progress::styleForTerminal());
    const auto count = static_cast<uint32_t>(files_.size());
    if (!options_.quiet)
      message(player_->scene().name + ": " + grouped(count) + (count == 1 ? " frame" : " frames") + " of " +
              inQuotes(options_.play->string()) + ", " + player_->device().name);
    const auto begin = std::chrono::steady_clock::now();
    uint32_t done = 0;
    int code = apps::kDone;
    for (; done < count && !apps::signalReceived(); ++done) {
      if (auto drawn = draw(done); !drawn) {
        progress.clear();
        message(drawn.error().message);
        code = drawn.error().kind == ErrorKind::BadInput ? apps::kBadInput : apps::kFailed;
        break;
      }
      const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      progress.show({"frame", done + 1, count, apps::printable(files_[done].particles.filename().string()), spent});
    }
    progress.clear();
    if (auto finished = finish(); !finished) code = apps::kFailed;
    if (!options_.quiet) summarize(code == apps::kDone ? done : 0);
    if (code != apps::kDone) return code;
    const int signal = apps::signalReceived();
    return signal && done < count ? 128 + signal : apps::kDone;
  }

 private:
  Expected<void> checkPlaces(const fs::path& out) const {
    std::error_code ignored;
    if (options_.images && fs::equivalent(out, *options_.play, ignored))
      return Error{ErrorKind::BadInput, "--out: " + inQuotes(out.string()) + " is the folder that --play reads; expected another folder"};
    if (options_.images)
      if (auto place = apps::checkFolderPlace("--out", out); !place) return place;
    if (options_.graph)
      if (auto place = apps::checkFilePlace("--graph", *options_.graph); !place) return place;
    return options_.video ? Video::check(*options_.video) : Expected<void>();
  }

  Expected<void> openOutputs(const fs::path& out) {
    if (options_.images) {
      auto prepared = OutputFolder::prepare(out, false);
      if (!prepared) return prepared.error();
      folder_.emplace(*std::move(prepared));
    }
    if (options_.graph && !apps::isSpecialFile(*options_.graph) && options_.graph->has_parent_path())
      if (auto made = apps::makeFolder("--graph", options_.graph->parent_path()); !made) return made;
    if (!options_.video) return {};
    auto started = Video::start(*options_.video, options_.width, options_.height, options_.fps);
    if (!started) return started.error();
    video_.emplace(*std::move(started));
    return {};
  }

  Expected<void> draw(uint32_t k) {
    auto read = readFrame(files_[k], player_->scene(), options_.film.shutter_deg > 0 ? &withoutVelocities_ : nullptr);
    if (!read) return read.error();
    read->time_s = k / options_.fps;
    if (auto shown = player_->show(*read); !shown) return shown;
    if (options_.exr) {
      auto image = player_->renderLinear(options_.width, options_.height);
      if (!image) return image.error();
      boundHits_ += player_->boundHits();
      if (auto written = apps::writeExr(folder_->frame(k, "exr"), *image); !written || !video_) return written;
    }
    auto image = player_->render(options_.view, options_.width, options_.height);
    if (!image) return image.error();
    boundHits_ += player_->boundHits();
    if (folder_ && !options_.exr)
      if (auto written = apps::writePng(folder_->frame(k, "png"), *image); !written) return written;
    return video_ ? video_->add(*image) : Expected<void>();
  }

  /// After a failure, too: the video of the frames so far is complete. Says what fails.
  Expected<void> finish() {
    Expected<void> result;
    const auto keep = [&](Expected<void> step) {
      if (step) return;
      message(step.error().message);
      result = std::move(step);
    };
    if (video_) keep(video_->finish());
    if (options_.graph) keep(apps::writeFile(*options_.graph, player_->pictureDot()));
    return result;
  }

  /// Where the frames and the video are. `frames`: written, of a run without an error.
  void summarize(uint32_t frames) const {
    const char* kind = options_.exr ? "exr" : "png";
    if (folder_ && frames > 0)
      message("frames: " + folder_->frame(0, kind).string() +
              (frames > 1 ? " to " + folder_->frame(frames - 1, kind).filename().string() : ""));
    if (video_ && video_->finished()) message("video: " + options_.video->string());
    if (boundHits_ > 0) message(boundHitsWarning(boundHits_));
  }

  const Options& options_;
  std::vector<FrameFile> files_;
  std::optional<offline::Player> player_;
  std::optional<OutputFolder> folder_;
  std::optional<Video> video_;
  uint64_t boundHits_ = 0;
  bool withoutVelocities_;  ///< the warning of a file without velocities was printed, or is not wanted
};

}  // namespace

int runPlayback(const Options& options) {
  Playback playback(options);
  if (auto ready = playback.prepare(); !ready) {
    message(ready.error().message);
    return apps::exitCodeBeforeRun(ready.error());
  }
  return playback.run();
}

}  // namespace rill::capture
