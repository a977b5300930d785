#include "capture/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "capture/raw_options.hpp"
#include "rill/version.hpp"
#include "shared/pipeline_cache_folder.hpp"
#include "shared/scene_folders.hpp"
#include "shared/usage.hpp"
#include "shared/words.hpp"

namespace rill::capture {

offline::Options offlineOptions(const Options& options, double fps) {
  offline::Options settings;
  settings.device = options.device.name;
  settings.deviceOrigin = options.device.origin;
  settings.reads = options.reads;
  settings.pipelineCache = apps::pipelineCacheFolder();
  settings.orbit_degPerS = options.orbit_degPerS;
  settings.exposure_stops = options.exposure_stops;
  settings.film = options.film.film(fps);
  return settings;
}

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
  auto options = readOptions(raw, app);
  if (!options) return options.error();
  options->command = apps::commandText("rill-capture", count, arguments);
  return apps::CommandLine<Options>{std::move(*options), {}};
}

}  // namespace rill::capture
