#pragma once
// From bytes to a JSON value: encodings, comments, duplicate keys and depth are judged here, with line and column.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "rill/expected.hpp"

namespace rill {

using Json = nlohmann::json;

/// The most bytes that a scene file may have.
inline constexpr uint64_t kMaxSceneBytes = 16ULL << 20;
/// The most levels of [ and { inside each other.
inline constexpr size_t kMaxJsonDepth = 256;

/// The bytes of a regular file of at most `most` bytes. BadInput (missing, not a regular file, too large, not readable) or Io.
Expected<std::string> readWholeFile(const std::filesystem::path& file, uint64_t most);

/// `text` as JSON with comments. A BOM is skipped. BadInput with "name:line:column: what, expected what".
Expected<Json> parseJsonText(std::string_view text, std::string_view name);

}  // namespace rill
