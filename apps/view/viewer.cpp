#include "view/viewer.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <thread>

#include "core/words.hpp"
#include "offline/device_list.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exit_code.hpp"
#include "shared/message.hpp"
#include "shared/pipeline_cache_folder.hpp"
#include "shared/png.hpp"
#include "shared/scene_folders.hpp"
#include "shared/signals.hpp"
#include "view/controls.hpp"
#include "view/display.hpp"
#include "view/gravity_tilt.hpp"
#include "view/keys.hpp"
#include "view/memory_meter.hpp"
#include "view/panels/board.hpp"
#include "view/picture.hpp"
#include "view/playback.hpp"
#include "view/script.hpp"

namespace rill::view {
namespace {

namespace fs = std::filesystem;
using Now = std::chrono::steady_clock;

constexpr double kMinPiece = 0.012, kMaxPiece = 0.05;  // s of simulation per displayed frame
constexpr double kNotice = 4;                          // s that a notice is shown; an error is shown until it is closed
constexpr double kMeasureEvery = 0.25;                 // s; measuring costs a pass over all neighbors

double secondsSince(Now::time_point then) { return std::chrono::duration<double>(Now::now() - then).count(); }

class Viewer {
 public:
  explicit Viewer(const Options& options) : options_(options), scenes_(apps::SceneFolders::standard()) {}

  int run() {
    if (auto ready = open(); !ready) {
      logError(ready.error().message);
      return apps::exitCodeBeforeRun(ready.error());
    }
    const Now::time_point begin = Now::now();
    if (auto ran = loop(); !ran) {
      logError(ran.error().message);
      return apps::kFailed;
    }
    if (auto printed = printSummary(secondsSince(begin)); !printed) {
      logError(printed.error().message);
      return apps::kFailed;
    }
    if (invalidFile_ && !sawValidationMessage_ && !apps::signalReceived()) return apps::kBadInput;
    return sawValidationMessage_ ? apps::kFailed : apps::signalReceived() ? 128 + apps::signalReceived() : apps::kDone;
  }

 private:
  Expected<void> open() {
    sceneNames_ = scenes_.names();
    auto file = scenes_.find(options_.scene);
    if (!file) return file.error();
    const auto scene = loadScene(*file, options_.overrides);
    // An invalid file is an error where it cannot be fixed while the window is open: with --frames, a script, invalid --set.
    if (!scene && (options_.frames || options_.script || loadScene(*file))) return scene.error();
    if (options_.script) {
      auto script = loadScript(*options_.script);
      if (!script) return script.error();
      script_ = std::move(*script);
      for (const ScriptLine& line : script_)
        if (auto valid = validate(line); !valid) return valid;
    }
    auto window = Window::open("rill-view", options_.width, options_.height);
    if (!window) return scene ? window.error() : scene.error();
    window_ = std::move(*window);
    interface_ = std::make_unique<Interface>(
        options_.scale.value_or(window_->contentScale()), [this] { return window_->clipboard(); },
        [this](const char* text) { window_->setClipboard(text); });
    device_ = options_.device;
    if (auto opened = openDevice(device_, present_); !opened) return opened;
    if (auto listed = offline::findDevices(deviceDesc({}))) devices_ = std::move(*listed);
    settings_.view = options_.view;
    return scene ? openScene(*file, options_.overrides) : waitForValidFile(*file, scene.error());
  }

  /// `device`: as ContextDesc::device.
  offline::ContextDesc deviceDesc(const std::string& device) const {
    offline::ContextDesc desc;
    desc.device = device;
    desc.pipelineCache = apps::pipelineCacheFolder();
    desc.validation = options_.validate;
    desc.framesInFlight = kSubmitsInFlight;
    desc.instanceExtensions = window_->instanceExtensions();
    desc.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    desc.applicationName = "rill-view";
    desc.presents = Window::presents;
    return desc;
  }

