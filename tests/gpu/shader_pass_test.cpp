// Passes of embedded shaders, whose bindings are reflected.
#include "graph/shader_pass.hpp"

#include <set>

#include "gpu/device_impl.hpp"
#include "gpu/shader_constants.hpp"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace shader_pass_test {

struct ShaderPass : GpuTest {
  /// What compile() says of a pass that binds "sort/clear", which writes `start` and `oversized`.
  std::string errorOf(std::function<void(Pass&, const ComputePipeline*, BufferRef&, BufferRef&)> bind) {
    const ComputePipeline* clear = pipeline({.shader = "sort/clear"});
    Graph graph;
    BufferRef start = graph.create("start", {64}), oversized = graph.create("oversized", {64});
    graph.pass("clear", [&](Pass& pass) {
      pass.sideEffect();
      bind(pass, clear, start, oversized);
      return [](Commands&) {};
    });
    const auto compiled = graph.compile();
    return compiled ? "" : compiled.error().message;
  }
};

TEST_F(ShaderPass, DeclaresWhatTheShaderWrites) {
  EXPECT_EQ(errorOf([](Pass& pass, const ComputePipeline* clear, BufferRef& start, BufferRef& oversized) {
              const BufferRef before = start;
              bindNamed(pass, clear, {{"oversized", oversized}, {"start", start}, {"another", start}});
              EXPECT_NE(start, before) << "a new version";
            }),
            "");
}

TEST_F(ShaderPass, RejectsMissingName) {
  EXPECT_EQ(errorOf([](Pass& pass, const ComputePipeline* clear, BufferRef& start, BufferRef&) {
              bindNamed(pass, clear, {{"start", start}});
            }),
            "pass 'clear': shader 'sort/clear': nothing is given for 'oversized'");
}

TEST_F(ShaderPass, RejectsWritingWhatIsGivenToBeRead) {
  EXPECT_EQ(errorOf([](Pass& pass, const ComputePipeline* clear, BufferRef& start, BufferRef& oversized) {
              bindNamed(pass, clear, {{"start", std::as_const(start)}, {"oversized", oversized}});
            }),
            "pass 'clear': shader 'sort/clear' writes 'start', which is given to be read");
}

TEST_F(ShaderPass, RejectsWrongNumberOfResources) {
  EXPECT_EQ(errorOf([](Pass& pass, const ComputePipeline* clear, BufferRef& start, BufferRef&) {
              const BoundResource one[] = {{.buffer = &start}};
              bindShader(pass, clear, one);
            }),
            "pass 'clear': shader 'sort/clear': 1 resources; expected 2");
}

TEST_F(ShaderPass, RejectsConstantWithoutValue) {
  const auto made = shaderPipeline(device(), "sort/scan_apply", {{"ANOTHER", 1}});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "shader 'sort/scan_apply': its constant SUMS_SCANNED is given no value");
}

TEST(EmbeddedShaders, AreReflectedWhole) {
  for (const EmbeddedShader& shader : embeddedShaders()) {
    SCOPED_TRACE(shader.name);
    EXPECT_LE(shader.pushConstantBytes, 128u);
    EXPECT_EQ(shader.pushConstantBytes % 4, 0u);
    std::set<std::string_view> names;
    for (const ShaderConstant& constant : shader.constants) EXPECT_FALSE(constant.name.empty());
    if (!shader.source.ends_with(".comp")) continue;
    EXPECT_FALSE(shader.bindings.empty());
    for (const ShaderBinding& binding : shader.bindings) {
      EXPECT_FALSE(binding.name.empty()) << "a binding number is left out";
      EXPECT_TRUE(names.insert(binding.name).second) << binding.name;
    }
    EXPECT_TRUE(std::ranges::any_of(shader.bindings, &ShaderBinding::writes)) << "it has no result";
  }
}

}  // namespace shader_pass_test
}  // namespace rill::test
