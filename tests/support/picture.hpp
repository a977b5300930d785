#pragma once
// Pictures read back from PNG and PPM files, and how far apart two of them look.
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace rill::test {

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgb;  ///< sRGB, rows from the top; empty where the file is no picture
};
Picture readPicture(const std::filesystem::path& file);

struct Distance {
  double mean = 1;   ///< over blocks
  double worst = 1;  ///< of one block
};
/// Distances of the mean colors of blocks of `block` pixels, 0 (equal) to 1 (black and white): a particle that sits a pixel aside does not
/// count, a shape that is missing does. Pictures of different sizes are 1 apart.
Distance distance(const Picture& a, const Picture& b, uint32_t block = 10);

}  // namespace rill::test
