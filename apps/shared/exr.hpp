#pragma once
#include <filesystem>

#include "rill/expected.hpp"
#include "rill/offline.hpp"

namespace rill::apps {

/// False in a build without OpenEXR.
bool writesExr();

/// Writes an image as OpenEXR, atomically: channels R, G and B as half floats, ZIP compression. Io, with the name of the file; Failed in a
/// build without OpenEXR.
Expected<void> writeExr(const std::filesystem::path& file, const offline::LinearImage& image);

}  // namespace rill::apps
