#pragma once
#include <stdlib.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "rill/expected.hpp"

namespace rill::apps {

/// A temporary folder that is removed with its content by the destructor.
class TemporaryFolder {
 public:
  /// Io, with the path, where it cannot be created.
  static Expected<TemporaryFolder> make() {
    std::error_code failed;
    std::string pattern = (std::filesystem::temp_directory_path(failed) / ("rill-" + std::string(6, 'X'))).string();
    if (failed || ::mkdtemp(pattern.data()) == nullptr) return Error{ErrorKind::Io, "can't create a temporary folder " + pattern};
    return TemporaryFolder(pattern);
  }
  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace rill::apps
