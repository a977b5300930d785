#include "support/picture.hpp"

#include <algorithm>
#include <cmath>

#include "support/temporary_folder.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_PNM
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace rill::test {
namespace {

std::array<double, 3> meanColor(const Picture& picture, uint32_t x0, uint32_t y0, uint32_t block) {
  std::array<double, 3> sum{};
  const uint32_t x1 = std::min(x0 + block, picture.width), y1 = std::min(y0 + block, picture.height);
  for (uint32_t y = y0; y < y1; ++y)
    for (uint32_t x = x0; x < x1; ++x)
      for (size_t c = 0; c < 3; ++c) sum[c] += picture.rgb[3 * (size_t{y} * picture.width + x) + c];
  for (double& channel : sum) channel /= 255.0 * (x1 - x0) * (y1 - y0);
  return sum;
}

}  // namespace

Picture readPicture(const std::filesystem::path& file) {
  const std::string bytes = contentOf(file);
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels =
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width, &height, &channels, 3);
  if (!pixels) return {};
  Picture picture{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
  picture.rgb.assign(pixels, pixels + size_t{3} * picture.width * picture.height);
  stbi_image_free(pixels);
  return picture;
}

Distance distance(const Picture& a, const Picture& b, uint32_t block) {
  if (a.width != b.width || a.height != b.height || a.rgb.empty() || b.rgb.empty()) return {};
  Distance result{0, 0};
  uint32_t blocks = 0;
  for (uint32_t y = 0; y < a.height; y += block)
    for (uint32_t x = 0; x < a.width; x += block, ++blocks) {
      const auto p = meanColor(a, x, y, block), q = meanColor(b, x, y, block);
      const double apart = std::sqrt(((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2])) / 3);
      result.mean += apart;
      result.worst = std::max(result.worst, apart);
    }
  result.mean /= blocks;
  return result;
}

}  // namespace rill::test
