#include "view/surface_format.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "view/present_mode.hpp"

namespace rill::view {
namespace {

constexpr VkColorSpaceKHR kSrgb = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;

SurfaceFormat chosen(const std::vector<VkSurfaceFormatKHR>& offered) {
  const auto format = chooseSurfaceFormat(offered);
  EXPECT_TRUE(format);
  return format ? *format : SurfaceFormat{};
}

TEST(SurfaceFormat, PrefersUnormThenSrgbThenTenBits) {
  const VkSurfaceFormatKHR ten{VK_FORMAT_A2B10G10R10_UNORM_PACK32, kSrgb}, encoding{VK_FORMAT_B8G8R8A8_SRGB, kSrgb},
      unorm{VK_FORMAT_R8G8B8A8_UNORM, kSrgb};
  EXPECT_EQ(chosen({ten, encoding, unorm}).format, unorm.format);
  EXPECT_EQ(chosen({ten, encoding}).format, encoding.format);
  EXPECT_EQ(chosen({ten}).format, ten.format);
  EXPECT_TRUE(chosen({unorm}).isCanvas());
  EXPECT_FALSE(chosen({ten}).isCanvas());
  EXPECT_FALSE(chosen({ten}).encodes);
  EXPECT_TRUE(chosen({encoding}).encodes);
  EXPECT_EQ(chosen({encoding}).canvas, VK_FORMAT_R8G8B8A8_UNORM);
}

TEST(SurfaceFormat, RejectsOtherFormatsAndColorSpaces) {
  for (const std::vector<VkSurfaceFormatKHR>& offered : {std::vector<VkSurfaceFormatKHR>{},
                                                         {{VK_FORMAT_R5G6B5_UNORM_PACK16, kSrgb}},
                                                         {{VK_FORMAT_B8G8R8A8_UNORM, VK_COLOR_SPACE_HDR10_ST2084_EXT}}}) {
    const auto format = chooseSurfaceFormat(offered);
    ASSERT_FALSE(format);
    EXPECT_EQ(format.error().kind, ErrorKind::NoDevice);
    EXPECT_NE(format.error().message.find("SRGB_NONLINEAR"), std::string::npos);
  }
}

TEST(PresentMode, NamesAreParsedBack) {
  for (const VkPresentModeKHR mode :
       {VK_PRESENT_MODE_FIFO_KHR, VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR, VK_PRESENT_MODE_FIFO_RELAXED_KHR})
    EXPECT_EQ(presentModeNamed(presentModeName(mode)), mode);
  EXPECT_EQ(presentModeNamed("vsync"), std::nullopt);
  EXPECT_EQ(presentModeNamed(""), std::nullopt);
}

TEST(PresentMode, ModeThatIsNotOfferedIsNamedWithTheOthers) {
  const std::vector<VkPresentModeKHR> offered{VK_PRESENT_MODE_FIFO_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR};
  EXPECT_TRUE(checkPresentMode(VK_PRESENT_MODE_IMMEDIATE_KHR, offered));
  const auto mode = checkPresentMode(VK_PRESENT_MODE_MAILBOX_KHR, offered);
  ASSERT_FALSE(mode);
  EXPECT_EQ(mode.error().kind, ErrorKind::BadInput);
  EXPECT_NE(mode.error().message.find("\"mailbox\""), std::string::npos) << mode.error().message;
  EXPECT_NE(mode.error().message.find("fifo, immediate"), std::string::npos) << mode.error().message;
}

}  // namespace
}  // namespace rill::view
