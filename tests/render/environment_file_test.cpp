// Environment maps from files.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "render/environment_pictures.hpp"
#include "rill/scene_io.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace environment_test {

/// A Radiance picture without run lengths: the same four bytes for each pixel.
std::string radiance(int width, int height, const std::string& rgbe, int pixels) {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  for (int k = 0; k < pixels; ++k) text += rgbe;
  return text;
}

/// Big-endian, as PNG has its numbers.
std::string word(uint32_t value) { return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)}; }
/// A PNG whose pixels all have one color. Checksums are omitted, because stb_image ignores them.
std::string png(uint32_t width, uint32_t height, const std::string& rgb) {
  std::string rows;
  for (uint32_t y = 0; y < height; ++y) {
    rows += '\0';
    for (uint32_t x = 0; x < width; ++x) rows += rgb;
  }
  const auto chunk = [](const std::string& name, const std::string& data) { return word(uint32_t(data.size())) + name + data + word(0); };
  const uint16_t length = uint16_t(rows.size()), inverse = uint16_t(~length);
  const std::string stored = {'\x78', '\x01', '\x01', char(length & 255), char(length >> 8), char(inverse & 255), char(inverse >> 8)};
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", word(width) + word(height) + std::string("\x08\x02\0\0\0", 5)) +
         chunk("IDAT", stored + rows + word(0)) + chunk("IEND", "");
}

TEST(SharedExponent, KeepsNineBitsAndAcceptsAnyFloat) {
  EXPECT_EQ(unpacked(sharedExponent(1, 0.5f, 0.25f)), (Rgb{1, 0.5, 0.25}));
  EXPECT_EQ(unpacked(sharedExponent(0, 0, 0)), (Rgb{0, 0, 0}));
  for (const float value : {1e-4f, 0.0311f, 0.9999f, 3.3f, 511.6f, 32767.9f}) {
    const Rgb back = unpacked(sharedExponent(value, value / 3, 0));
    EXPECT_NEAR(back[0], value, value / 500) << value;
    EXPECT_NEAR(back[1], value / 3, value / 500);
    EXPECT_EQ(back[2], 0);
  }
  const float infinite = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(unpacked(sharedExponent(infinite, none, -3)), (Rgb{32768, 0, 0}));
}

TEST(LoadEnvironment, ReadsRadianceLinearlyAndBytesAsSrgb) {
  const TemporaryFolder folder;
  const auto hdr = loadEnvironment(folder.write("a.hdr", radiance(4, 2, {'\x80', '\x40', '\x20', '\x82'}, 8)));
  ASSERT_TRUE(hdr) << hdr.error().message;
  EXPECT_EQ(hdr->width, 4u);
  EXPECT_EQ(hdr->height, 2u);
  ASSERT_EQ(hdr->texels.size(), 8u);
  for (const uint32_t texel : hdr->texels) EXPECT_EQ(unpacked(texel), (Rgb{2, 1, 0.5}));
  const auto bytes = loadEnvironment(folder.write("a.png", png(2, 1, {'\xFF', '\x80', '\0'})));
  ASSERT_TRUE(bytes) << bytes.error().message;
  ASSERT_EQ(bytes->texels.size(), 2u);
  const Rgb linear = unpacked(bytes->texels[1]);
  EXPECT_EQ(linear[0], 1);
  EXPECT_NEAR(linear[1], 0.21586, 1.0 / 512);
  EXPECT_EQ(linear[2], 0);
}

TEST(LoadEnvironment, ErrorsNameTheFile) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& content) {
    const auto file = folder.write("sky.hdr", content);
    const auto read = loadEnvironment(file);
    if (read) return std::string("taken");
    EXPECT_EQ(read.error().kind, ErrorKind::BadInput);
    EXPECT_EQ(read.error().message.rfind(file.string() + ": ", 0), 0u) << read.error().message;
    return read.error().message.substr(file.string().size() + 2);
  };
  EXPECT_EQ(said(""), "not an image; expected a .hdr, .png or .jpg file");
  EXPECT_EQ(said("{}"), "not an image; expected a .hdr, .png or .jpg file");
  EXPECT_EQ(said(radiance(3, 2, "abcd", 6)), "found 3x2 pixels; expected twice as wide as high, at most 8192x4096");
  EXPECT_EQ(said(radiance(16384, 8192, "abcd", 1)), "found 16384x8192 pixels; expected twice as wide as high, at most 8192x4096");
  EXPECT_EQ(said(radiance(4, 2, "abcd", 7)), "the image data is truncated");
  const std::string whole = png(64, 32, "abc");
  EXPECT_EQ(said(whole), "taken");
  EXPECT_EQ(said(whole.substr(0, whole.size() / 2)).rfind("can't be decoded: ", 0), 0u);
  EXPECT_FALSE(loadEnvironment(folder / "none.hdr"));
  EXPECT_FALSE(loadEnvironment(folder.path()));
}

}  // namespace environment_test
}  // namespace rill::test
