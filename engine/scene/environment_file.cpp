// Environment maps from files. The size is checked before anything is decoded.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <span>
#include <string>

#include "core/words.hpp"
#include "rill/scene_io.hpp"
#include "scene/json_text.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_HDR
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace rill {
namespace {

constexpr uint64_t kMaxFileBytes = uint64_t{256} << 20;  // above any supported image

/// Pixels that stb_image has allocated.
template <class T>
using Pixels = std::unique_ptr<T, decltype([](T* pixels) { stbi_image_free(pixels); })>;

/// Linear values of the sRGB bytes (IEC 61966-2-1).
std::array<float, 256> linearBytes() {
  std::array<float, 256> table;
  for (size_t byte = 0; byte < table.size(); ++byte) {
    const double c = static_cast<double>(byte) / 255;
    table[byte] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return table;
}

/// Whether a Radiance image without run-length encoding has too few bytes, which stb_image does not detect.
bool isTruncatedFlatImage(std::string_view bytes, uint64_t pixels) {
  const size_t header = bytes.find("\n\n");
  const size_t line = header == std::string_view::npos ? header : bytes.find('\n', header + 2);
  if (line == std::string_view::npos) return true;
  const std::string_view rows = bytes.substr(line + 1);
  const bool runs = rows.starts_with("\x02\x02") && rows.size() > 2 && static_cast<uint8_t>(rows[2]) < 128;
  return !runs && rows.size() < 4 * pixels;
}

Expected<EnvironmentPicture> decode(std::string_view bytes) {
  const auto bad = [](std::string text) { return Error{ErrorKind::BadInput, std::move(text)}; };
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) return bad("not an image; expected a .hdr, .png or .jpg file");
  if (auto fits = checkEnvironmentSize(static_cast<uint64_t>(width), static_cast<uint64_t>(height)); !fits) return fits.error();
  const auto decodingError = [&] { return bad(std::string("can't be decoded: ") + stbi_failure_reason()); };
  const bool radiance = stbi_is_hdr_from_memory(data, size) != 0;
  if (radiance && isTruncatedFlatImage(bytes, static_cast<uint64_t>(width) * static_cast<uint64_t>(height)))
    return bad("the image data is truncated");
  EnvironmentPicture picture{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
  picture.texels.resize(size_t{picture.width} * picture.height);
  if (radiance) {
    const Pixels<float> rgb(stbi_loadf_from_memory(data, size, &width, &height, &channels, 3));
    if (!rgb) return decodingError();
    for (size_t k = 0; k < picture.texels.size(); ++k)
      picture.texels[k] = sharedExponent(rgb.get()[3 * k], rgb.get()[3 * k + 1], rgb.get()[3 * k + 2]);
    return picture;
  }
  const Pixels<stbi_uc> rgb(stbi_load_from_memory(data, size, &width, &height, &channels, 3));
  if (!rgb) return decodingError();
  const std::array<float, 256> linear = linearBytes();
  for (size_t k = 0; k < picture.texels.size(); ++k)
    picture.texels[k] = sharedExponent(linear[rgb.get()[3 * k]], linear[rgb.get()[3 * k + 1]], linear[rgb.get()[3 * k + 2]]);
  return picture;
}

}  // namespace

Expected<EnvironmentPicture> loadEnvironment(const std::filesystem::path& file) {
  try {
    const auto bytes = readWholeFile(file, kMaxFileBytes);
    if (!bytes) return bytes.error();
    auto picture = decode(*bytes);
    if (picture) return picture;
    return Error{picture.error().kind, file.string() + ": " + picture.error().message};
  } catch (const std::bad_alloc&) { return Error{ErrorKind::OutOfMemory, file.string() + ": not enough memory to read the image"}; }
}

}  // namespace rill