  Expected<void> openDevice(const std::string& device, VkPresentModeKHR mode) {
    auto context = offline::Context::create(deviceDesc(device));
    if (!context) {
      Error error = context.error();
      if (error.kind == ErrorKind::NoDevice) error.message += "\nrill-capture needs no window: it writes images to files";
      return error;
    }
    context_ = std::move(*context);
    const DeviceInfo& info = context_->device().info();
    deviceName_ = info.name + ", " + info.driver;
    meter_.emplace(*context_);
    auto display = Display::create(*context_, *window_, interface_->fonts(), mode);
    if (!display) return display.error();
    display_ = std::move(*display);
    return {};
  }

  void closeDevice() {
    session_->release();
    display_.reset();
    meter_.reset();
    context_.reset();
    picture_ = {};
    controls_.reset();  // what it holds may not be part of the snapshot
    dirty_ = true;
  }

  /// Opens a device after closeDevice() and continues on it from the last snapshot.
  Expected<void> reopenDevice(const std::string& device) {
    if (auto opened = openDevice(device, VK_PRESENT_MODE_FIFO_KHR); !opened) return opened;  // every device offers this mode
    if (std::ranges::find(display_->modes(), present_) != display_->modes().end()) display_->choose(present_);
    return session_->resume();
  }

  /// After a loss of the device: continues on a new one from the last snapshot. An error ends the program.
  Expected<void> recover(const Error& lost) {
    constexpr double kTooSoon = 10;  // s; what caused the first loss is likely to cause the next
    if (lostAt_s_ && now_s_ - *lostAt_s_ < kTooSoon) return Error{lost.kind, lost.message + "; it was lost a moment before, too"};
    lostAt_s_ = now_s_;
    interface_->skip();
    takeValidationMessages();
    closeDevice();
    Expected<void> opened = lost;
    for (int tries = 0; !opened && tries < 5; ++tries) {  // a driver that resets its device needs a moment
      if (tries > 0) std::this_thread::sleep_for(std::chrono::seconds(1));
      opened = reopenDevice(device_);
      if (!opened) closeDevice();
    }
    if (!opened) return Error{opened.error().kind, lost.message + "\nno new device: " + opened.error().message};
    char from[64];
    std::snprintf(from, sizeof from, "%.4g s", session_->runner().time_s());
    const std::string notice = lost.message + "\nThe simulation continues on " + deviceName_ + " from " + from;
    logError(notice);
    showMessage(notice);
    return {};
  }

  /// Continues on another device, or on the same one where that fails.
  Expected<void> changeDevice(const std::string& device) {
    if (auto kept = session_->keep(); !kept) return kept;
    takeValidationMessages();
    Expected<void> changed;
    for (const std::string& next : {device, device_}) {
      closeDevice();
      const auto opened = reopenDevice(next);
      if (changed) changed = opened;
      if (!opened) continue;
      device_ = next;
      window_->setTitle("Rill: " + sceneName_ + " (" + deviceName_ + ")");
      showMessage(changed ? "The simulation continues on " + deviceName_ : changed.error().message);
      return {};
    }
    return changed;
  }

  void takeValidationMessages() {
    if (!context_) return;  // no device could be opened
    for (const std::string& message : context_->takeMessages()) {
      logError(message);
      sawValidationMessage_ = true;
    }
  }

  /// Shows the error about a scene that is invalid at the start, until the file changes or another scene is opened.
  Expected<void> waitForValidFile(const fs::path& file, const Error& error) {
    logError(error.message);
    const auto empty = scenes_.find("empty");
    if (!empty) return error;
    if (auto opened = openScene(*empty); !opened) return opened;
    invalidFile_.emplace(file);
    showMessage(error.message + "\nThe scene opens as soon as the file is valid.");
    return {};
  }

  /// Checks the names in a script before it runs.
  Expected<void> validate(const ScriptLine& line) const {
    if (line.kind == ScriptLine::Kind::Scene)
      if (auto file = scenes_.find(line.name); !file) return file.error();
    const auto views = offline::Simulation::views();
    if (line.kind == ScriptLine::Kind::View && std::ranges::find(views, line.name) == views.end())
      return Error{ErrorKind::BadInput, "--script: unknown view " + inQuotes(line.name)};
    return {};
  }

