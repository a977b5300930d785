// Options of rill-view that do not need a window.
#include "view/options.hpp"

#include <gtest/gtest.h>

#include <array>

#include "support/scoped_variable.hpp"

namespace rill::test {
namespace {

std::string deviceOf(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "rill-view");
  const auto line = view::parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
  return line ? line->options->device.name : line.error().message;
}

TEST(ViewOptions, TakesDeviceFromVariable) {
  const ScopedVariable variable("RILL_DEVICE", "radeon");
  EXPECT_EQ(deviceOf({}), "radeon");
  EXPECT_EQ(deviceOf({"--device", "0"}), "0");
}

TEST(ViewOptions, TakesExposure) {
  const std::array<const char*, 3> arguments{"rill-view", "--exposure", "-1.5"};
  const auto line = view::parseCommandLine(arguments.size(), arguments.data());
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_EQ(line->options->exposure_stops, -1.5);
  for (const char* bad : {"11", "-10.1", "nan", "bright", ""})
    EXPECT_NE(
        deviceOf({"--exposure", bad}).find("--exposure: \"" + std::string(bad) + "\" was given; expected a number of stops from -10 to 10"),
        std::string::npos)
        << bad;
}

}  // namespace
}  // namespace rill::test
