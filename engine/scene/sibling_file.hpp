#pragma once
#include <filesystem>
#include <string>

#include "rill/expected.hpp"

namespace rill {

/// Reads a file that `file` refers to by a relative path. BadInput for an absolute path, one with "..", or what readWholeFile() rejects.
Expected<std::string> readSibling(const std::filesystem::path& file, const std::string& name, uint64_t maxBytes);

}  // namespace rill
