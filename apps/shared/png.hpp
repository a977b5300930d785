#pragma once
#include <filesystem>

#include "rill/expected.hpp"
#include "rill/offline.hpp"

namespace rill::apps {

/// Writes an image as a PNG, whole or not at all; without an alpha channel where it is opaque everywhere. Io, naming the file.
Expected<void> writePng(const std::filesystem::path& file, const offline::Image& image);

}  // namespace rill::apps
