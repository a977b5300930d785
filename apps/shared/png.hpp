#pragma once
#include <filesystem>

#include "rill/expected.hpp"
#include "rill/offline.hpp"

namespace rill::apps {

/// Writes an image as PNG, atomically; without an alpha channel where all pixels are opaque. Io, with the name of the file.
Expected<void> writePng(const std::filesystem::path& file, const offline::Image& image);

}  // namespace rill::apps
