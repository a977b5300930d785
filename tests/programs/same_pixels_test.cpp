// The same pictures, run after run: what shares a subgroup with what depends on how a driver's threads take turns, and must not show.
#include <gtest/gtest.h>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace same_pixels_test {

TEST(SamePixelsTest, WithAndWithoutThreadsOfTheDriver) {
  const TemporaryFolder folder;
  const auto drawn = [&](const std::string& threads, const std::string& out) {
    const Outcome outcome = capture({"double-dam", "--particles", "2000", "--fps", "10", "--frames", "10", "--size", "960x540", "--view",
                                     "normals", "--quiet", "--out", out},
                                    folder.string(), {{"LP_NUM_THREADS", threads}});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  };
  drawn("0", "alone");
  drawn("2", "together");
  const std::vector<std::string> names = TemporaryFolder::namesIn(folder / "alone");
  ASSERT_EQ(names.size(), 10u);
  for (const std::string& name : names) EXPECT_TRUE(contentOf(folder / "alone" / name) == contentOf(folder / "together" / name)) << name;
}

}  // namespace same_pixels_test
}  // namespace rill::test
