// Which device --device stands for.
#include "offline/device_choice.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rill::test {
namespace device_choice_test {

const std::vector<std::string> kNames = {"NVIDIA GeForce RTX 4070", "NVIDIA GeForce RTX 4070 Ti", "Intel(R) Arc(tm) A770",
                                         "Intel(R) Arc(tm) A770", "llvmpipe (LLVM 15.0.6, 256 bits)"};

/// The index, or the message.
std::string chosen(std::string_view wanted) {
  const auto device = offline::chooseDevice(kNames, wanted);
  EXPECT_TRUE(device || device.error().kind == ErrorKind::BadInput);
  return device ? std::to_string(*device) : device.error().message;
}

TEST(DeviceChoice, TakesIndexOrPartOfOneName) {
  EXPECT_EQ(chosen("0"), "0");
  EXPECT_EQ(chosen("3"), "3");
  EXPECT_EQ(chosen("LLVMpipe"), "4");
  EXPECT_EQ(chosen("4070 ti"), "1");
}

TEST(DeviceChoice, TakesWholeNameThatOthersContain) { EXPECT_EQ(chosen("nvidia geforce rtx 4070"), "0"); }

TEST(DeviceChoice, ListsDevicesThatANameFits) {
  EXPECT_EQ(chosen("rtx"),
            "'rtx' fits 2 Vulkan devices; expected the whole name of one, or its index:\n"
            "  0  NVIDIA GeForce RTX 4070\n  1  NVIDIA GeForce RTX 4070 Ti");
  EXPECT_EQ(chosen("Intel(R) Arc(tm) A770"),
            "'Intel(R) Arc(tm) A770' fits 2 Vulkan devices; expected the whole name of one, or its index:\n"
            "  2  Intel(R) Arc(tm) A770\n  3  Intel(R) Arc(tm) A770");
}

TEST(DeviceChoice, ListsAllDevicesWhereNoneFits) {
  const std::string message = chosen("Voodoo 2");
  EXPECT_TRUE(message.starts_with("no Vulkan device matches 'Voodoo 2'. Available devices:\n  0  NVIDIA")) << message;
  EXPECT_TRUE(message.ends_with("\n  4  llvmpipe (LLVM 15.0.6, 256 bits)")) << message;
  EXPECT_TRUE(chosen("8").starts_with("no Vulkan device matches '8'")) << "beyond the last index";
}

}  // namespace device_choice_test
}  // namespace rill::test