  /// Opens a scene; the current one stays where that fails.
  Expected<void> openScene(const fs::path& file, std::vector<Override> changes = {}) {
    auto session = Session::open(*context_, file, std::move(changes));
    if (!session) return session.error();
    if (auto idle = context_->wait(); !idle) return idle;
    session_ = std::move(*session);
    invalidFile_.reset();
    sceneName_ = session_->scene().name;
    for (const std::string& name : sceneNames_)
      if (auto known = scenes_.find(name); known && *known == file) sceneName_ = name;
    window_->setTitle("Rill: " + sceneName_ + " (" + deviceName_ + ")");
    layOutWindow(window_->framebuffer());
    controls_.camera.home(homeView());
    onRestart();
    message_.clear();
    for (const std::string& warning : session_->runner().warnings()) message_ += (message_.empty() ? "" : "\n") + warning;
    return {};
  }

  void layOutWindow(Window::Size size) {
    layout_ = layOut(std::max(size.width, 4u), std::max(size.height, 4u), interface_->scale(), settings_.panels);
  }

  /// The scene's camera. Its field of view grows in an image narrower than 16:9, so that nothing is cut off at the sides.
  CameraView homeView() const {
    constexpr double kIntendedAspect = 16.0 / 9;
    const double aspect = double(layout_.picture.width) / layout_.picture.height;
    CameraView view = session_->camera(aspect);
    if (session_->scene().camera && aspect < kIntendedAspect) {
      const double half = view.fov_y_deg * std::numbers::pi / 360;
      view.fov_y_deg = std::atan(std::tan(half) * kIntendedAspect / aspect) * 360 / std::numbers::pi;
    }
    return view;
  }

  /// Resets what depends on the simulation, after it was started from the beginning.
  void onRestart() {
    playback_.restart();
    controls_.reset();
    picture_.restart();
    held_ = {};
    dirty_ = true;
  }

  Expected<void> loop() {
    Now::time_point before = Now::now();
    while (!window_->closing() && !apps::signalReceived() && !(options_.frames && frame_ >= *options_.frames)) {
      const double passed = secondsSince(before);
      before = Now::now();
      now_s_ += passed;
      const double seconds = options_.lockstep ? Clock::kStep : std::min(passed, 0.25);
      frameTime_ += 0.1 * (passed - frameTime_);
      if ((options_.frames || !script_.empty()) && frame_ > 0) frames_ms_.push_back(1e3 * passed);
      if (auto done = frame(seconds); !done) {
        if (done.error().kind != ErrorKind::DeviceLost) return done;
        if (auto recovered = recover(done.error()); !recovered) return recovered;
      }
      ++frame_;
      takeValidationMessages();
    }
    return context_->wait();
  }

  bool isBounded() const { return options_.frames || !script_.empty(); }
  /// True in the last frame of a run with --frames or a script.
  bool isLastFrame() const { return options_.frames ? frame_ + 1 == *options_.frames : !script_.empty() && nextLine_ == script_.size(); }

  Expected<void> frame(double seconds) {
    std::optional<fs::path> picture;
    // Nothing changes: wait for input instead of drawing the same frame again.
    const bool idle =
        settings_.paused && !interface_->waiting() && !dirty_ && !controls_.camera.moving() && !options_.frames && script_.empty();
    std::vector<InputEvent> events = window_->events(idle ? 0.1 : 0);
    if (auto done = replay(events, picture); !done) return done;
    if (options_.screenshot && isLastFrame()) picture = options_.screenshot;
    const Window::Size size = window_->framebuffer();
    for (const InputEvent& event : events) interface_->addEvent(event);
    for (const InputEvent& event : interface_->begin(seconds, std::max(size.width, 1u), std::max(size.height, 1u)))
      if (auto done = handle(event); !done) return done;
    if (screenshot_) picture = std::exchange(screenshot_, std::nullopt);
    if (session_->fileChanged(now_s_))
      if (auto done = reload(); !done) return done;
    if (invalidFile_ && invalidFile_->changed(now_s_)) {
      invalidFile_->acknowledge();
      if (auto done = report(openScene(fs::path(invalidFile_->file()), options_.overrides), ""); !done) return done;
    }

    if (noticeUntil_s_ && now_s_ > *noticeUntil_s_) showMessage("");
    if (auto done = simulate(seconds); !done) return done;

    if (size.width == 0 || size.height == 0) {  // minimized
      interface_->skip();
      if (picture && isBounded())
        return Error{ErrorKind::BadInput, inQuotes(picture->string()) + ": not written, because the window is minimized"};
      if (!options_.lockstep) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      return {};
    }
    if (auto fits = display_->fit(size); !fits) return fits;
    if (const Area before = layout_.picture; layOutWindow(size), layout_.picture != before) controls_.camera.reframe(homeView());
    controls_.camera.update(seconds);
    if (auto drawn = paint(); !drawn) return drawn;
    return draw(picture);
  }

