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
#include "shared/pipeline_cache_folder.hpp"
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

}  // namespace

int runPlayback(const Options& options) {
  const auto refuse = [](const Error& error) {
    message(error.message);
    return apps::exitCodeBeforeRun(error);
  };
  const auto found = apps::SceneFolders::standard().find(options.scene);
  if (!found) return refuse(found.error());
  auto scene = loadScene(*found, options.overrides);
  if (!scene) return refuse(scene.error());
  auto files = filesIn(*options.play, *scene, options.frames, options.quiet);
  if (!files) return refuse(files.error());
  const bool byName = fs::path(options.scene) != *found;
  const fs::path out = options.out ? *options.out : fs::path("out") / (byName ? fs::path(options.scene) : fs::path(scene->name));
  std::error_code ignored;
  if (options.images && fs::equivalent(out, *options.play, ignored))
    return refuse({ErrorKind::BadInput, "--out: " + inQuotes(out.string()) + " is the folder that --play reads; expected another folder"});
  if (options.images)
    if (auto place = apps::checkFolderPlace("--out", out); !place) return refuse(place.error());
  if (options.graph)
    if (auto place = apps::checkFilePlace("--graph", *options.graph); !place) return refuse(place.error());
  if (options.video)
    if (auto valid = Video::check(*options.video); !valid) return refuse(valid.error());

  offline::Options settings;
  settings.device = options.device.name;
  settings.deviceOrigin = options.device.origin;
  settings.reads = options.reads;
  settings.pipelineCache = apps::pipelineCacheFolder();
  settings.orbit_degPerS = options.orbit_degPerS;
  settings.exposure_stops = options.exposure_stops;
  settings.film = options.film.film(options.fps);
  auto player = offline::Player::open(*std::move(scene), settings);
  if (!player) return refuse(player.error());
  if (auto ready = player->prepareRender(options.view, options.width, options.height); !ready) return refuse(ready.error());
  std::optional<OutputFolder> folder;
  if (options.images) {
    auto prepared = OutputFolder::prepare(out, false);
    if (!prepared) return refuse(prepared.error());
    folder.emplace(*std::move(prepared));
  }
  if (options.graph && !apps::isSpecialFile(*options.graph) && options.graph->has_parent_path())
    if (auto made = apps::makeFolder("--graph", options.graph->parent_path()); !made) return refuse(made.error());
  std::optional<Video> video;
  if (options.video) {
    auto started = Video::start(*options.video, options.width, options.height, options.fps);
    if (!started) return refuse(started.error());
    video.emplace(*std::move(started));
  }
  apps::Progress progress(options.quiet ? apps::Progress::Style::Quiet : apps::Progress::styleForTerminal());
  const auto count = static_cast<uint32_t>(files->size());
  if (!options.quiet)
    message(player->scene().name + ": " + grouped(count) + (count == 1 ? " frame" : " frames") + " of " + inQuotes(options.play->string()) +
            ", " + player->device().name);
  const auto begin = std::chrono::steady_clock::now();
  uint64_t hits = 0;
  bool warned = options.quiet;
  const auto frame = [&](uint32_t k) -> Expected<void> {
    auto read = readFrame((*files)[k], player->scene(), options.film.shutter_deg > 0 ? &warned : nullptr);
    if (!read) return read.error();
    read->time_s = k / options.fps;
    if (auto shown = player->show(*read); !shown) return shown;
    if (options.exr) {
      auto image = player->renderLinear(options.width, options.height);
      if (!image) return image.error();
      hits += player->boundHits();
      if (auto written = apps::writeExr(folder->frame(k, "exr"), *image); !written || !video) return written;
    }
    auto image = player->render(options.view, options.width, options.height);
    if (!image) return image.error();
    hits += player->boundHits();
    if (folder && !options.exr)
      if (auto written = apps::writePng(folder->frame(k, "png"), *image); !written) return written;
    return video ? video->add(*image) : Expected<void>();
  };
  uint32_t done = 0;
  int code = apps::kDone;
  for (; done < count && !apps::signalReceived(); ++done) {
    if (auto drawn = frame(done); !drawn) {
      progress.clear();
      message(drawn.error().message);
      code = drawn.error().kind == ErrorKind::BadInput ? apps::kBadInput : apps::kFailed;
      break;
    }
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    progress.show({"frame", done + 1, count, apps::printable((*files)[done].particles.filename().string()), spent});
  }
  progress.clear();
  if (video)  // after a failure, too: the video of the frames so far is complete
    if (auto finished = video->finish(); !finished) {
      message(finished.error().message);
      code = apps::kFailed;
    }
  if (options.graph)
    if (auto written = apps::writeFile(*options.graph, player->pictureDot()); !written) {
      message(written.error().message);
      code = apps::kFailed;
    }
  const char* kind = options.exr ? "exr" : "png";
  if (!options.quiet && folder && done > 0 && code == apps::kDone)
    message("frames: " + folder->frame(0, kind).string() + (done > 1 ? " to " + folder->frame(done - 1, kind).filename().string() : ""));
  if (!options.quiet && video && video->finished()) message("video: " + options.video->string());
  if (hits > 0 && !options.quiet) message(boundHitsWarning(hits));
  if (code != apps::kDone) return code;
  const int signal = apps::signalReceived();
  return signal && done < count ? 128 + signal : apps::kDone;
}

}  // namespace rill::capture
