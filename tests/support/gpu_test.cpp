#include "support/gpu_test.hpp"

#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>

#include "gpu/shader_library.hpp"
#include "graph/shader_pass.hpp"

namespace rill {
std::span<const EmbeddedShader> testShaders();
}

namespace rill::test {
namespace {

/// Destroyed by GoogleTest before main returns, since drivers' exit handlers fail with an open device.
class SharedContext : public ::testing::Environment {
 public:
  static SharedContext& get() {
    static auto* environment = static_cast<SharedContext*>(::testing::AddGlobalTestEnvironment(new SharedContext));
    return *environment;
  }
  offline::Context& context() {
    if (!context_ && error_.empty()) {
      offline::ContextDesc desc;
      const char* validation = std::getenv("RILL_TEST_VALIDATION");
      desc.validation = !validation || std::strcmp(validation, "off") != 0;
      auto made = offline::Context::create(desc);
      if (made)
        context_ = std::move(*made);
      else
        error_ = made.error().message;
    }
    if (!context_) throw std::runtime_error(error_);
    return *context_;
  }
  void TearDown() override { context_.reset(); }

 private:
  std::optional<offline::Context> context_;
  std::string error_;
};

// Registered before main: GoogleTest ignores environments added once tests run.
[[maybe_unused]] SharedContext& registered = SharedContext::get();

}  // namespace

std::span<const uint32_t> testShader(std::string_view name) {
  for (const EmbeddedShader& shader : testShaders())
    if (shader.name == name) return shader.words;
  ADD_FAILURE() << "no test shader '" << name << "'";
  return {};
}

void GpuTest::SetUp() {
  context_ = &SharedContext::get().context();
  (void)context_->takeMessages();
}

void GpuTest::TearDown() {
  if (!context_) return;
  if (auto ok = context_->wait(); !ok) ADD_FAILURE() << ok.error().message;
  for (const std::string& message : context_->takeMessages()) ADD_FAILURE() << message;
}

void GpuTest::run(Graph& graph) {
  auto ok = context().run(graph);
  if (ok) ok = context().wait();
  if (!ok) FAIL() << ok.error().message;
}

void GpuTest::run(std::span<Graph* const> graphs) {
  Expected<void> ok;
  for (Graph* graph : graphs)
    if (ok) ok = graph->compile();
  if (ok)
    if (auto begun = context().beginFrame(); !begun) ok = begun.error();
  for (Graph* graph : graphs)
    if (ok) ok = graph->prepare(device());
  if (ok)
    ok = context().submit([&](VkCommandBuffer commands) {
      for (Graph* graph : graphs) graph->record(commands);
    });
  if (ok) ok = context().wait();
  if (!ok) FAIL() << ok.error().message;
}

Buffer GpuTest::buffer(std::string_view name, uint64_t bytes, MemoryKind kind) {
  auto made = createBuffer(device(), name, bytes, kind);
  if (made) return std::move(*made);
  ADD_FAILURE() << made.error().message;
  return {};
}

Buffer GpuTest::uploadBytes(std::string_view name, std::span<const std::byte> bytes) {
  Buffer made = buffer(name, bytes.size(), MemoryKind::Upload);
  if (made) std::memcpy(made.mapped(), bytes.data(), bytes.size());
  return made;
}

const ComputePipeline* GpuTest::pipeline(const ComputePipelineDesc& desc) {
  auto made = computePipeline(device(), desc);
  if (made) return *made;
  ADD_FAILURE() << made.error().message;
  return nullptr;
}

std::vector<uint32_t> GpuTest::wordsFrom(std::string_view shader, const Buffer& source, uint64_t words, uint32_t groups) {
  const BindingKind buffers[2] = {};
  Graph graph;
  const BufferRef in = graph.import("source", importOf(source));
  BufferRef out = graph.create("target", {words * 4});
  addFill(graph, "clear", {{&out, 0}});
  graph.pass(shader, [&](Pass& pass) {
    pass.read(in, Use::ComputeRead);
    out = pass.write(out, Use::ComputeWrite);
    const Kernel kernel = pass.kernel(pipeline({.shader = shader, .spirv = testShader(shader), .bindings = buffers}), {in, out});
    return [=](Commands& commands) { commands.dispatch(kernel, groups); };
  });
  const Ticket ticket = graph.readback(out);
  run(graph);
  return read<uint32_t>(graph, ticket);
}

}  // namespace rill::test
