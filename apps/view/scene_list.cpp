#include "view/scene_list.hpp"

#include "view/cycled.hpp"
#include "view/log_error.hpp"

namespace rill::view {

Expected<void> SceneList::open(const std::filesystem::path& file, std::vector<Override> changes) {
  if (auto opened = shown_.open(file, std::move(changes)); !opened) return opened;
  awaited_.reset();
  openName_ = shown_.session().scene().name;
  for (const std::string& name : names_)
    if (auto known = folders_.find(name); known && *known == file) openName_ = name;
  return {};
}

Expected<void> SceneList::openNamed(const std::string& scene) {
  auto file = folders_.find(scene);
  return message_.report(file ? open(*file) : file.error());
}

Expected<void> SceneList::openDropped(const std::filesystem::path& file) { return message_.report(open(file)); }

Expected<void> SceneList::openNext(int step) { return openNamed(cycled(names_, openName_, step)); }

Expected<void> SceneList::waitForValidFile(const std::filesystem::path& file, std::vector<Override> changes, const Error& error) {
  logError(error.message);
  const auto empty = folders_.find("empty");
  if (!empty) return error;
  if (auto opened = open(*empty); !opened) return opened;
  awaited_ = Awaited{FileWatch(file), std::move(changes)};
  message_.show(error.message + "\nThe scene opens as soon as the file is valid.");
  return {};
}

Expected<void> SceneList::openIfChanged(double now_s) {
  if (!awaited_ || !awaited_->watch.changed(now_s)) return {};
  awaited_->watch.acknowledge();
  const Awaited awaited = *awaited_;  // open() ends the wait
  return message_.report(open(awaited.watch.file(), awaited.changes));
}

}  // namespace rill::view
