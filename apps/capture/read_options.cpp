// The values of options that were typed as text.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "capture/raw_options.hpp"
#include "capture/video.hpp"
#include "core/words.hpp"
#include "rill/offline.hpp"
#include "shared/atomic_file.hpp"
#include "shared/device_option.hpp"
#include "shared/exr.hpp"
#include "shared/option_text.hpp"
#include "shared/usage.hpp"

namespace rill::capture {
namespace {

using apps::badInput, apps::numberIn;

constexpr uint32_t kMaxSide = 8192;          // pixels
constexpr uint64_t kMaxPixels = 1ull << 25;  // an image is one buffer of 128 MiB, which every device has

/// True where both name the same file, which need not exist.
bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  const auto whole = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
  };
  return whole(a) == whole(b);
}

/// Reads the options group by group. The first that is invalid is refused with what was found and what was expected.
class OptionReader {
 public:
  OptionReader(const RawOptions& raw, const CLI::App& app) : raw_(raw), app_(app) {}

  Expected<Options> read() {
    for (const auto group :
         {&OptionReader::readFrames, &OptionReader::readPicture, &OptionReader::readLight, &OptionReader::readExports,
          &OptionReader::readParticles, &OptionReader::readOutputs, &OptionReader::readCheckpoint, &OptionReader::readVideo,
          &OptionReader::readResume, &OptionReader::readPlay, &OptionReader::readDevice, &OptionReader::readAssignments})
      if (auto done = (this->*group)(); !done) return done.error();
    options_.explain = raw_.explain;
    options_.images = !raw_.noImages;
    options_.passTimes = !raw_.noPassTimes;
    options_.quiet = raw_.quiet;
    return std::move(options_);
  }

 private:
  bool given(const char* name) const { return app_.count(name) > 0; }
  std::optional<std::string> ifGiven(const char* name, const std::string& text) const {
    return given(name) ? std::optional(text) : std::nullopt;
  }

  Expected<void> readFrames() {
    options_.scene = raw_.scene;
    if (raw_.scene.empty()) return badInput("SCENE", raw_.scene, "a scene's name or the path of a .json file");
    if (given("--frames")) {
      options_.frames = numberIn<uint32_t>(raw_.frames);
      if (!options_.frames || *options_.frames < 1 || *options_.frames > kMaxFrames)
        return badInput("--frames", raw_.frames, "a whole number from 1 to " + std::to_string(kMaxFrames));
    }
    if (given("--fps")) {
      const auto fps = numberIn<double>(raw_.fps);
      if (!fps || !(*fps >= 0.001 && *fps <= 1e6)) return badInput("--fps", raw_.fps, "a number from 0.001 to 1000000");
      options_.fps = *fps;
      options_.fpsGiven = true;
    }
    return {};
  }

  Expected<void> readPicture() {
    if (given("--size")) {
      const auto size = apps::pixelSizeIn(raw_.size, 1, kMaxSide);
      if (!size || uint64_t{size->width} * size->height > kMaxPixels)
        return badInput("--size", raw_.size,
                        "WIDTHxHEIGHT in pixels, as 1280x720: each from 1 to " + std::to_string(kMaxSide) + ", together at most " +
                            std::to_string(kMaxPixels));
      options_.width = size->width;
      options_.height = size->height;
    }
    if (given("--view")) {
      if (auto known = apps::checkView(raw_.view); !known) return known.error();
      options_.view = raw_.view;
    }
    if (auto possible = offline::Simulation::checkPicture(options_.view, options_.width, options_.height); !possible)
      return Error{ErrorKind::BadInput, "--size, --view " + options_.view + ": " + possible.error().message};
    if (given("--orbit")) {
      const auto orbit = numberIn<double>(raw_.orbit);
      if (!orbit || !(std::abs(*orbit) <= 36000)) return badInput("--orbit", raw_.orbit, "a number of degrees from -36000 to 36000");
      options_.orbit_degPerS = *orbit;
    }
    return {};
  }

