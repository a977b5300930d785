// Images do not depend on the number of driver threads, which changes how invocations share subgroups.
#include <gtest/gtest.h>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace same_pixels_test {

TEST(SamePixelsTest, DriverThreadsDoNotChangeImages) {
  const TemporaryFolder folder;
  const auto render = [&](const std::string& threads, const std::string& out) {
    const Outcome outcome = capture({"double-dam", "--particles", "2000", "--fps", "10", "--frames", "10", "--size", "960x540", "--view",
                                     "normals", "--quiet", "--out", out},
                                    folder.string(), {{"LP_NUM_THREADS", threads}});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  };
  render("0", "one_thread");
  render("2", "two_threads");
  const std::vector<std::string> names = TemporaryFolder::namesIn(folder / "one_thread");
  ASSERT_EQ(names.size(), 10u);
  for (const std::string& name : names)
    EXPECT_TRUE(contentOf(folder / "one_thread" / name) == contentOf(folder / "two_threads" / name)) << name;
}

}  // namespace same_pixels_test
}  // namespace rill::test
