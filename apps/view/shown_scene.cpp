#include "view/shown_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace rill::view {
namespace {

constexpr double kMinPiece = 0.012, kMaxPiece = 0.05;  // s of simulation per displayed frame
constexpr double kMeasureEvery = 0.25;                 // s; measuring costs a pass over all neighbors

}  // namespace

Expected<void> ShownScene::open(const std::filesystem::path& file, std::vector<Override> changes) {
  auto session = Session::open(graphics_.context(), file, std::move(changes));
  if (!session) return session.error();
  if (auto idle = graphics_.context().wait(); !idle) return idle;
  session_ = std::move(*session);
  layOut(window_.framebuffer());
  controls_.camera.home(homeView());
  onRestart();
  std::string warnings;
  for (const std::string& warning : session_->runner().warnings()) warnings += (warnings.empty() ? "" : "\n") + warning;
  message_.show(warnings);
  return {};
}

/// The scene's camera. Its field of view grows in an image narrower than 16:9, so that nothing is cut off at the sides.
CameraView ShownScene::homeView() const {
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
void ShownScene::onRestart() {
  playback_.restart();
  controls_.reset();
  picture_.restart();
  held_ = {};
  dirty_ = true;
}

Expected<void> ShownScene::restart() {
  auto done = session_->restart();
  if (done) onRestart();
  return message_.report(done);
}

Expected<void> ShownScene::reloadIfChanged(double now_s) {
  if (!session_->fileChanged(now_s)) return {};
  auto done = session_->reload();
  if (done) {
    onRestart();
    controls_.camera.reframe(homeView());
  }
  return message_.report(done, session_->file().filename().string() + " has changed and was reloaded");
}

/// After a change of a key of the scene: redraws, resets after a restart, reports an error.
Expected<void> ShownScene::applied(const Expected<void>& change, const std::string& key) {
  if (change && !session_->isLive(key)) onRestart();
  dirty_ = true;
  return message_.report(change);
}

Expected<void> ShownScene::change(const Override& change) { return applied(session_->change(change), change.key); }

Expected<void> ShownScene::reset(const std::string& key) { return applied(session_->reset(key), key); }

Expected<void> ShownScene::tilt(Tilt direction) {
  constexpr double kDegrees = 10;
  const Scene& scene = session_->scene();
  if (!session_->isLive("gravity")) {
    message_.show("The scene sets its gravity by gravity_changes; it cannot be tilted");
    return {};
  }
  if (std::ranges::all_of(scene.gravity, [](double a) { return a == 0; })) {
    message_.show("The scene has no gravity to tilt");
    return {};
  }
  const auto g = tilted(scene.gravity, controls_.camera.view(), direction, kDegrees);
  char text[96];
  std::snprintf(text, sizeof text, "[%.9g, %.9g, %.9g]", g[0], g[1], g[2]);
  return change({"gravity", text});
}

std::string ShownScene::pouredFluid() const {
  return fluidIndex(session_->scene(), settings_.poured) < kMaxFluids ? settings_.poured : std::string();
}

Expected<void> ShownScene::throwFluid() {
  const auto thrown = controls_.throwFluid(*session_, layout_.picture, pouredFluid());
  if (!thrown) return message_.report(thrown.error());
  dirty_ = true;
  return {};
}

Expected<void> ShownScene::throwCrate() {
  const auto thrown = controls_.throwCrate(*session_, layout_.picture);
  dirty_ = true;
  return message_.report(thrown);
}

Expected<void> ShownScene::openTap() {
  const auto opened = controls_.openTap(*session_, layout_.picture, settings_.tapFlow, pouredFluid());
  dirty_ = true;
  return message_.report(opened);
}

Expected<void> ShownScene::changeDensity(uint32_t solid, double density) {
  dirty_ = true;
  return message_.report(session_->changeDensity(solid, density));
}

void ShownScene::pauseAfterOneStep() {
  settings_.paused = true;
  playback_.oneStep();
}

Expected<void> ShownScene::handle(const InputEvent& event, bool overPanels) {
  const auto handled = controls_.handle(event, layout_.picture, *session_, overPanels, settings_.paused);
  if (event.kind == InputEvent::Kind::Button) dirty_ = true;
  return message_.report(handled);
}

void ShownScene::layOut(Window::Size size) {
  const Area before = layout_.picture;
  layout_ = rill::view::layOut(std::max(size.width, 4u), std::max(size.height, 4u), interface_.scale(), settings_.panels);
  if (layout_.picture != before) controls_.camera.reframe(homeView());
}

Expected<void> ShownScene::simulate(double seconds, double now_s) {
  session_->runner().timePasses(settings_.panels);
  Playback::Frame frame;
  frame.passed_s = seconds;
  frame.now_s = now_s;
  frame.budget_s = std::clamp(picture_.seconds(), kMinPiece, kMaxPiece);
  frame.paused = settings_.paused;
  frame.lockstep = lockstep_;
  frame.body = settings_.body;
  frame.queues = !snapshots_.due(now_s);
  if (settings_.view == "density")
    frame.measureEvery_s = 0;
  else if (settings_.panels)
    frame.measureEvery_s = kMeasureEvery;
  const auto ended = playback_.advance(session_->runner(), frame);
  if (!ended) return ended.error();
  dirty_ |= *ended;
  return *ended && snapshots_.due(now_s) ? snapshots_.take(*session_, now_s) : Expected<void>();
}

Expected<void> ShownScene::paint(double seconds) {
  controls_.camera.update(seconds);
  const double scale = settings_.scale == 0 && lockstep_ ? 1 : settings_.scale;
  auto drawn = picture_.paint(graphics_.display(), *session_,
                              {settings_.view, controls_.camera.view(), layout_.picture, settings_.exposure_stops, scale, dirty_});
  if (!drawn && !(drawn.error().kind == ErrorKind::BadInput && picture_.any())) return drawn;
  if (!drawn) message_.show(drawn.error().message);
  dirty_ = false;
  return {};
}

void ShownScene::release() {
  session_->release();
  picture_ = {};
  controls_.reset();  // what it holds may not be part of the snapshot
  dirty_ = true;
}

}  // namespace rill::view
