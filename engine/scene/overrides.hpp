#pragma once
// `--set KEY=VALUE`: changes to a scene's JSON before it is judged, and who to blame in messages afterwards.
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "rill/scene_io.hpp"
#include "scene/json_text.hpp"

namespace rill {

/// Which parts of the JSON come from overrides.
class OverrideMarks {
 public:
  struct Mark {
    std::string key;   ///< as given to --set
    std::string text;  ///< the value as given; empty on objects and lists made on the way to it
  };

  void set(const std::string& path, Mark mark) { marks_[path] = std::move(mark); }
  /// The override that made `path` or the nearest thing around it; null where the file did.
  const Mark* find(std::string_view path) const;
  /// The override whose value stands at exactly this path.
  const Mark* valueAt(const std::string& path) const;

 private:
  std::map<std::string, Mark, std::less<>> marks_;
};

/// Applies one override after another to `root`. BadInput naming the override for a key path that leads nowhere or a broken value.
/// Whether a key is known and a value is right is judged later, with the rest of the scene.
Expected<void> applyOverrides(Json& root, std::span<const Override> overrides, OverrideMarks& marks);

}  // namespace rill
