#pragma once
// Parses bytes to a JSON value. Checks encoding, duplicate keys and nesting depth, and reports errors with line and column.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "rill/expected.hpp"

namespace rill {

using Json = nlohmann::json;

/// Largest size of a scene file in bytes.
inline constexpr uint64_t kMaxSceneBytes = 16ULL << 20;
/// Largest nesting depth of arrays and objects.
inline constexpr size_t kMaxJsonDepth = 256;

/// Reads a regular file of at most `maxBytes` bytes. BadInput (missing, not a regular file, too large, not readable) or Io.
Expected<std::string> readWholeFile(const std::filesystem::path& file, uint64_t maxBytes);

/// `text` as JSON with comments. A BOM is skipped. BadInput with "name:line:column: found; expected".
Expected<Json> parseJsonText(std::string_view text, std::string_view name);

}  // namespace rill
