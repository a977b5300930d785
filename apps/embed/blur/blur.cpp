// A host that uses Rill's render graph for passes of its own, and nothing else of Rill: a blur of an image in two directions. The first
// direction runs by a pipeline of Rill's, the second by the host's own, recorded with raw Vulkan.
#include <cstdio>
#include <rill/graph.hpp>
#include <rill/pipeline.hpp>

#include "plumbing.hpp"

namespace {

struct Direction {
  int32_t x, y;
};

rill::Expected<void> blur(Plumbing& host) {
  // The graph borrows the host's device, and takes it as it is: the features that Rill needs were enabled.
  auto device = rill::Device::borrow({.instance = host.instance,
                                      .physicalDevice = host.physicalDevice,
                                      .device = host.device,
                                      .queueFamily = host.queueFamily,
                                      .getInstanceProcAddr = vkGetInstanceProcAddr,
                                      .enabled = &host.features});
  if (!device) return device.error();

  // Bindings 0, 1, ... of the shader's set 0.
  const rill::BindingKind bindings[] = {rill::BindingKind::SampledImage, rill::BindingKind::StorageImage};
  auto across = rill::computePipeline(
      **device, {.shader = "blur", .spirv = host.shader(), .bindings = bindings, .pushConstantBytes = sizeof(Direction)});
  if (!across) return across.error();

  // A frame is declared: what comes in and in which state, what each pass reads and writes. Barriers and memory follow from that.
  rill::Graph graph;
  const rill::ImageDesc size{VK_FORMAT_R8G8B8A8_UNORM, host.width, host.height};
  const rill::Groups groups{(host.width + 7) / 8, (host.height + 7) / 8};
  const rill::ImageRef source = graph.import("source", {.handle = host.source.image, .desc = size, .before = rill::Use::CopyTarget});
  rill::ImageRef result = graph.import("result", {.handle = host.result.image, .desc = size, .after = rill::Use::CopySource});
  rill::ImageRef half = graph.create("half blurred", size), whole = graph.create("blurred", size);

  graph.pass("blur across", [&](rill::Pass& pass) {
    pass.read(source, rill::Use::ComputeSampled);
    half = pass.write(half, rill::Use::ComputeWrite);
    const rill::Kernel kernel = pass.kernel(*across, {source, half});
    return [=](rill::Commands& commands) { commands.dispatch(kernel, groups, Direction{1, 0}); };
  });
  graph.pass("blur down", [&](rill::Pass& pass) {
    pass.read(half, rill::Use::ComputeSampled);
    whole = pass.write(whole, rill::Use::ComputeWrite);
    return [=, &host](rill::Commands& commands) {  // the same with a pipeline and a descriptor set of the host's
      const rill::ImageHandle from = commands.image(half), to = commands.image(whole);
      host.writeSet({VK_NULL_HANDLE, from.view, from.layout}, {VK_NULL_HANDLE, to.view, to.layout});
      const Direction down{0, 1};
      vkCmdBindPipeline(commands.handle(), VK_PIPELINE_BIND_POINT_COMPUTE, host.pipeline);
      vkCmdBindDescriptorSets(commands.handle(), VK_PIPELINE_BIND_POINT_COMPUTE, host.layout, 0, 1, &host.set, 0, nullptr);
      vkCmdPushConstants(commands.handle(), host.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof down, &down);
      vkCmdDispatch(commands.handle(), groups.x, groups.y, groups.z);
    };
  });
  graph.pass("hand out", [&](rill::Pass& pass) {
    pass.read(whole, rill::Use::CopySource);
    result = pass.write(result, rill::Use::CopyTarget, rill::Load::Discard);
    return [=](rill::Commands& commands) { commands.copy(whole, result); };
  });

  // It is planned, given its memory, and recorded into a command buffer that the host submits: Rill never does.
  if (auto planned = graph.compile(); !planned) return planned;
  (*device)->beginFrame({.recording = 1, .completed = 0});
  if (auto prepared = graph.prepare(**device); !prepared) return prepared;
  host.run([&](VkCommandBuffer commands) { graph.record(commands); });
  return {};
}  // the work has finished: the graph and the device may end

}  // namespace

int main() {
  Plumbing host;
  if (!host.open()) return 1;
  if (auto done = blur(host); !done) {
    std::fprintf(stderr, "blur: %s\n", done.error().message.c_str());
    return 1;
  }
  return host.isBlurred() ? 0 : 1;
}