  Expected<void> readLight() {
    if (given("--exposure")) {
      const auto stops = apps::exposureIn(raw_.exposure);
      if (!stops) return stops.error();
      if (options_.view != "final")
        return Error{ErrorKind::BadInput, "--exposure: the view " + options_.view + " has none; expected --view final"};
      if (raw_.noImages && !given("--video"))
        return Error{ErrorKind::BadInput, "--exposure: found --no-images without --video; expected images to expose"};
      options_.exposure_stops = *stops;
    }
    auto film = filmOptions({.samples = ifGiven("--samples", raw_.samples),
                             .shutter = ifGiven("--shutter", raw_.shutter),
                             .aperture = ifGiven("--aperture", raw_.aperture),
                             .focus = ifGiven("--focus", raw_.focus)},
                            options_.view, !raw_.noImages || given("--video"));
    if (!film) return film.error();
    options_.film = *film;
    if (raw_.exr) {
      if (!apps::writesExr())
        return Error{ErrorKind::BadInput, "--exr: this rill-capture was built without OpenEXR; expected a build with it"};
      if (options_.view != "final")
        return Error{ErrorKind::BadInput, "--exr: the view " + options_.view + " is not linear light; expected --view final"};
      if (raw_.noImages) return Error{ErrorKind::BadInput, "--exr: not possible with --no-images; expected one of the two"};
      options_.exr = true;
    }
    return {};
  }

  Expected<void> readExports() {
    if (given("--export")) {
      for (const std::string& format : raw_.exportAs) {
        constexpr std::pair<std::string_view, bool Options::*> formats[] = {
            {"ply", &Options::exportPly}, {"mesh", &Options::exportMesh}, {"vtk", &Options::exportVtk}, {"poses", &Options::exportPoses}};
        const auto* found = std::ranges::find(formats, format, [](const auto& known) { return known.first; });
        if (found == std::end(formats)) return badInput("--export", format, "ply, mesh, vtk or poses");
        options_.*found->second = true;
      }
    }
    for (const char* option : {"--mesh-format", "--mesh-cell"})
      if (given(option) && !options_.exportMesh)
        return Error{ErrorKind::BadInput, std::string(option) + ": needs --export mesh; expected both or neither"};
    if (given("--mesh-format")) {
      const auto format = apps::meshFormat(raw_.meshFormat);
      if (!format) return badInput("--mesh-format", raw_.meshFormat, "ply, obj, glb or vtp");
      options_.meshFormat = *format;
    }
    if (given("--mesh-cell")) {
      const auto cell = numberIn<double>(raw_.meshCell);
      if (!cell || !(*cell >= 0.25 && *cell <= 1)) return badInput("--mesh-cell", raw_.meshCell, "a number of spacings from 0.25 to 1");
      options_.meshCell = *cell;
    }
    return {};
  }

  Expected<void> readParticles() {
    if (given("--particles")) {
      const auto particles = numberIn<uint64_t>(raw_.particles);
      if (!particles || *particles < 1 || *particles > kMaxParticles)
        return badInput("--particles", raw_.particles, "a whole number from 1 to " + grouped(kMaxParticles));
    }
    return {};
  }

  Expected<void> readOutputs() {
    if (given("--out")) {
      if (raw_.out.empty()) return badInput("--out", raw_.out, "the name of a folder");
      options_.out = raw_.out;
    }
    if (given("--stats")) {
      if (raw_.stats.empty()) return badInput("--stats", raw_.stats, "the name of a file, or - for standard output");
      options_.stats = raw_.stats;
    }
    if (given("--graph")) {
      if (raw_.graph.empty()) return badInput("--graph", raw_.graph, "the name of a file, or - for standard output");
      options_.graph = raw_.graph;
    }
    return {};
  }

