#pragma once
// `--set KEY=VALUE`: changes a scene's JSON before it is validated, and records which values messages must attribute to an override.
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "rill/scene_io.hpp"
#include "scene/json_text.hpp"

namespace rill {

/// The parts of the JSON that overrides have set.
class OverrideMarks {
 public:
  struct Mark {
    std::string key;   ///< as given to --set
    std::string text;  ///< the value as given; empty for parent objects and lists that were created for it
  };

  void set(const std::string& path, Mark mark) { marks_[path] = std::move(mark); }
  /// The override that set `path` or its nearest ancestor; null if the value comes from the file.
  const Mark* find(std::string_view path) const;
  /// The override that set exactly this path, or null.
  const Mark* valueAt(const std::string& path) const;

 private:
  std::map<std::string, Mark, std::less<>> marks_;
};

/// Applies the overrides to `root` in order. BadInput naming the override for a malformed key path or value.
/// Unknown keys and invalid values are found later, when the scene is read.
Expected<void> applyOverrides(Json& root, std::span<const Override> overrides, OverrideMarks& marks);

}  // namespace rill
