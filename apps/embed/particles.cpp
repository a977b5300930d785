// Renders particles that come from the game's own solver or from a file. Only Rill's renderer is used.
// Usage: particles OUT.ppm
#include <cmath>
#include <cstring>
#include <rill/fluid_renderer.hpp>

#include "borrow.hpp"
#include "draw.hpp"

namespace {

constexpr uint32_t kWidth = 640, kHeight = 360;
constexpr float kSpacing = 0.04f;

/// Writes a pool of 2 x 2 m with circular waves, one vec4 per particle. Returns the number of particles.
uint32_t writePositions(float* to, float time) {
  uint32_t count = 0;
  for (float x = kSpacing / 2; x < 2; x += kSpacing)
    for (float z = kSpacing / 2; z < 2; z += kSpacing) {
      const float radius = std::hypot(x - 1, z - 1), top = 0.3f + 0.06f * std::sin(12 * radius - 6 * time) * std::exp(-radius);
      for (float y = top - kSpacing / 2; y > 0; y -= kSpacing, ++count) {
        const float particle[4] = {x, y, z, 0};
        std::memcpy(to + 4 * size_t{count}, particle, sizeof particle);
      }
    }
  return count;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) host::fail("usage: particles OUT.ppm");
  RillHost rillHost;
  host::Engine& engine = rillHost.engine;
  auto device = rillHost.borrowDevice();
  host::Image color = engine.createImage(VK_FORMAT_R8G8B8A8_SRGB, kWidth, kHeight,
                                         rill::kFluidColorUsage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  host::Image depth = engine.createImage(VK_FORMAT_D32_SFLOAT, kWidth, kHeight, rill::kFluidDepthUsage | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  auto renderer = need(rill::FluidRenderer::create(device, {color.format, depth.format}));
  const rill::FluidView view = lookAt({2.4f, 1.7f, 3.6f}, {1, 0.2f, 1}, kWidth, kHeight);

  // One buffer per frame in flight: the device may still read the others.
  host::Buffer positions[3];
  for (host::Buffer& buffer : positions) buffer = engine.createBuffer(16 * 40'000, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  rill::Graph graph;
  for (int k = 0; k < 6; ++k) {
    const host::Frame frame = engine.begin();
    const host::Buffer& current = positions[frame.number % 3];
    rill::FluidState state;
    state.capacity = writePositions(static_cast<float*>(current.mapped), 0.1f * float(k));
    state.spacing = kSpacing;
    engine.clear(frame, color, {{0.55f, 0.65f, 0.75f, 1}}, depth, 0);

    device.beginFrame({frame.number, frame.completed});
    graph.reset();
    state.position = graph.import("positions", {current.handle, 0, uint64_t{16} * state.capacity, rill::Use::Nothing, rill::Use::Nothing});
    const rill::SceneTargets targets{importTarget(graph, "color", color, rill::Use::ColorTarget),
                                     importTarget(graph, "depth", depth, rill::Use::DepthTarget)};
    (void)renderer.addTo(graph, state, targets, view);
    need(graph.compile());
    need(graph.prepare(device));
    graph.record(frame.commands);
    engine.end(frame);
  }
  engine.wait();
  engine.save(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, arguments[1]);
  for (host::Buffer& buffer : positions) engine.destroy(buffer);
  engine.destroy(color);
  engine.destroy(depth);
}
