#include "view/window_loop.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/words.hpp"
#include "shared/png.hpp"
#include "shared/signals.hpp"
#include "view/panel_requests.hpp"
#include "view/panels/board.hpp"

namespace rill::view {
namespace {

namespace fs = std::filesystem;
using Now = std::chrono::steady_clock;

double secondsSince(Now::time_point then) { return std::chrono::duration<double>(Now::now() - then).count(); }

}  // namespace

WindowLoop::WindowLoop(const Options& options, std::unique_ptr<Window> window, const apps::SceneFolders& folders,
                       std::vector<ScriptLine> script)
    : options_(options),
      window_(std::move(window)),
      interface_(
          options.scale.value_or(window_->contentScale()), [this] { return window_->clipboard(); },
          [this](const char* text) { window_->setClipboard(text); }),
      settings_{.view = options.view, .exposure_stops = options.exposure_stops},
      graphics_(options, *window_, interface_.fonts()),
      shown_(*window_, interface_, graphics_, settings_, message_, options.lockstep),
      scenes_(folders, shown_, message_),
      devices_(options.device.name, graphics_, shown_, message_),
      input_(settings_, interface_, shown_, scenes_),
      script_(std::move(script), *window_, settings_, shown_, scenes_) {}

Expected<void> WindowLoop::open(const fs::path& file, const Expected<void>& valid) {
  if (auto opened = graphics_.open(); !opened) return opened;
  return valid ? scenes_.open(file, options_.overrides) : scenes_.waitForValidFile(file, options_.overrides, valid.error());
}

Expected<void> WindowLoop::run() {
  const Now::time_point begin = Now::now();
  Now::time_point before = begin;
  while (!window_->closing() && !apps::signalReceived() && !(options_.frames && frame_ >= *options_.frames)) {
    const double passed = secondsSince(before);
    before = Now::now();
    now_s_ += passed;
    frameTime_s_ += 0.1 * (passed - frameTime_s_);
    if (isBounded() && frame_ > 0) summary_.addFrame(passed);
    if (auto done = frame(options_.lockstep ? Clock::kStep : std::min(passed, 0.25)); !done) {
      if (done.error().kind != ErrorKind::DeviceLost) return done;
      interface_.skip();
      if (auto recovered = devices_.recover(done.error(), now_s_); !recovered) return recovered;
    }
    ++frame_;
    graphics_.logValidationMessages();
  }
  if (auto idle = graphics_.context().wait(); !idle) return idle;
  if (!isBounded()) return {};
  return summary_.print(scenes_.openName(), frame_, secondsSince(begin), shown_.session().runner());
}

/// True in the last frame of a run with --frames or a script.
bool WindowLoop::isLastFrame() const { return options_.frames ? frame_ + 1 == *options_.frames : !script_.empty() && script_.ended(); }

Expected<void> WindowLoop::frame(double seconds) {
  window_->setTitle("Rill: " + scenes_.openName() + " (" + graphics_.deviceName() + ")");
  message_.update(now_s_);
  // Nothing changes: wait for input instead of drawing the same frame again.
  const bool idle = settings_.paused && !interface_.waiting() && shown_.still() && !isBounded();
  std::vector<InputEvent> events = window_->events(idle ? 0.1 : 0);
  const auto scripted = script_.play(frame_);
  if (!scripted) return scripted.error();
  events.insert(events.end(), scripted->events.begin(), scripted->events.end());
  if (!script_.empty() && script_.ended() && !options_.frames) window_->close();

  const Window::Size size = window_->framebuffer();
  for (const InputEvent& event : events) interface_.addEvent(event);
  for (const InputEvent& event : interface_.begin(seconds, std::max(size.width, 1u), std::max(size.height, 1u)))
    if (auto done = input_.handle(event); !done) return done;
  if (auto done = shown_.reloadIfChanged(now_s_); !done) return done;
  if (auto done = scenes_.openIfChanged(now_s_); !done) return done;
  if (auto done = shown_.simulate(seconds, now_s_); !done) return done;

  std::optional<fs::path> screenshot = input_.takeScreenshot();
  if (!screenshot) screenshot = options_.screenshot && isLastFrame() ? options_.screenshot : scripted->screenshot;
  if (size.width == 0 || size.height == 0) {  // minimized
    interface_.skip();
    if (screenshot && isBounded())
      return Error{ErrorKind::BadInput, inQuotes(screenshot->string()) + ": not written, because the window is minimized"};
    if (!options_.lockstep) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return {};
  }
  if (auto fits = graphics_.display().fit(size); !fits) return fits;
  shown_.layOut(size);
  if (auto painted = shown_.paint(seconds); !painted) return painted;
  return draw(screenshot);
}

/// Draws the panels over the image.
Expected<void> WindowLoop::draw(const std::optional<fs::path>& screenshot) {
  Board board{shown_.session(),       graphics_.display(),           interface_,        settings_,      scenes_.names(), scenes_.openName(),
              graphics_.deviceName(), shown_.playback().histories(), shown_.heldEdit(), message_.text()};
  board.layout = shown_.layout();
  board.stats = shown_.playback().stats();
  board.framesPerSecond = frameTime_s_ > 0 ? 1 / frameTime_s_ : 0;
  board.speed = shown_.playback().speed();
  board.pictureScale = shown_.picture().scale();
  board.picture_s = shown_.picture().seconds();
  board.lockstep = options_.lockstep;
  board.devices = graphics_.devices();
  board.memory = graphics_.memory(now_s_);
  board.pullLine = shown_.pullLine();
  drawPanels(board);
  if (auto shown = show(interface_.end(), screenshot); !shown) return shown;
  return carryOut(board.requests, graphics_, shown_, scenes_, devices_, message_);
}

/// Presents the window, and writes it to a file.
Expected<void> WindowLoop::show(const ImDrawData& lists, const std::optional<fs::path>& screenshot) {
  const bool dark = interface_.theme() == Theme::Dark;
  const ImVec4 behind = dark ? ImVec4(0.09f, 0.1f, 0.12f, 1) : ImVec4(0.86f, 0.88f, 0.9f, 1);
  offline::Image image;
  for (int tries = 0; tries < 3; ++tries) {  // the swapchain may be out of date
    if (auto fits = graphics_.display().fit(window_->framebuffer()); !fits) return fits;
    if (auto shown = graphics_.display().show(lists, behind, screenshot ? &image : nullptr); !shown) return shown;
    if (!screenshot || image.width > 0) break;
  }
  if (!screenshot) return {};
  const auto written = image.width > 0
                           ? apps::writePng(*screenshot, image)
                           : Error{ErrorKind::BadInput, inQuotes(screenshot->string()) + ": not written, because the window was resized"};
  if (!written && isBounded()) return written;
  return message_.report(written, "The window was written to " + fs::absolute(*screenshot).string());
}

}  // namespace rill::view
