#include "view/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/words.hpp"
#include "rill/offline.hpp"
#include "rill/version.hpp"
#include "shared/option_text.hpp"
#include "shared/usage.hpp"
#include "shared/words.hpp"
#include "view/keys.hpp"
#include "view/script.hpp"

namespace rill::view {
namespace {

using apps::badInput, apps::numberIn;

constexpr uint32_t kLeastSide = 64, kMaxSide = 8192;  // pixels
constexpr uint64_t kMaxFrames = 1'000'000'000;

/// Options as text: numbers are read here, so that every version of the command line library gives the same messages.
struct Raw {
  std::string scene, device, size, scale, view, frames, screenshot, script;
  std::vector<std::string> set;
  bool lockstep = false, validate = false;
};

void declare(CLI::App& app, Raw& raw) {
  const std::string shown = "What is shown", run = "How it runs";
  app.add_option("SCENE", raw.scene, "a scene's name, or the path of a .json file (default: dam-break)")->type_name("")->group(shown);
  const auto text = [&](const char* name, std::string& value, const std::string& about, const char* type, const std::string& group) {
    app.add_option(name, value, about)->type_name(type)->group(group);
  };
  text("--view", raw.view, "what is drawn at first: " + apps::viewNames() + " (default: final)", "VIEW", shown);
  text("--size", raw.size, "of the window, pixels (default: 1280x720)", "WxH", shown);
  text("--scale", raw.scale, "of text and buttons, 0.5 to 4 (default: what the display asks for)", "FACTOR", shown);
  app.add_option("--set", raw.set, "change a key of the scene, as fluid.viscosity=0.1")
      ->type_name("KEY=VALUE")
      ->group(shown)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->expected(1);
  text("--device", raw.device, "part of a device's name, or its index", "NAME", run);
  text("--frames", raw.frames, "close the window after so many displayed frames", "N", run);
  text("--screenshot", raw.screenshot, "write the window's last frame, panels and all, as PNG", "FILE", run);
  text("--script", raw.script, "replay what hands do from a file, in lockstep (commands below)", "FILE", run);
  app.add_flag("--lockstep", raw.lockstep,
               "a step of 1/60 s for each displayed frame, however long it takes: frame k then shows what frame k of rill-capture shows")
      ->group(run);
  app.add_flag("--validate", raw.validate, "check every Vulkan call with the Khronos layer, and exit with 1 if it says anything")
      ->group(run);
  app.set_help_flag("-h,--help", "show this text")->group(run);
  app.set_version_flag("--version", std::string("rill-view ") + RILL_VERSION, "show the version")->group(run);
  app.footer(
      "Mouse and keys:\n" + keyHelp() + "\nScripts have lines \"FRAME COMMAND\", frames from 0 on, comments after '#':\n" + scriptHelp() +
      "\nExamples:\n"
      "  rill-view double-dam --view particles\n"
      "      two columns run at each other, colored by speed\n"
      "  rill-view dam10k --set fluid.viscosity=2\n"
      "      oil in place of water; the panels change it while it runs\n"
      "  rill-view dam10k --lockstep --frames 30 --screenshot shot.png\n"
      "      a picture of the window at 29/60 s; prints the state's hash, which rill-capture's --stats has too\n"
      "\nExit codes: 0 closed, 1 failed while running, 2 bad usage, bad input or no display, 4 no Vulkan device that can draw to it;\n"
      "130, 143, 129 after a signal.");
}

Expected<Options> judged(const Raw& raw, const CLI::App& app) {
  const auto given = [&](const char* name) { return app.count(name) > 0; };
  Options options;
  if (given("SCENE")) {
    if (raw.scene.empty()) return badInput("SCENE", raw.scene, "a scene's name or the path of a .json file");
    options.scene = raw.scene;
  }
  if (given("--size")) {
    const auto size = apps::pixelSizeIn(raw.size, kLeastSide, kMaxSide);
    if (!size)
      return badInput("--size", raw.size,
                      "WIDTHxHEIGHT in pixels, as 1280x720: each from " + std::to_string(kLeastSide) + " to " + std::to_string(kMaxSide));
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
  if (given("--frames")) {
    options.frames = numberIn<uint64_t>(raw.frames);
    if (!options.frames || *options.frames < 1 || *options.frames > kMaxFrames)
      return badInput("--frames", raw.frames, "a whole number from 1 to " + std::to_string(kMaxFrames));
  }
  if (given("--device") && raw.device.empty()) return badInput("--device", raw.device, "part of a device's name, or its index");
  options.device = raw.device;
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
  return options;
}

}  // namespace

Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments) {
  Raw raw;
  CLI::App app("A window on a scene: see it run, go around it, tune it.", "rill-view");
  declare(app, raw);
  auto text = apps::parsed(app, std::string("rill-view ") + RILL_VERSION, [&] { app.parse(count, arguments); });
  if (!text) return text.error();
  apps::CommandLine<Options> line;
  if (!text->empty()) {
    line.text = std::move(*text);
    return line;
  }
  auto options = judged(raw, app);
  if (!options) return options.error();
  line.options = std::move(*options);
  return line;
}

}  // namespace rill::view