  /// Simulates for this frame, about as long as the image takes to render, so that the window stays responsive.
  Expected<void> simulate(double seconds) {
    session_->runner().timePasses(settings_.panels);
    Playback::Frame frame{
        seconds, now_s_, std::clamp(picture_.seconds(), kMinPiece, kMaxPiece), settings_.paused, options_.lockstep, {}, now_s_ < keepAt_s_};
    if (settings_.view == "density")
      frame.measureEvery_s = 0;
    else if (settings_.panels)
      frame.measureEvery_s = kMeasureEvery;
    const auto ended = playback_.advance(session_->runner(), frame);
    if (!ended) return ended.error();
    dirty_ |= *ended;
    return *ended && now_s_ >= keepAt_s_ ? keepSnapshot() : Expected<void>();
  }

  /// A snapshot for recover(), so rarely that it takes a hundredth of the time.
  Expected<void> keepSnapshot() {
    constexpr double kInterval = 2, kShare = 0.01;  // s
    constexpr uint32_t kMaxKept = 2'000'000;        // particles; some 400 MiB of host memory
    if (!session_->runner().betweenSteps()) return {};
    const Now::time_point begin = Now::now();
    auto kept = session_->keep(kMaxKept);
    keepAt_s_ = now_s_ + std::max(kInterval, secondsSince(begin) / kShare);
    return kept;
  }

  Expected<void> paint() {
    const double scale = settings_.scale == 0 && options_.lockstep ? 1 : settings_.scale;
    auto drawn = picture_.paint(*display_, *session_, {settings_.view, controls_.camera.view(), layout_.picture, scale, dirty_});
    if (!drawn && !(drawn.error().kind == ErrorKind::BadInput && picture_.any())) return drawn;
    if (!drawn) showMessage(drawn.error().message);
    dirty_ = false;
    return {};
  }

  Expected<void> draw(const std::optional<fs::path>& picture) {
    Board board{*session_, *display_, *interface_, settings_, sceneNames_, sceneName_, deviceName_, playback_.histories(), held_, message_};
    board.layout = layout_;
    board.stats = playback_.stats();
    board.framesPerSecond = frameTime_ > 0 ? 1 / frameTime_ : 0;
    board.speed = playback_.speed();
    board.pictureScale = picture_.scale();
    board.picture_s = picture_.seconds();
    board.lockstep = options_.lockstep;
    board.devices = devices_;
    board.memory = meter_->at(now_s_);
    drawPanels(board);
    const ImDrawData& lists = interface_->end();
    offline::Image image;
    const bool dark = interface_->theme() == Theme::Dark;
    const ImVec4 behind = dark ? ImVec4(0.09f, 0.1f, 0.12f, 1) : ImVec4(0.86f, 0.88f, 0.9f, 1);
    for (int tries = 0; tries < 3; ++tries) {  // the swapchain may be out of date
      if (auto fits = display_->fit(window_->framebuffer()); !fits) return fits;
      if (auto shown = display_->show(lists, behind, picture ? &image : nullptr); !shown) return shown;
      if (!picture || image.width > 0) break;
    }
    if (picture) {
      const auto written = image.width > 0
                               ? apps::writePng(*picture, image)
                               : Error{ErrorKind::BadInput, inQuotes(picture->string()) + ": not written, because the window was resized"};
      if (!written && isBounded()) return written;
      if (auto reported = report(written, "The window was written to " + fs::absolute(*picture).string()); !reported) return reported;
    }
    return handle(board.requests);
  }

