#include "shared/scene_folders.hpp"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "core/words.hpp"
#include "shared/words.hpp"

namespace rill::apps {
namespace fs = std::filesystem;

SceneFolders SceneFolders::standard() {
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("RILL_SCENES"); named && *named) folders.emplace_back(named);
  std::error_code failed;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", failed); !failed)
    folders.push_back(program.parent_path().parent_path() / "share" / "rill" / "scenes");
  folders.emplace_back(RILL_SOURCE_SCENES);
  return SceneFolders(std::move(folders));
}

std::vector<std::string> SceneFolders::names() const {
  std::vector<std::string> names;
  for (const fs::path& folder : folders_) {
    std::error_code failed;
    for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, failed), end;
         !failed && entry != end; entry.increment(failed)) {
      const fs::path& file = entry->path();
      std::error_code ignored;
      if (file.extension() != ".json" || file.filename().string().ends_with(".schema.json") || !fs::is_regular_file(file, ignored))
        continue;
      names.push_back(file.lexically_relative(folder).replace_extension().generic_string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Expected<fs::path> SceneFolders::find(const std::string& scene) const {
  std::error_code ignored;
  const fs::path asPath(scene);
  if (asPath.extension() == ".json" || fs::is_regular_file(asPath, ignored)) return asPath;
  const std::vector<std::string> known = names();
  if (std::find(known.begin(), known.end(), scene) != known.end())
    for (const fs::path& folder : folders_)
      if (const fs::path file = folder / (scene + ".json"); fs::is_regular_file(file, ignored)) return file;

  std::string message = "there is no scene " + inQuotes(scene) + didYouMean(scene, known);
  if (known.empty()) {
    message += "\nno scenes were found in";
    for (const fs::path& folder : folders_) message += " " + folder.string();
  } else {
    message += "\nscenes: " + joined(known);
  }
  return Error{ErrorKind::BadInput, message + "\nor give the path of a .json file"};
}

}  // namespace rill::apps
