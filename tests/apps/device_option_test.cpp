// Which device the programs take: --device, else RILL_DEVICE.
#include "shared/device_option.hpp"

#include <gtest/gtest.h>

#include "capture/options.hpp"
#include "support/scoped_variable.hpp"

namespace rill::test {
namespace {

TEST(DeviceOption, CommandLineWinsOverVariable) {
  const ScopedVariable variable("RILL_DEVICE", "radeon");
  const auto given = apps::deviceOption("arc"), fromVariable = apps::deviceOption({});
  ASSERT_TRUE(given && fromVariable);
  EXPECT_EQ(given->name + ", " + given->origin, "arc, --device");
  EXPECT_EQ(fromVariable->name + ", " + fromVariable->origin, "radeon, RILL_DEVICE");
}

TEST(DeviceOption, IgnoresUnsetAndEmptyVariable) {
  for (const char* value : {"", static_cast<const char*>(nullptr)}) {
    const ScopedVariable variable("RILL_DEVICE", value);
    const auto none = apps::deviceOption({});
    ASSERT_TRUE(none);
    EXPECT_EQ(none->name + none->origin, "");
  }
}

TEST(DeviceOption, RejectsEmptyOption) {
  const ScopedVariable variable("RILL_DEVICE", "radeon");
  const auto empty = apps::deviceOption("");
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().kind, ErrorKind::BadInput);
  EXPECT_TRUE(empty.error().message.starts_with("--device: \"\" was given")) << empty.error().message;
}

TEST(DeviceOption, CaptureAndPlayTakeTheVariable) {
  const ScopedVariable variable("RILL_DEVICE", "radeon");
  const std::vector<std::vector<const char*>> lines{{"rill-capture", "dam-break"}, {"rill-capture", "dam-break", "--play", "frames"}};
  for (const auto& line : lines) {
    const auto parsed = capture::parseCommandLine(static_cast<int>(line.size()), line.data());
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_EQ(parsed->options->device.name, "radeon");
  }
}

}  // namespace
}  // namespace rill::test
