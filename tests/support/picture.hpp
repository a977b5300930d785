#pragma once
// Reads PNG and PPM images and compares them.
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace rill::test {

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgb;  ///< sRGB, rows from the top; empty if the file could not be read
};
Picture readPicture(const std::filesystem::path& file);

struct Distance {
  double mean = 1;   ///< mean over all blocks
  double worst = 1;  ///< maximum over all blocks
};
/// RMS distance between the mean colors of blocks of `block` x `block` pixels, 0 (equal) to 1 (black and
/// white). Insensitive to shifts by a pixel, but not to missing shapes. 1 if the sizes differ.
Distance distance(const Picture& a, const Picture& b, uint32_t block = 10);

}  // namespace rill::test
