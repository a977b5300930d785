#include "view/panel_requests.hpp"

#include <filesystem>

#include "shared/atomic_file.hpp"

namespace rill::view {
namespace {

namespace fs = std::filesystem;

/// Writes the scene with its changes to a new file in the current folder.
void save(const Session& session, MessageBox& message) {
  auto text = session.text(fs::current_path());
  if (!text) return message.show(text.error().message);
  const std::string stem = session.scene().name + "-changed";
  fs::path file = stem + ".json";
  for (int k = 2; fs::exists(file); ++k) file = stem + "-" + std::to_string(k) + ".json";
  auto written = apps::writeFile(file, *text);
  message.show(written ? "The scene was saved as " + fs::absolute(file).string() : written.error().message);
}

}  // namespace

Expected<void> carryOut(const Requests& requests, Graphics& graphics, ShownScene& shown, SceneList& scenes, DeviceChange& devices,
                        MessageBox& message) {
  if (requests.mode) graphics.choose(*requests.mode);
  if (requests.device)
    if (auto done = devices.change(std::to_string(*requests.device)); !done) return done;
  if (requests.oneStep) shown.pauseAfterOneStep();
  if (requests.save) save(shown.session(), message);
  if (requests.open)
    if (auto done = scenes.openNamed(requests.open->string()); !done) return done;
  if (requests.restart)
    if (auto done = shown.restart(); !done) return done;
  if (requests.density)
    if (auto done = shown.changeDensity(requests.density->solid, requests.density->density); !done) return done;
  if (requests.emitter) shown.session().runner().setEmitter(*requests.emitter);
  if (requests.reset) return shown.reset(*requests.reset);
  return requests.change ? shown.change(*requests.change) : Expected<void>();
}

}  // namespace rill::view
