// The tests of drivers whose shuffles return nonsense run no shader of render/: so none may have a shuffle.
#include <gtest/gtest.h>

#include <algorithm>
#include <spirv/unified1/spirv.hpp11>

#include "gpu/shader_library.hpp"

namespace rill::test {
namespace shuffles_test {

constexpr size_t kHeaderWords = 5;  // SPIR-V 1.6, section 2.3; capabilities come first behind it

bool hasShuffles(const EmbeddedShader& shader) {
  for (size_t at = kHeaderWords; at + 1 < shader.words.size(); at += 2) {
    if (shader.words[at] != (2u << spv::WordCountShift | uint32_t(spv::Op::OpCapability))) return false;
    const auto capability = static_cast<spv::Capability>(shader.words[at + 1]);
    if (capability == spv::Capability::GroupNonUniformShuffle || capability == spv::Capability::GroupNonUniformShuffleRelative) return true;
  }
  return false;
}

TEST(ShufflesTest, ShadersOfRenderHaveNone) {
  size_t render = 0, others = 0;
  for (const EmbeddedShader& shader : embeddedShaders()) {
    if (!shader.name.starts_with("render/")) {
      others += hasShuffles(shader);
      continue;
    }
    ++render;
    EXPECT_FALSE(hasShuffles(shader)) << shader.name;
  }
  EXPECT_GT(render, 0u);
  EXPECT_GT(others, 0u) << "no shader has shuffles at all";
}

}  // namespace shuffles_test
}  // namespace rill::test
