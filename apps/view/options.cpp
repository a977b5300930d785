#include "view/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/words.hpp"
#include "rill/offline.hpp"
#include "rill/version.hpp"
#include "shared/device_option.hpp"
#include "shared/option_text.hpp"
#include "shared/pipeline_cache_folder.hpp"
#include "shared/usage.hpp"
#include "shared/words.hpp"
#include "view/keys.hpp"
#include "view/script.hpp"

namespace rill::view {
namespace {

using apps::badInput, apps::numberIn;

constexpr uint32_t kMinSide = 64, kMaxSide = 8192;  // pixels
constexpr uint64_t kMaxFrames = 1'000'000'000;

/// Options as text: numbers are parsed here, so that messages do not depend on the version of CLI11.
struct Raw {
  std::string scene, device, size, scale, view, exposure, present, frames, screenshot, script;
  std::vector<std::string> set;
  bool lockstep = false, validate = false, listDevices = false;
};

void declare(CLI::App& app, Raw& raw) {
  const std::string shown = "Scene", run = "Run";
  app.add_option("SCENE", raw.scene, "name of a scene, or path of a .json file (default: dam-break)")->type_name("")->group(shown);
  const auto text = [&](const char* name, std::string& value, const std::string& about, const char* type, const std::string& group) {
    app.add_option(name, value, about)->type_name(type)->group(group);
  };
  text("--view", raw.view, "initial view: " + apps::viewNames() + " (default: final)", "VIEW", shown);
  text("--exposure", raw.exposure, "brighten the view final by EV stops, each twice the light (-10 to 10, default: 0)", "EV", shown);
  text("--size", raw.size, "size of the window in pixels (default: 1280x720)", "WxH", shown);
  text("--scale", raw.scale, "scale of text and buttons, 0.5 to 4 (default: that of the display)", "FACTOR", shown);
  app.add_option("--set", raw.set, "override a key of the scene, for example fluid.viscosity=0.1")
      ->type_name("KEY=VALUE")
      ->group(shown)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->expected(1);
  app.add_flag("--list-devices", raw.listDevices, "print the Vulkan devices with their index, discrete ones first, and end")->group(run);
  text("--present", raw.present,
       "when a frame is shown: " + presentModeNames() +
           " (default: fifo). fifo waits for the display; mailbox and immediate do not, immediate may tear",
       "MODE", run);
  text("--device", raw.device, apps::kDeviceHelp, "NAME", run);
  text("--frames", raw.frames, "close the window after N displayed frames", "N", run);
  text("--screenshot", raw.screenshot, "write the last frame of the window, including the panels, as PNG", "FILE", run);
  text("--script", raw.script, "replay input from a file, in lockstep (commands below)", "FILE", run);
  app.add_flag("--lockstep", raw.lockstep,
               "simulate exactly one step of 1/60 s per displayed frame: frame k shows the same state as frame k of rill-capture")
      ->group(run);
  app.add_flag("--validate", raw.validate, "enable the Khronos validation layer, and exit with 1 if it reports anything")->group(run);
  app.set_help_flag("-h,--help", "show this text")->group(run);
  app.set_version_flag("--version", std::string("rill-view ") + RILL_VERSION, "show the version")->group(run);
  app.footer("Mouse and keys:\n" + keyHelp() +
             "\nLines of a script are \"FRAME COMMAND\", with frames from 0; '#' starts a comment. Commands:\n" + scriptHelp() +
             "\nExamples:\n"
             "  rill-view double-dam --view particles\n"
             "      two columns of water collapse; particles are colored by speed\n"
             "  rill-view dam10k --set fluid.viscosity=2\n"
             "      a viscous fluid; the panels change its parameters while it runs\n"
             "  rill-view dam10k --lockstep --frames 30 --screenshot shot.png\n"
             "      writes the window at 29/60 s and prints the hash of the state, as in --stats of rill-capture\n"
             "\nExit codes: 0 success, 1 error while running, 2 bad usage, bad input or no display, 4 no Vulkan device that can present;\n"
             "130, 143 or 129 after SIGINT, SIGTERM or SIGHUP.\n" +
             apps::kPipelineCacheHelp);
}

Expected<Options> validated(const Raw& raw, const CLI::App& app) {
  const auto given = [&](const char* name) { return app.count(name) > 0; };
  Options options;
  if (given("SCENE")) {
    if (raw.scene.empty()) return badInput("SCENE", raw.scene, "a scene's name or the path of a .json file");
    options.scene = raw.scene;
  }
  if (given("--size")) {
    const auto size = apps::pixelSizeIn(raw.size, kMinSide, kMaxSide);
    if (!size)
      return badInput("--size", raw.size,
                      "WIDTHxHEIGHT in pixels, as 1280x720: each from " + std::to_string(kMinSide) + " to " + std::to_string(kMaxSide));
    options.width = size->width;
    options.height = size->height;
  }
  if (given("--scale")) {
    options.scale = numberIn<float>(raw.scale);
    if (!options.scale || !(*options.scale >= 0.5f && *options.scale <= 4)) return badInput("--scale", raw.scale, "a number from 0.5 to 4");
  }
  if (given("--view")) {
    if (auto known = apps::checkView(raw.view); !known) return known.error();
    options.view = raw.view;
  }
  if (given("--exposure")) {
    const auto stops = apps::exposureIn(raw.exposure);
    if (!stops) return stops.error();
    options.exposure_stops = *stops;
  }
  if (given("--present")) {
    const auto mode = presentModeNamed(raw.present);
    if (!mode) return badInput("--present", raw.present, "one of " + presentModeNames());
    options.present = *mode;
  }
  if (given("--frames")) {
    options.frames = numberIn<uint64_t>(raw.frames);
    if (!options.frames || *options.frames < 1 || *options.frames > kMaxFrames)
      return badInput("--frames", raw.frames, "a whole number from 1 to " + std::to_string(kMaxFrames));
  }
  auto device = apps::deviceOption(given("--device") ? std::optional(raw.device) : std::nullopt);
  if (!device) return device.error();
  options.device = std::move(*device);
  if (given("--screenshot")) {
    if (raw.screenshot.empty()) return badInput("--screenshot", raw.screenshot, "the name of a file");
    if (auto place = apps::checkFilePlace("--screenshot", raw.screenshot); !place) return place.error();
    options.screenshot = raw.screenshot;
  }
  if (given("--script")) {
    if (raw.script.empty()) return badInput("--script", raw.script, "the name of a file");
    options.script = raw.script;
  }
  for (const std::string& text : raw.set) {
    auto change = parseOverride(text);
    if (!change) return change.error();
    options.overrides.push_back(std::move(*change));
  }
  options.lockstep = raw.lockstep || options.script;
  options.validate = raw.validate;
  options.listDevices = raw.listDevices;
  return options;
}

}  // namespace

Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments) {
  Raw raw;
  CLI::App app("Simulates a fluid scene in a window, with a camera, parameters and figures.", "rill-view");
  declare(app, raw);
  auto text = apps::parsed(app, std::string("rill-view ") + RILL_VERSION, [&] { app.parse(count, arguments); });
  if (!text) return text.error();
  apps::CommandLine<Options> line;
  if (!text->empty()) {
    line.text = std::move(*text);
    return line;
  }
  auto options = validated(raw, app);
  if (!options) return options.error();
  line.options = std::move(*options);
  return line;
}

}  // namespace rill::view
