// Adds a simulated and rendered fluid to a game that has its own Vulkan device, frames in flight, color and depth buffer.
// Usage: water OUT.ppm
#include <rill/fluid.hpp>
#include <rill/fluid_renderer.hpp>
#include <type_traits>

#include "host/camera.hpp"
#include "host/engine.hpp"

namespace {

/// Returns the value, or prints Rill's error message and exits.
template <class T>
T need(rill::Expected<T> result) {
  if (!result) host::fail(result.error().message.c_str());
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) host::fail("usage: water OUT.ppm");
  // 1. Device: query what Rill requires, create the device with it, let Rill borrow the device.
  rill::DeviceRequirements needs;
  host::Engine engine([&](VkInstance instance, VkPhysicalDevice physicalDevice) {
    need(rill::appendRequired(vkGetInstanceProcAddr, instance, physicalDevice, needs));
    return needs.chain();
  });
  rill::HostDevice hostDevice;
  hostDevice.instance = engine.instance;
  hostDevice.physicalDevice = engine.physicalDevice;
  hostDevice.device = engine.device;
  hostDevice.queueFamily = engine.queueFamily;
  hostDevice.getInstanceProcAddr = engine.getInstanceProcAddr;
  hostDevice.enabled = &needs.features;
  auto device = need(rill::Device::borrow(hostDevice));

  // 2. Scene: a tank of 2 x 1 x 1 m with water on the left.
  rill::Scene scene;
  scene.fluid.spacing = 0.04;
  scene.domain = rill::Domain{{0, 0, 0}, {2, 1, 1}};
  scene.fill = {rill::Fill{.shape = rill::BoxShape{{0, 0, 0}, {0.8, 0.8, 1}}}};
  const auto particles = need(rill::makeParticles(scene));
  auto water = need(rill::Fluid::create(device, {.scene = &scene, .particles = &particles}));

  // 3. Renderer: draws into the game's color and depth buffer.
  constexpr uint32_t kWidth = 640, kHeight = 360;
  host::Image color = engine.createImage(VK_FORMAT_R8G8B8A8_SRGB, kWidth, kHeight,
                                         rill::kFluidColorUsage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  host::Image depth = engine.createImage(VK_FORMAT_D32_SFLOAT, kWidth, kHeight, rill::kFluidDepthUsage | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  auto renderer = need(rill::FluidRenderer::create(device, {color.format, depth.format}));
  rill::FluidView view;
  view.view = rill::Float4x4::from(host::lookAt({2.6f, 1.6f, 3.2f}, {0.9f, 0.3f, 0.5f}).m[0]);
  view.projection = rill::Float4x4::from(host::perspective(40, float(kWidth) / kHeight, 0.1f).m[0]);
  view.width = kWidth;
  view.height = kHeight;
  view.focus_m = 3.5;

  // 4. Frames: declare Rill's passes in a graph and record it into the game's command buffer.
  rill::Graph graph;
  for (int k = 0; k < 40; ++k) {
    const host::Frame frame = engine.begin();
    engine.clear(frame, color, {{0.55f, 0.65f, 0.75f, 1}}, depth, 0);

    device.beginFrame({frame.number, frame.completed});
    graph.reset();
    rill::SceneTargets targets;
    targets.color = graph.import("color", {color.handle, {color.format, kWidth, kHeight}, rill::Use::ColorTarget, rill::Use::ColorTarget});
    targets.depth = graph.import("depth", {depth.handle, {depth.format, kWidth, kHeight}, rill::Use::DepthTarget, rill::Use::DepthTarget});
    const rill::FluidState state = water.addTo(graph, {.advance_s = 1.0 / 60});
    targets = renderer.addTo(graph, state, targets, view);
    need(graph.compile());
    need(graph.prepare(device));
    graph.record(frame.commands);

    engine.end(frame);
  }
  engine.wait();
  engine.save(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, arguments[1]);
  engine.destroy(color);
  engine.destroy(depth);
}
