// Uses only Rill's solver and reads the particle positions back without waiting: they arrive a few frames later. Here
// they are drawn as dots, viewed along -z.
// Usage: positions OUT.ppm
#include <cstddef>
#include <cstdio>
#include <rill/fluid.hpp>
#include <span>
#include <vector>

#include "borrow.hpp"

namespace {

constexpr uint32_t kWidth = 400, kHeight = 200;

struct Position {
  float x, y, z, unused;  ///< m, relative to FluidState::origin
};

/// Brighter where there are more particles.
void draw(std::span<const Position> positions, const char* file) {
  std::vector<unsigned char> gray(kWidth * kHeight);
  for (const Position& p : positions) {
    const int x = int(p.x / 2 * kWidth), y = int((1 - p.y) * kHeight);
    if (x < 0 || y < 0 || x >= int(kWidth) || y >= int(kHeight)) host::fail("a particle is outside the tank");
    unsigned char& dot = gray[size_t(y) * kWidth + size_t(x)];
    dot = static_cast<unsigned char>(dot > 215 ? 255 : dot + 40);
  }
  std::FILE* out = std::fopen(file, "wb");
  if (!out) host::fail("cannot write the image");
  std::fprintf(out, "P6\n%u %u\n255\n", kWidth, kHeight);
  for (const unsigned char g : gray) std::fputc(g, out), std::fputc(g, out), std::fputc(g, out);
  if (std::fclose(out) != 0) host::fail("cannot write the image");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) host::fail("usage: positions OUT.ppm");
  RillHost rillHost;
  auto device = rillHost.borrowDevice();
  rill::Scene scene;
  scene.fluid.spacing = 0.04;
  scene.domain = rill::Domain{{0, 0, 0}, {2, 1, 1}};
  scene.fill = {rill::Fill{.shape = rill::BoxShape{{0, 0, 0}, {0.8, 0.8, 1}}}};
  const auto start = need(rill::makeParticles(scene));
  auto water = need(rill::Fluid::create(device, {.scene = &scene, .particles = &start}));

  rill::Graph graph;
  rill::Ticket tickets[60];
  std::vector<Position> latest;
  uint32_t arrived = 0;
  const auto readArrived = [&](uint32_t end) {
    for (; arrived < end; ++arrived) {
      const std::span<const std::byte> bytes = graph.data(tickets[arrived]);
      if (bytes.empty()) return;  // still in flight
      const auto* first = reinterpret_cast<const Position*>(bytes.data());
      latest.assign(first, first + water.count());
    }
  };
  for (uint32_t k = 0; k < std::size(tickets); ++k) {
    const host::Frame frame = rillHost.engine.begin();
    device.beginFrame({frame.number, frame.completed});
    graph.reset();
    readArrived(k);
    tickets[k] = graph.readback(water.addTo(graph, {.advance_s = 1.0 / 60}).position);
    need(graph.compile());
    need(graph.prepare(device));
    graph.record(frame.commands);
    rillHost.engine.end(frame);
  }
  rillHost.engine.wait();
  device.beginFrame({std::size(tickets) + 1, std::size(tickets)});
  readArrived(std::size(tickets));
  if (arrived != std::size(tickets)) host::fail("positions are missing");
  draw(latest, arguments[1]);
}