  /// Carries out the requests of the panels.
  Expected<void> handle(const Requests& requests) {
    if (requests.mode) {
      present_ = *requests.mode;
      display_->choose(present_);
    }
    if (requests.device)
      if (auto done = changeDevice(std::to_string(*requests.device)); !done) return done;
    if (requests.oneStep) oneStepAndPause();
    if (requests.save) save();
    if (requests.open)
      if (auto done = openNamed(requests.open->string()); !done) return done;
    if (requests.restart)
      if (auto done = restart(); !done) return done;
    if (requests.reset) return applied(session_->reset(*requests.reset), *requests.reset);
    return requests.change ? applied(session_->change(*requests.change), requests.change->key) : Expected<void>();
  }

  /// After a change of a key of the scene: redraws, resets after a restart, reports an error.
  Expected<void> applied(const Expected<void>& change, const std::string& key) {
    if (change && !session_->isLive(key)) onRestart();
    dirty_ = true;
    return report(change, "");
  }

  Expected<void> restart() {
    auto done = session_->restart();
    if (done) onRestart();
    return report(done, "");
  }

  /// Reads the changed file again. Where it is invalid the current scene continues.
  Expected<void> reload() {
    auto done = session_->reload();
    if (done) {
      onRestart();
      controls_.camera.reframe(homeView());
    }
    return report(done, session_->file().filename().string() + " has changed and was reloaded");
  }

  Expected<void> openNamed(const std::string& name) {
    auto file = scenes_.find(name);
    if (!file) return report(file.error(), "");
    return report(openScene(*file), "");
  }

  Expected<void> tilt(Tilt direction) {
    constexpr double kDegrees = 10;
    const Scene& scene = session_->scene();
    if (!session_->isLive("gravity")) {
      showMessage("The scene sets its gravity by gravity_changes; it cannot be tilted");
      return {};
    }
    if (std::ranges::all_of(scene.gravity, [](double a) { return a == 0; })) {
      showMessage("The scene has no gravity to tilt");
      return {};
    }
    const auto g = tilted(scene.gravity, controls_.camera.view(), direction, kDegrees);
    char text[96];
    std::snprintf(text, sizeof text, "[%.9g, %.9g, %.9g]", g[0], g[1], g[2]);
    return applied(session_->change({"gravity", text}), "gravity");
  }

  void oneStepAndPause() {
    settings_.paused = true;
    playback_.oneStep();
  }

  void save() {
    auto text = session_->text(fs::current_path());
    if (!text) return showMessage(text.error().message);
    const std::string stem = session_->scene().name + "-changed";
    fs::path file = stem + ".json";
    for (int k = 2; fs::exists(file); ++k) file = stem + "-" + std::to_string(k) + ".json";
    auto written = apps::writeFile(file, *text);
    showMessage(written ? "The scene was saved as " + fs::absolute(file).string() : written.error().message);
  }

  /// Shows `notice`, or the error in the window. Returns errors of the device, which end the program.
  Expected<void> report(const Expected<void>& done, const std::string& notice) {
    if (done) {
      if (notice.empty()) return {};
      showMessage(notice);
      noticeUntil_s_ = now_s_ + kNotice;
      return {};
    }
    const ErrorKind kind = done.error().kind;
    if (kind == ErrorKind::DeviceLost || kind == ErrorKind::Failed) return done;
    showMessage(done.error().message);
    return {};
  }
  void showMessage(const std::string& text) {
    message_ = apps::printable(text);
    noticeUntil_s_.reset();
  }

