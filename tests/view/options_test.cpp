// Options of rill-view that do not need a window.
#include "view/options.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace rill::test
