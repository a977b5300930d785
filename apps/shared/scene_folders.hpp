#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rill/expected.hpp"

namespace rill::apps {

/// Folders in which scenes are found by name.
class SceneFolders {
 public:
  explicit SceneFolders(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}
  /// In this order: the environment variable RILL_SCENES, share/rill/scenes next to the program's bin folder, the source
  /// tree that it was built from.
  static SceneFolders standard();

  /// Names of all scenes, sorted, without extension ("validation/martin-moyce-1").
  std::vector<std::string> names() const;

  /// The path of a scene file. An existing file and a name that ends in ".json" are returned unchanged, anything else is
  /// looked up by name. BadInput with the list of scenes and the nearest name where it is unknown.
  Expected<std::filesystem::path> find(const std::string& scene) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace rill::apps
