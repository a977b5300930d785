// Simulates 0.1 s of a scene and reads the particles as arrays, without using Vulkan.
#include <cstdio>
#include <rill/offline.hpp>

int main() {
  auto run = rill::offline::Simulation::open(SCENES "/dam-break.json", {.overrides = {{"fluid.particles", "2000"}}});
  if (!run) return std::puts(run.error().message.c_str()), 1;
  if (auto ok = run->advance(0.1); !ok) return std::puts(ok.error().message.c_str()), 1;
  const auto particles = run->particles();
  const auto stats = run->stats();
  if (!particles || !stats) return 1;
  return particles->positions.size() == stats->particles && stats->densityErrorMean < 0.01 && stats->outside == 0 ? 0 : 1;
}
