// Uses only Rill's render graph: uploads an image and blurs it in two directions. The first pass uses a pipeline of Rill's,
// the second one records plain Vulkan commands with a pipeline of the game's own.
// Usage: blur OUT.ppm
#include <cstring>
#include <rill/graph.hpp>
#include <rill/pipeline.hpp>

#include "borrow.hpp"
#include "host/image_filter.hpp"

namespace {

#include "blur_comp.inc"

constexpr uint32_t kWidth = 96, kHeight = 64;
constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

struct Direction {
  int32_t x, y;
};

/// Writes a checkerboard with squares of 8 pixels.
void writeCheckerboard(unsigned char* rgba) {
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x, rgba += 4) {
      const bool light = (x / 8 + y / 8) % 2 != 0;
      const unsigned char texel[] = {static_cast<unsigned char>(light ? 240 : 2 * x), static_cast<unsigned char>(light ? 200 : 3 * y), 90,
                                     255};
      std::memcpy(rgba, texel, 4);
    }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) host::fail("usage: blur OUT.ppm");
  RillHost rillHost;
  host::Engine& engine = rillHost.engine;
  auto device = rillHost.borrowDevice();
  host::Image result = engine.createImage(kFormat, kWidth, kHeight, VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  host::Buffer pixels = engine.createBuffer(4 * kWidth * kHeight, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  writeCheckerboard(static_cast<unsigned char*>(pixels.mapped));
  {
    host::ImageFilter filter(engine);
    // Bindings 0, 1, ... of descriptor set 0.
    const rill::BindingKind bindings[] = {rill::BindingKind::SampledImage, rill::BindingKind::StorageImage};
    const rill::ComputePipeline* across = need(rill::computePipeline(
        device, {.shader = "blur", .spirv = blur_comp, .bindings = bindings, .pushConstantBytes = sizeof(Direction)}));

    // Declare the frame: imported resources with their states, and what each pass reads and writes. The graph derives
    // barriers and memory from that.
    rill::Graph graph;
    const rill::ImageDesc size{kFormat, kWidth, kHeight};
    const rill::Groups groups{kWidth / 8, kHeight / 8};
    const rill::BufferRef painted = graph.import("painted", {.handle = pixels.handle, .size = pixels.size, .before = rill::Use::Nothing});
    rill::ImageRef out =
        graph.import("result", {.handle = result.handle, .desc = size, .before = rill::Use::Nothing, .after = rill::Use::CopySource});
    rill::ImageRef source = graph.create("source", size), half = graph.create("half blurred", size), whole = graph.create("blurred", size);
    graph.pass("upload", [&](rill::Pass& pass) {
      pass.read(painted, rill::Use::CopySource);
      source = pass.write(source, rill::Use::CopyTarget, rill::Load::Discard);
      return [=](rill::Commands& commands) { commands.copy(painted, source); };
    });
    graph.pass("blur across", [&](rill::Pass& pass) {
      pass.read(source, rill::Use::ComputeSampled);
      half = pass.write(half, rill::Use::ComputeWrite);
      const rill::Kernel kernel = pass.kernel(across, {source, half});
      return [=](rill::Commands& commands) { commands.dispatch(kernel, groups, Direction{1, 0}); };
    });
    graph.pass("blur down", [&](rill::Pass& pass) {
      pass.read(half, rill::Use::ComputeSampled);
      whole = pass.write(whole, rill::Use::ComputeWrite);
      return [=, &filter](rill::Commands& commands) {  // the game's own pipeline and descriptor set
        const rill::ImageHandle from = commands.image(half), to = commands.image(whole);
        filter.run(commands.handle(), {VK_NULL_HANDLE, from.view, from.layout}, {VK_NULL_HANDLE, to.view, to.layout}, {0, 1}, groups.x,
                   groups.y);
      };
    });
    graph.pass("copy result", [&](rill::Pass& pass) {
      pass.read(whole, rill::Use::CopySource);
      out = pass.write(out, rill::Use::CopyTarget, rill::Load::Discard);
      return [=](rill::Commands& commands) { commands.copy(whole, out); };
    });

    // Compile the graph, allocate its memory, record it into a command buffer that the game submits.
    need(graph.compile());
    const host::Frame frame = engine.begin();
    device.beginFrame({frame.number, frame.completed});
    need(graph.prepare(device));
    graph.record(frame.commands);
    engine.end(frame);
    engine.wait();
  }
  engine.save(result, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, arguments[1]);
  engine.destroy(result);
  engine.destroy(pixels);
}
