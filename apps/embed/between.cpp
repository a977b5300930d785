// Draws the fluid between two render passes of a game: the opaque scene comes first, and a red bar drawn last is hidden
// where the fluid is nearer. The depth buffer is reversed (1 is near).
// Usage: between OUT.ppm
#include <rill/fluid.hpp>
#include <rill/fluid_renderer.hpp>

#include "borrow.hpp"
#include "draw.hpp"
#include "host/cuboids.hpp"

int main(int count, char** arguments) {
  if (count != 2) host::fail("usage: between OUT.ppm");
  constexpr uint32_t kWidth = 640, kHeight = 360;
  constexpr float kEye[3] = {1.3f, 1.5f, 3.6f}, kTarget[3] = {1, 0.35f, 0.5f};
  RillHost rillHost;
  host::Engine& engine = rillHost.engine;
  auto device = rillHost.borrowDevice();
  host::Image color =
      engine.createImage(VK_FORMAT_R8G8B8A8_SRGB, kWidth, kHeight, rill::kFluidColorUsage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  host::Image depth = engine.createImage(VK_FORMAT_D32_SFLOAT, kWidth, kHeight, rill::kFluidDepthUsage);
  {
    host::Cuboids cuboids(engine, color, depth);
    const host::Matrix clip = host::perspective(40, float(kWidth) / kHeight, 0.1f) * host::lookAt(kEye, kTarget);
    const host::Cuboid opaque[] = {{{-3, -0.2f, -2}, {5, 0, 3}, {0.42f, 0.36f, 0.30f}},
                                   {{1.2f, 0, 0.35f}, {1.5f, 0.9f, 0.65f}, {0.5f, 0.5f, 0.52f}}};
    const host::Cuboid last[] = {{{0.1f, 0.25f, 0.48f}, {1.9f, 0.31f, 0.54f}, {0.8f, 0.1f, 0.08f}}};

    // The pillar of the opaque scene is also a solid of the simulation.
    rill::Scene scene;
    scene.fluid.spacing = 0.04;
    scene.domain = rill::Domain{{0, 0, 0}, {2, 1, 1}};
    scene.fill = {rill::Fill{.shape = rill::BoxShape{{0, 0, 0}, {0.8, 0.8, 1}}}};
    scene.solids = {rill::Solid{.shape = rill::BoxShape{{1.2, 0, 0.35}, {1.5, 0.9, 0.65}}}};
    const auto start = need(rill::makeParticles(scene));
    auto water = need(rill::Fluid::create(device, {.scene = &scene, .particles = &start}));
    auto renderer = need(rill::FluidRenderer::create(device, {color.format, depth.format}));
    const rill::FluidView view = lookAt(kEye, kTarget, kWidth, kHeight);

    rill::Graph graph;
    for (int k = 0; k < 18; ++k) {
      const host::Frame frame = engine.begin();
      cuboids.drawFirst(frame, clip, opaque, 2);

      device.beginFrame({frame.number, frame.completed});
      graph.reset();
      const rill::SceneTargets targets{importTarget(graph, "color", color, rill::Use::ColorTarget),
                                       importTarget(graph, "depth", depth, rill::Use::DepthTarget)};
      (void)renderer.addTo(graph, water.addTo(graph, {.advance_s = 1.0 / 60}), targets, view);
      need(graph.compile());
      need(graph.prepare(device));
      graph.record(frame.commands);

      cuboids.drawOver(frame, clip, last, 1);
      engine.end(frame);
    }
    engine.wait();
  }
  engine.save(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, arguments[1]);
  engine.destroy(color);
  engine.destroy(depth);
}
