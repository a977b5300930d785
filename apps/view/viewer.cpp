#include "view/viewer.hpp"

#include <memory>
#include <vector>

#include "offline/device_list.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/message.hpp"
#include "shared/scene_folders.hpp"
#include "shared/signals.hpp"
#include "view/log_error.hpp"
#include "view/script_player.hpp"
#include "view/window_loop.hpp"

namespace rill::view {
namespace {

namespace fs = std::filesystem;

/// Prints the devices, and which of them can present where there is a display.
int listDevices() {
  offline::ContextDesc desc;
  if (Window::openDisplay()) {
    desc.instanceExtensions = Window::instanceExtensions();
    desc.presents = Window::presents;
  }
  const auto devices = offline::findDevices(desc);
  Window::closeDisplay();
  const auto written = devices ? apps::writeStream(STDOUT_FILENO, apps::printable(offline::deviceTable(*devices))) : devices.error();
  if (written) return apps::kDone;
  logError(written.error().message);
  return devices ? apps::kFailed : apps::exitCodeBeforeRun(devices.error());
}

/// What is read and opened before a device.
struct Start {
  apps::SceneFolders folders = apps::SceneFolders::standard();
  fs::path file;
  Expected<void> valid;  // whether `file` is a valid scene
  std::vector<ScriptLine> script;
  std::unique_ptr<Window> window;
};

Expected<Start> prepare(const Options& options) {
  Start start;
  auto file = start.folders.find(options.scene);
  if (!file) return file.error();
  start.file = *file;
  if (const auto scene = loadScene(*file, options.overrides); !scene) start.valid = scene.error();
  // An invalid file is an error where it cannot be fixed while the window is open: with --frames, a script, invalid --set.
  if (!start.valid && (options.frames || options.script || loadScene(*file))) return start.valid.error();
  if (options.script) {
    auto script = loadScript(*options.script);
    if (!script) return script.error();
    start.script = std::move(*script);
    if (auto known = checkNames(start.script, start.folders); !known) return known.error();
  }
  auto window = Window::open("rill-view", options.width, options.height);
  if (!window) return start.valid ? window.error() : start.valid.error();
  start.window = std::move(*window);
  return start;
}

int exitCode(const WindowLoop& loop) {
  if (loop.sawValidationMessage()) return apps::kFailed;
  if (apps::signalReceived()) return 128 + apps::signalReceived();
  return loop.waitsForScene() ? apps::kBadInput : apps::kDone;
}

}  // namespace

int runViewer(const Options& options) {
  if (options.listDevices) return listDevices();
  const auto failed = [](const Error& error, int code) {
    logError(error.message);
    return code;
  };
  auto start = prepare(options);
  if (!start) return failed(start.error(), apps::exitCodeBeforeRun(start.error()));
  WindowLoop loop(options, std::move(start->window), start->folders, std::move(start->script));
  if (auto opened = loop.open(start->file, start->valid); !opened) return failed(opened.error(), apps::exitCodeBeforeRun(opened.error()));
  if (auto ran = loop.run(); !ran) return failed(ran.error(), apps::kFailed);
  return exitCode(loop);
}

}  // namespace rill::view