  Expected<void> readCheckpoint() {
    if (given("--checkpoint")) {
      if (raw_.checkpoint.empty() || apps::isStandardOutput(raw_.checkpoint))
        return badInput("--checkpoint", raw_.checkpoint, "the name of a file");
      options_.checkpoint = raw_.checkpoint;
      if (options_.stats && sameFile(*options_.stats, *options_.checkpoint))
        return badInput("--checkpoint", raw_.checkpoint, "another file than that of --stats");
    }
    return {};
  }

  Expected<void> readVideo() {
    if (given("--video")) {
      if (!isVideoName(raw_.video)) return badInput("--video", raw_.video, "the name of a file that ends in .mp4, .mkv or .mov");
      options_.video = raw_.video;
      for (const auto& [other, file] : {std::pair{"--stats", &options_.stats}, std::pair{"--checkpoint", &options_.checkpoint}})
        if (*file && sameFile(**file, *options_.video))
          return badInput("--video", raw_.video, std::string("another file than that of ") + other);
    }
    return {};
  }

  Expected<void> readResume() {
    if (given("--checkpoint-every")) {
      const auto seconds = numberIn<double>(raw_.checkpointEvery);
      if (!seconds || !(*seconds >= 0 && *seconds <= 1e9))
        return badInput("--checkpoint-every", raw_.checkpointEvery, "a number of seconds from 0 (after every frame) to 1000000000");
      if (!options_.checkpoint) return Error{ErrorKind::BadInput, "--checkpoint-every: needs --checkpoint; expected --checkpoint FILE"};
      options_.checkpointEvery_s = *seconds;
    }
    if (given("--resume")) {
      if (raw_.resume.empty()) return badInput("--resume", raw_.resume, "a file that --checkpoint wrote");
      options_.resume = raw_.resume;
    }
    return {};
  }

  Expected<void> readPlay() {
    if (given("--play")) {
      if (raw_.play.empty()) return badInput("--play", raw_.play, "a folder of .ply files");
      options_.play = raw_.play;
      // Options that need a simulation.
      for (const char* other : {"--stats", "--export", "--checkpoint", "--resume", "--require", "--explain", "--particles"})
        if (given(other))
          return Error{ErrorKind::BadInput,
                       std::string(other) + ": not possible with --play, which does not simulate; expected one of the two"};
      if (raw_.noImages && !options_.video)
        return Error{ErrorKind::BadInput, "--no-images: with --play there is nothing to write; expected --video FILE"};
    }
    return {};
  }

  Expected<void> readDevice() {
    auto device = apps::deviceOption(given("--device") ? std::optional(raw_.device) : std::nullopt);
    if (!device) return device.error();
    options_.device = std::move(*device);
    if (given("--reads")) {
      constexpr std::pair<std::string_view, ArrayReads> kinds[] = {
          {"auto", ArrayReads::Auto}, {"storage", ArrayReads::Storage}, {"texels", ArrayReads::Texels}};
      const auto* found = std::ranges::find(kinds, raw_.reads, [](const auto& kind) { return kind.first; });
      if (found == std::end(kinds)) return badInput("--reads", raw_.reads, "auto, storage or texels");
      options_.reads = found->second;
    }
    return {};
  }

  Expected<void> readAssignments() {
    for (const std::string& text : raw_.set) {
      auto assignment = parseOverride(text);
      if (!assignment) return assignment.error();
      options_.overrides.push_back(std::move(*assignment));
    }
    if (given("--particles")) options_.overrides.push_back({"fluid.particles", raw_.particles});
    for (const std::string& text : raw_.require) {
      auto requirement = parseRequirement(text);
      if (!requirement) return requirement.error();
      options_.requirements.push_back(std::move(*requirement));
    }
    return {};
  }

  const RawOptions& raw_;
  const CLI::App& app_;
  Options options_;
};

}  // namespace

Expected<Options> readOptions(const RawOptions& raw, const CLI::App& app) { return OptionReader(raw, app).read(); }

}  // namespace rill::capture
