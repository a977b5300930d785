#include "capture/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "capture/raw_options.hpp"
#include "capture/video.hpp"
#include "core/words.hpp"
#include "rill/offline.hpp"
#include "rill/version.hpp"
#include "shared/atomic_file.hpp"
#include "shared/device_option.hpp"
#include "shared/exr.hpp"
#include "shared/option_text.hpp"
#include "shared/pipeline_cache_folder.hpp"
#include "shared/scene_folders.hpp"
#include "shared/usage.hpp"
#include "shared/words.hpp"

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

Expected<Options> validated(const RawOptions& raw, const CLI::App& app) {
  const auto given = [&](const char* name) { return app.count(name) > 0; };
  Options options;
  options.scene = raw.scene;
  if (raw.scene.empty()) return badInput("SCENE", raw.scene, "a scene's name or the path of a .json file");
  if (given("--frames")) {
    options.frames = numberIn<uint32_t>(raw.frames);
    if (!options.frames || *options.frames < 1 || *options.frames > kMaxFrames)
      return badInput("--frames", raw.frames, "a whole number from 1 to " + std::to_string(kMaxFrames));
  }
  if (given("--fps")) {
    const auto fps = numberIn<double>(raw.fps);
    if (!fps || !(*fps >= 0.001 && *fps <= 1e6)) return badInput("--fps", raw.fps, "a number from 0.001 to 1000000");
    options.fps = *fps;
    options.fpsGiven = true;
  }
  if (given("--size")) {
    const auto size = apps::pixelSizeIn(raw.size, 1, kMaxSide);
    if (!size || uint64_t{size->width} * size->height > kMaxPixels)
      return badInput("--size", raw.size,
                      "WIDTHxHEIGHT in pixels, as 1280x720: each from 1 to " + std::to_string(kMaxSide) + ", together at most " +
                          std::to_string(kMaxPixels));
    options.width = size->width;
    options.height = size->height;
  }
  if (given("--view")) {
    if (auto known = apps::checkView(raw.view); !known) return known.error();
    options.view = raw.view;
  }
  if (auto possible = offline::Simulation::checkPicture(options.view, options.width, options.height); !possible)
    return Error{ErrorKind::BadInput, "--size, --view " + options.view + ": " + possible.error().message};
  if (given("--orbit")) {
    const auto orbit = numberIn<double>(raw.orbit);
    if (!orbit || !(std::abs(*orbit) <= 36000)) return badInput("--orbit", raw.orbit, "a number of degrees from -36000 to 36000");
    options.orbit_degPerS = *orbit;
  }
  if (given("--exposure")) {
    const auto stops = apps::exposureIn(raw.exposure);
    if (!stops) return stops.error();
    if (options.view != "final")
      return Error{ErrorKind::BadInput, "--exposure: the view " + options.view + " has none; expected --view final"};
    if (raw.noImages && !given("--video"))
      return Error{ErrorKind::BadInput, "--exposure: found --no-images without --video; expected images to expose"};
    options.exposure_stops = *stops;
  }
  const auto ifGiven = [&](const char* name, const std::string& text) { return given(name) ? std::optional(text) : std::nullopt; };
  auto film = filmOptions({.samples = ifGiven("--samples", raw.samples),
                           .shutter = ifGiven("--shutter", raw.shutter),
                           .aperture = ifGiven("--aperture", raw.aperture),
                           .focus = ifGiven("--focus", raw.focus)},
                          options.view, !raw.noImages || given("--video"));
  if (!film) return film.error();
  options.film = *film;
  if (raw.exr) {
    if (!apps::writesExr())
      return Error{ErrorKind::BadInput, "--exr: this rill-capture was built without OpenEXR; expected a build with it"};
    if (options.view != "final")
      return Error{ErrorKind::BadInput, "--exr: the view " + options.view + " is not linear light; expected --view final"};
    if (raw.noImages) return Error{ErrorKind::BadInput, "--exr: not possible with --no-images; expected one of the two"};
    options.exr = true;
  }
  if (given("--export")) {
    for (const std::string& format : raw.exportAs) {
      constexpr std::pair<std::string_view, bool Options::*> formats[] = {
          {"ply", &Options::exportPly}, {"mesh", &Options::exportMesh}, {"vtk", &Options::exportVtk}, {"poses", &Options::exportPoses}};
      const auto* found = std::ranges::find(formats, format, [](const auto& known) { return known.first; });
      if (found == std::end(formats)) return badInput("--export", format, "ply, mesh, vtk or poses");
      options.*found->second = true;
    }
  }
  for (const char* option : {"--mesh-format", "--mesh-cell"})
    if (given(option) && !options.exportMesh)
      return Error{ErrorKind::BadInput, std::string(option) + ": needs --export mesh; expected both or neither"};
  if (given("--mesh-format")) {
    const auto format = apps::meshFormat(raw.meshFormat);
    if (!format) return badInput("--mesh-format", raw.meshFormat, "ply, obj, glb or vtp");
    options.meshFormat = *format;
  }
  if (given("--mesh-cell")) {
    const auto cell = numberIn<double>(raw.meshCell);
    if (!cell || !(*cell >= 0.25 && *cell <= 1)) return badInput("--mesh-cell", raw.meshCell, "a number of spacings from 0.25 to 1");
    options.meshCell = *cell;
  }
  if (given("--particles")) {
    const auto particles = numberIn<uint64_t>(raw.particles);
    if (!particles || *particles < 1 || *particles > kMaxParticles)
      return badInput("--particles", raw.particles, "a whole number from 1 to " + grouped(kMaxParticles));
  }
  if (given("--out")) {
    if (raw.out.empty()) return badInput("--out", raw.out, "the name of a folder");
    options.out = raw.out;
  }
  if (given("--stats")) {
    if (raw.stats.empty()) return badInput("--stats", raw.stats, "the name of a file, or - for standard output");
    options.stats = raw.stats;
  }
  if (given("--graph")) {
    if (raw.graph.empty()) return badInput("--graph", raw.graph, "the name of a file, or - for standard output");
    options.graph = raw.graph;
  }
  if (given("--checkpoint")) {
    if (raw.checkpoint.empty() || apps::isStandardOutput(raw.checkpoint))
      return badInput("--checkpoint", raw.checkpoint, "the name of a file");
    options.checkpoint = raw.checkpoint;
    if (options.stats && sameFile(*options.stats, *options.checkpoint))
      return badInput("--checkpoint", raw.checkpoint, "another file than that of --stats");
  }
  if (given("--video")) {
    if (!isVideoName(raw.video)) return badInput("--video", raw.video, "the name of a file that ends in .mp4, .mkv or .mov");
    options.video = raw.video;
    for (const auto& [other, file] : {std::pair{"--stats", &options.stats}, std::pair{"--checkpoint", &options.checkpoint}})
      if (*file && sameFile(**file, *options.video))
        return badInput("--video", raw.video, std::string("another file than that of ") + other);
  }
  if (given("--checkpoint-every")) {
    const auto seconds = numberIn<double>(raw.checkpointEvery);
    if (!seconds || !(*seconds >= 0 && *seconds <= 1e9))
      return badInput("--checkpoint-every", raw.checkpointEvery, "a number of seconds from 0 (after every frame) to 1000000000");
    if (!options.checkpoint) return Error{ErrorKind::BadInput, "--checkpoint-every: needs --checkpoint; expected --checkpoint FILE"};
    options.checkpointEvery_s = *seconds;
  }
  if (given("--resume")) {
    if (raw.resume.empty()) return badInput("--resume", raw.resume, "a file that --checkpoint wrote");
    options.resume = raw.resume;
  }
  if (given("--play")) {
    if (raw.play.empty()) return badInput("--play", raw.play, "a folder of .ply files");
    options.play = raw.play;
    // Options that need a simulation.
    for (const char* other : {"--stats", "--export", "--checkpoint", "--resume", "--require", "--explain", "--particles"})
      if (given(other))
        return Error{ErrorKind::BadInput,
                     std::string(other) + ": not possible with --play, which does not simulate; expected one of the two"};
    if (raw.noImages && !options.video)
      return Error{ErrorKind::BadInput, "--no-images: with --play there is nothing to write; expected --video FILE"};
  }
  auto device = apps::deviceOption(given("--device") ? std::optional(raw.device) : std::nullopt);
  if (!device) return device.error();
  options.device = std::move(*device);
  if (given("--reads")) {
    constexpr std::pair<std::string_view, ArrayReads> kinds[] = {
        {"auto", ArrayReads::Auto}, {"storage", ArrayReads::Storage}, {"texels", ArrayReads::Texels}};
    const auto* found = std::ranges::find(kinds, raw.reads, [](const auto& kind) { return kind.first; });
    if (found == std::end(kinds)) return badInput("--reads", raw.reads, "auto, storage or texels");
    options.reads = found->second;
  }
  for (const std::string& text : raw.set) {
    auto assignment = parseOverride(text);
    if (!assignment) return assignment.error();
    options.overrides.push_back(std::move(*assignment));
  }
  if (given("--particles")) options.overrides.push_back({"fluid.particles", raw.particles});
  for (const std::string& text : raw.require) {
    auto requirement = parseRequirement(text);
    if (!requirement) return requirement.error();
    options.requirements.push_back(std::move(*requirement));
  }
  options.explain = raw.explain;
  options.images = !raw.noImages;
  options.passTimes = !raw.noPassTimes;
  options.quiet = raw.quiet;
  return options;
}

}  // namespace

Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments) {
  RawOptions raw;
  CLI::App app(
      "Simulates a fluid scene without a window and writes images, particles and figures.\n"
      "Frame 0 is the start of the scene, frame k the instant k/fps seconds later.");
  app.name("rill-capture");
  app.get_formatter()->column_width(30);
  declareOptions(app, raw);
  app.footer("Scenes: " + apps::joined(apps::SceneFolders::standard().names()) +
             "\n\nExamples:\n"
             "  rill-capture dam-break\n"
             "      writes images of a dam break to out/dam-break\n"
             "  rill-capture dam-break --no-images --stats run.json --set fluid.viscosity=0.1 --particles 10000\n"
             "      writes figures only, with a viscosity of 0.1 Pa s and about 10,000 particles\n"
             "  rill-capture resting-column --frames 61 --no-images --quiet --require 'density_error_mean<0.001' 'outside<1'\n"
             "      a check for scripts: exits with 0 where both requirements hold, else with 3\n"
             "  rill-capture dam-break --checkpoint run.rill --checkpoint-every 600\n"
             "  rill-capture dam-break --resume run.rill\n"
             "      a long run that is interrupted and resumed; the result is the same as without the interruption\n"
             "  rill-capture dam-break --no-images --video dam.mp4\n"
             "      writes only a video; after Ctrl-C it contains the frames so far\n"
             "  rill-capture dam-break --fps 24 --shutter 180 --aperture 2.8 --video dam.mp4\n"
             "      with the motion blur and the depth of field of a film camera\n"
             "  rill-capture dam-break --play frames --view final\n"
             "      draws frames/*.ply with the camera, solids and appearance of dam-break\n"
             "\nExit codes: 0 success, 1 error while running, 2 bad usage or input, 3 a --require does not hold,\n"
             "4 no usable Vulkan device; 130, 143 or 129 after SIGINT, SIGTERM or SIGHUP, once the frame in progress is written.\n"
             "A standard output or standard error that is closed is not an error.\n" +
             std::string(apps::kPipelineCacheHelp));
  std::vector<std::string> expanded = expandLists(count, arguments);
  std::reverse(expanded.begin(), expanded.end());  // CLI11 parses a vector from its end
  auto text = apps::parsed(app, "rill-capture " RILL_VERSION, [&] { app.parse(expanded); });
  if (!text) return text.error();
  if (!text->empty()) return apps::CommandLine<Options>{std::nullopt, std::move(*text)};
  auto options = validated(raw, app);
  if (!options) return options.error();
  options->command = apps::commandText("rill-capture", count, arguments);
  return apps::CommandLine<Options>{std::move(*options), {}};
}

}  // namespace rill::capture
