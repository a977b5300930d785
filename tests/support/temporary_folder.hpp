#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "shared/temporary_folder.hpp"

namespace rill::test {

/// A temporary folder, removed by the destructor.
class TemporaryFolder {
 public:
  const std::filesystem::path& path() const { return folder_->path(); }
  std::string string() const { return path().string(); }
  std::filesystem::path operator/(const std::string& name) const { return path() / name; }

  /// Sorted names of the folder's entries, including hidden ones.
  std::vector<std::string> names() const { return namesIn(path()); }
  static std::vector<std::string> namesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    std::error_code failed;
    for (std::filesystem::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
      names.push_back(entry->path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name, std::ios::binary) << text;
    return path() / name;
  }

 private:
  Expected<apps::TemporaryFolder> folder_ = apps::TemporaryFolder::make();
};

inline std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace rill::test
