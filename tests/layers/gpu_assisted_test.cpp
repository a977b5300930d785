// GPU-assisted validation finds reads out of bounds: what the tests with the label gpu-assisted rely on (gpu_assisted.sh). A program of
// its own, because without that validation such a read is not allowed.
#include <cstdlib>
#include <cstring>

#include "support/gpu_test.hpp"

namespace rill::test {
namespace gpu_assisted_test {

TEST_F(GpuTest, FindsReadsOutOfBounds) {
  const char* given = std::getenv("RILL_TEST_HOSTILE");
  ASSERT_TRUE(given && std::strcmp(given, "gpu-assisted") == 0) << "expected the environment that ctest -L gpu-assisted sets";
  const auto messages = [&](uint32_t index) {
    EXPECT_EQ(wordsFrom("out_of_bounds", upload("source", std::vector<uint32_t>{index, 0, 0, 0}), 1, 1).size(), 1u);
    return context().takeMessages();
  };
  EXPECT_TRUE(messages(3).empty());
  const std::vector<std::string> found = messages(1000);
  ASSERT_FALSE(found.empty());
  EXPECT_NE(found[0].find("out of bounds"), std::string::npos) << found[0];
}

}  // namespace gpu_assisted_test
}  // namespace rill::test