  Expected<void> handle(const InputEvent& event) {
    switch (event.kind) {
      case InputEvent::Kind::Move:
      case InputEvent::Kind::Button:
      case InputEvent::Kind::Wheel: {
        const auto handled = controls_.handle(event, layout_.picture, *session_, interface_->wantsMouse(), settings_.paused);
        if (event.kind == InputEvent::Kind::Button) dirty_ = true;
        return report(handled, "");
      }
      case InputEvent::Kind::Key:
        if (!event.down || interface_->wantsKeys() || (event.modifiers & GLFW_MOD_CONTROL)) return {};
        if (event.code == GLFW_KEY_ESCAPE) settings_.help = false;
        for (const KeyBinding& binding : keyBindings())
          if (binding.key == event.code) return perform(binding.action, event.modifiers & GLFW_MOD_SHIFT);
        return {};
      case InputEvent::Kind::Drop:
        return report(openScene(event.text), "");
      default:
        return {};
    }
  }

  Expected<void> perform(Action action, bool shift) {
    switch (action) {
      case Action::Pause:
        settings_.paused = !settings_.paused;
        break;
      case Action::OneStep:
        oneStepAndPause();
        break;
      case Action::Restart:
        return restart();
      case Action::PreviousScene:
        return openNamed(cycled(sceneNames_, sceneName_, -1));
      case Action::NextScene:
        return openNamed(cycled(sceneNames_, sceneName_, 1));
      case Action::NextView: {
        const auto views = offline::Simulation::views();
        settings_.view = cycled(std::vector<std::string>(views.begin(), views.end()), settings_.view, shift ? -1 : 1);
        break;
      }
      case Action::Throw: {
        const auto thrown = controls_.throwFluid(*session_, layout_.picture);
        if (!thrown) return report(thrown.error(), "");
        dirty_ = true;
        break;
      }
      case Action::Home:
        controls_.camera.home();
        break;
      case Action::Front:
        controls_.camera.look(AxisView::Front);
        break;
      case Action::Back:
        controls_.camera.look(AxisView::Back);
        break;
      case Action::Right:
        controls_.camera.look(AxisView::Right);
        break;
      case Action::Left:
        controls_.camera.look(AxisView::Left);
        break;
      case Action::Top:
        controls_.camera.look(AxisView::Top);
        break;
      case Action::Bottom:
        controls_.camera.look(AxisView::Bottom);
        break;
      case Action::TiltLeft:
        return tilt(Tilt::Left);
      case Action::TiltRight:
        return tilt(Tilt::Right);
      case Action::TiltAway:
        return tilt(Tilt::Away);
      case Action::TiltTowards:
        return tilt(Tilt::Towards);
      case Action::Panels:
        settings_.panels = !settings_.panels;
        break;
      case Action::Theme:
        interface_->setTheme(interface_->theme() == Theme::Dark ? Theme::Light : Theme::Dark);
        break;
      case Action::Screenshot: {
        fs::path file;
        for (int k = 1; file.empty() || fs::exists(file); ++k) file = "rill-view-" + std::to_string(k) + ".png";
        screenshot_ = file;
        break;
      }
      case Action::Help:
        settings_.help = !settings_.help;
        break;
    }
    return {};
  }

  /// The name `step` places after `name`, cyclic; the first one where `name` is not in the list.
  static std::string cycled(const std::vector<std::string>& names, const std::string& name, int step) {
    const auto at = std::ranges::find(names, name);
    if (at == names.end()) return names.empty() ? name : names.front();
    const auto count = static_cast<int>(names.size());
    return names[static_cast<size_t>((static_cast<int>(at - names.begin()) + step + count) % count)];
  }

  /// Executes the script's commands for this frame.
  Expected<void> replay(std::vector<InputEvent>& events, std::optional<fs::path>& picture) {
    for (; nextLine_ < script_.size() && script_[nextLine_].frame <= frame_; ++nextLine_) {
      const ScriptLine& line = script_[nextLine_];
      Expected<void> done;
      switch (line.kind) {
        case ScriptLine::Kind::Input:
          events.push_back(line.input);
          break;
        case ScriptLine::Kind::Set:
          done = applied(session_->change(line.change), line.change.key);
          break;
        case ScriptLine::Kind::Scene:
          done = openNamed(line.name);
          break;
        case ScriptLine::Kind::View:
          settings_.view = line.name;
          break;
        case ScriptLine::Kind::Resize:
          window_->resize(line.width, line.height);
          break;
        case ScriptLine::Kind::Minimize:
          window_->minimize(true);
          break;
        case ScriptLine::Kind::Restore:
          window_->minimize(false);
          break;
        case ScriptLine::Kind::Screenshot:
          picture = line.name;
          break;
      }
      if (!done) return done;
    }
    // Without --frames the program ends after the last line of the script.
    if (!script_.empty() && nextLine_ == script_.size() && !options_.frames) window_->close();
    return {};
  }

