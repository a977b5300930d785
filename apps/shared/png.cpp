#include "shared/png.hpp"

#include <cstddef>
#include <vector>

#include "shared/atomic_file.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace rill::apps {

Expected<void> writePng(const std::filesystem::path& file, const offline::Image& image) {
  const size_t pixels = size_t{image.width} * image.height;
  if (pixels == 0 || image.rgba.size() != 4 * pixels)
    return Error{ErrorKind::Failed, "can't write " + file.string() + ": the image is empty"};

  bool opaque = true;
  for (size_t i = 0; i < pixels && opaque; ++i) opaque = image.rgba[4 * i + 3] == 255;
  std::vector<uint8_t> rgb;
  if (opaque) {
    rgb.resize(3 * pixels);
    for (size_t i = 0; i < pixels; ++i)
      for (size_t c = 0; c < 3; ++c) rgb[3 * i + c] = image.rgba[4 * i + c];
  }
  const int channels = opaque ? 3 : 4;
  const void* data = opaque ? rgb.data() : image.rgba.data();

  std::vector<std::byte> png;
  const auto append = [](void* target, void* bytes, int size) {
    const auto* first = static_cast<const std::byte*>(bytes);
    static_cast<std::vector<std::byte>*>(target)->insert(static_cast<std::vector<std::byte>*>(target)->end(), first, first + size);
  };
  stbi_write_force_png_filter = 1;  // trying all five filters is slower and saves nothing: docs/notes/programs.md
  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  if (!stbi_write_png_to_func(append, &png, width, height, channels, data, width * channels))
    return Error{ErrorKind::OutOfMemory, "can't encode " + file.string() + ": out of memory"};
  return writeFile(file, png);
}

}  // namespace rill::apps
