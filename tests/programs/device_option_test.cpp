// rill-capture on the device that --device or RILL_DEVICE names.
#include <gtest/gtest.h>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"
#include "support/two_devices.hpp"

namespace rill::test {
namespace device_option_test {

constexpr const char* kScene = R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {"min": [0,0,0], "max": [1,1,1]},
  "fill": [{"box": {"min": [0,0,0], "max": [0.5,0.5,0.5]}}]})";

Outcome run(const TemporaryFolder& folder, Child::Environment environment, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{folder.write("scene.json", kScene).string(), "--frames", "1", "--no-images", "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return capture(arguments, folder.string(), environment);
}

TEST(DeviceVariable, IsNamedInMessages) {
  const TemporaryFolder folder;
  const Outcome unknown = run(folder, {{"RILL_DEVICE", "Voodoo 2"}});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(unknown.err.starts_with("rill-capture: RILL_DEVICE: no Vulkan device matches 'Voodoo 2'")) << unknown.err;
  const Outcome option = run(folder, {{"RILL_DEVICE", "0"}}, {"--device", "Voodoo 2"});
  EXPECT_EQ(option.code, 2);
  EXPECT_TRUE(option.err.starts_with("rill-capture: --device: no Vulkan device matches 'Voodoo 2'")) << option.err;
}

TEST(DeviceVariable, YieldsToOption) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, {{"RILL_DEVICE", "Voodoo 2"}}, {"--device", "0"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(DeviceVariable, ListsDevicesThatANameFits) {
  const TemporaryFolder folder;
  Child::Environment environment = twoDevices(folder);
  environment.emplace_back("RILL_DEVICE", "llvm");  // part of the names of lavapipe and SwiftShader
  const Outcome outcome = run(folder, environment);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.err.starts_with("rill-capture: RILL_DEVICE: 'llvm' fits 2 Vulkan devices")) << outcome.err;
  EXPECT_NE(outcome.err.find("\n  0  "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("\n  1  "), std::string::npos) << outcome.err;
}

}  // namespace device_option_test
}  // namespace rill::test
