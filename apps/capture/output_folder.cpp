#include "capture/output_folder.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/words.hpp"
#include "shared/atomic_file.hpp"

namespace rill::capture {
namespace fs = std::filesystem;
namespace {

bool isFrame(std::string_view name) {
  constexpr std::string_view prefix = "frame_";
  constexpr std::array<std::string_view, 10> extensions = {".png",      ".exr",      ".ply", ".whitewater.ply", ".mesh.ply", ".mesh.obj",
                                                           ".mesh.glb", ".mesh.vtp", ".vtu", ".whitewater.vtu"};
  if (!name.starts_with(prefix)) return false;
  name.remove_prefix(prefix.size());
  const size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return digits >= 5 && std::ranges::find(extensions, name.substr(digits)) != extensions.end();
}

}  // namespace

Expected<OutputFolder> OutputFolder::prepare(const fs::path& folder, bool keep) {
  if (auto made = apps::makeFolder("--out", folder); !made) return made.error();
  auto lock = apps::FolderLock::take(folder);
  if (!lock) return Error{lock.error().kind, "--out: " + lock.error().message};

  std::vector<fs::path> earlier;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    std::string_view target = name;
    if ((!keep && isFrame(name)) || (apps::isPartFile(name, target) && isFrame(target))) earlier.push_back(entry->path());
  }
  if (failed) return Error{ErrorKind::BadInput, "--out: can't read the folder " + inQuotes(folder.string()) + ": " + failed.message()};
  for (const fs::path& file : earlier) {
    fs::remove(file, failed);
    if (failed)
      return Error{ErrorKind::BadInput,
                   "--out: can't remove " + inQuotes(file.string()) + ", a frame of an earlier capture: " + failed.message()};
  }
  return OutputFolder(folder, std::move(*lock));
}

fs::path OutputFolder::frame(uint32_t number, const char* extension) const {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%05u.%s", number, extension);
  return folder_ / name;
}

}  // namespace rill::capture
