#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rill/expected.hpp"

namespace rill::apps {

/// Where scenes that are named without a path are looked up.
class SceneFolders {
 public:
  explicit SceneFolders(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}
  /// In this order: RILL_SCENES in the environment, share/rill/scenes beside the program's bin folder, the sources that it was built from.
  static SceneFolders standard();

  /// Names of the scenes there are, sorted, without extension ("validation/martin-moyce-1").
  std::vector<std::string> names() const;

  /// A path to a scene file: an existing file, or what ends in ".json", is taken as it is, anything else is looked up by name.
  /// BadInput with the list and the nearest name for one that is unknown.
  Expected<std::filesystem::path> find(const std::string& scene) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace rill::apps
