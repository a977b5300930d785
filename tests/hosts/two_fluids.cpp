// Two fluids per frame with three frames in flight; Rill's objects are recreated while frames are in flight.
//   two_fluids OUT.ppm
#include <optional>
#include <rill/fluid.hpp>
#include <rill/fluid_renderer.hpp>

#include "borrow.hpp"
#include "draw.hpp"

namespace {

constexpr uint32_t kWidth = 320, kHeight = 180;
constexpr int kFrames = 110;

/// A drop above a pool, in a tank whose minimum x is `x`.
rill::Fluid makeFluid(rill::Device& device, double x, double viscosity) {
  rill::Scene scene;
  scene.fluid.spacing = 0.06;
  scene.fluid.viscosity = viscosity;
  scene.domain = rill::Domain{{x, 0, 0}, {x + 0.9, 1, 0.9}};
  scene.fill = {rill::Fill{.shape = rill::BoxShape{{x, 0, 0}, {x + 0.9, 0.24, 0.9}}},
                rill::Fill{.shape = rill::SphereShape{{x + 0.45, 0.6, 0.45}, 0.2}}};
  const auto start = need(rill::makeParticles(scene));
  return need(rill::Fluid::create(device, {.scene = &scene, .particles = &start}));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) host::fail("usage: two_fluids OUT.ppm");
  RillHost rillHost;
  host::Engine& engine = rillHost.engine;
  auto device = rillHost.borrowDevice();
  host::Image color = engine.createImage(VK_FORMAT_R8G8B8A8_SRGB, kWidth, kHeight,
                                         rill::kFluidColorUsage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  host::Image depth = engine.createImage(VK_FORMAT_D32_SFLOAT, kWidth, kHeight, rill::kFluidDepthUsage | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const rill::FluidView view = lookAt({1, 1.3f, 3.4f}, {1, 0.25f, 0.45f}, kWidth, kHeight);
  rill::FluidLook clay;
  clay.opaque = true;
  clay.scatter = {0.5f, 0.2f, 0.1f};
  {
    std::optional<rill::Fluid> left, right;
    std::optional<rill::FluidRenderer> painter;
    rill::Graph graph;
    for (int k = 0; k < kFrames; ++k) {
      const host::Frame frame = engine.begin();
      device.beginFrame({frame.number, frame.completed});
      // Frames in flight still use the objects replaced here.
      if (k % 7 == 0) left = makeFluid(device, 0, 0);
      if (k % 5 == 0) right = makeFluid(device, 1.1, 5);
      if (k % 11 == 0) painter = need(rill::FluidRenderer::create(device, {color.format, depth.format}));
      if (k % 13 == 0) graph = rill::Graph();
      engine.clear(frame, color, {{0.55f, 0.65f, 0.75f, 1}}, depth, 0);

      graph.reset();
      rill::SceneTargets targets{importTarget(graph, "color", color, rill::Use::ColorTarget),
                                 importTarget(graph, "depth", depth, rill::Use::DepthTarget)};
      const rill::FluidState a = left->addTo(graph, {.advance_s = 1.0 / 60, .stats = true});
      const rill::FluidState b = right->addTo(graph, {.advance_s = 1.0 / 60, .stats = true});
      targets = painter->addTo(graph, a, targets, view);
      targets = painter->addTo(graph, b, targets, view, clay);
      need(graph.compile());
      need(graph.prepare(device));
      graph.record(frame.commands);
      engine.end(frame);
      for (const rill::Fluid* fluid : {&*left, &*right})
        if (const auto stats = fluid->stats(); stats && stats->nonFinite + stats->outside > 0) host::fail("a fluid left its tank");
    }
    engine.wait();
    engine.save(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, arguments[1]);
  }
  engine.destroy(color);
  engine.destroy(depth);
}