  /// Prints a summary of a run with --frames or a script.
  Expected<void> printSummary(double wall_s) {
    if (!options_.frames && script_.empty()) return {};
    auto& runner = session_->runner();
    if (!runner.betweenSteps())
      if (auto ended = runner.step(); !ended) return ended;
    auto hash = runner.hash();
    if (!hash) return hash.error();
    std::ranges::sort(frames_ms_);
    const auto frame_ms = [&](double share) {
      return frames_ms_.empty() ? 1e3 * wall_s : frames_ms_[static_cast<size_t>(share * static_cast<double>(frames_ms_.size() - 1))];
    };
    char text[600];  // a file name has up to 255
    std::snprintf(text, sizeof text,
                  "scene         %s\nframes        %llu\nsteps         %llu\ntime_s        %.9g\nwall_s        %.3f\n"
                  "frame_ms      %.1f\nframe_ms_p95  %.1f\nstate_hash    %016llx\n",
                  sceneName_.c_str(), static_cast<unsigned long long>(frame_), static_cast<unsigned long long>(runner.steps()),
                  runner.time_s(), wall_s, frame_ms(0.5), frame_ms(0.95), static_cast<unsigned long long>(*hash));
    return apps::writeStream(STDOUT_FILENO, apps::printable(text));
  }

  static void logError(const std::string& text) { apps::printMessage("rill-view", text); }

  const Options& options_;
  apps::SceneFolders scenes_;
  std::vector<std::string> sceneNames_;
  std::vector<ScriptLine> script_;
  size_t nextLine_ = 0;

  // In the order of their dependencies.
  std::unique_ptr<Window> window_;
  std::optional<offline::Context> context_;
  std::optional<MemoryMeter> meter_;
  std::unique_ptr<Interface> interface_;
  std::unique_ptr<Display> display_;
  std::unique_ptr<Session> session_;

  std::string device_;                           // as ContextDesc::device
  VkPresentModeKHR present_ = options_.present;  // as last chosen, whether the device offers it or not
  std::vector<offline::ListedDevice> devices_;
  std::string deviceName_, sceneName_, message_;
  Settings settings_;
  Layout layout_;
  Controls controls_;
  Playback playback_;
  Picture picture_;
  HeldEdit held_;
  bool dirty_ = true;  // the image must be drawn again
  bool sawValidationMessage_ = false;
  std::optional<double> noticeUntil_s_;
  std::optional<fs::path> screenshot_;    // to write after this frame
  std::optional<FileWatch> invalidFile_;  // the requested scene, until it or another one is opened
  uint64_t frame_ = 0;
  std::vector<double> frames_ms_;  // of a bounded run
  double now_s_ = 0, frameTime_ = 0;
  double keepAt_s_ = 0;             // when the next snapshot is due
  std::optional<double> lostAt_s_;  // the last loss of the device
};

}  // namespace

int runViewer(const Options& options) {
  if (!options.listDevices) return Viewer(options).run();
  offline::ContextDesc desc;
  if (Window::openDisplay()) {  // without one the devices are listed all the same
    desc.instanceExtensions = Window::instanceExtensions();
    desc.presents = Window::presents;
  }
  const auto devices = offline::findDevices(desc);
  Window::closeDisplay();
  const auto written = devices ? apps::writeStream(STDOUT_FILENO, apps::printable(offline::deviceTable(*devices))) : devices.error();
  if (written) return apps::kDone;
  apps::printMessage("rill-view", written.error().message);
  return devices ? apps::kFailed : apps::exitCodeBeforeRun(devices.error());
}

}  // namespace rill::view
