#include "scene/sibling_file.hpp"

#include <algorithm>

#include "core/words.hpp"
#include "scene/json_text.hpp"

namespace rill {

Expected<std::string> readSibling(const std::filesystem::path& file, const std::string& name, uint64_t maxBytes) {
  constexpr size_t kMaxName = 1024;
  const std::filesystem::path path = name.size() > kMaxName ? std::string() : name;
  const bool below = !path.empty() && !path.has_root_path() && std::find(path.begin(), path.end(), "..") == path.end() &&
                     name.find('\\') == std::string::npos && name.find('\0') == std::string::npos;
  if (!below)
    return Error{ErrorKind::BadInput, "found the path " + inQuotes(name) + ", expected a relative one without \"..\" or backslashes"};
  return readWholeFile(file.parent_path() / path, maxBytes);
}

}  // namespace rill
