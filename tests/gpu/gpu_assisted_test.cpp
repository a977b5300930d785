// Gpu-assisted validation works on this driver: what the tests with the label gpu-assisted rely on (layers/gpu_assisted.sh).
#include <cstdlib>
#include <cstring>

#include "support/gpu_test.hpp"

namespace rill::test {
namespace gpu_assisted_test {

TEST_F(GpuTest, GpuAssistedValidationSeesReadsOutOfBounds) {
  const char* given = std::getenv("RILL_TEST_HOSTILE");
  if (!given || std::strcmp(given, "gpu-assisted") != 0) GTEST_SKIP() << "without gpu-assisted validation nobody may read there";
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
