#include <algorithm>
#include <cmath>
#include <string_view>

#include "fluid/settings.hpp"
#include "fuzz/require.hpp"
#include "fuzz/targets.hpp"
#include "offline/simulation_keys.hpp"
#include "rill/scene_io.hpp"

namespace rill::test {

int fuzzScene(const uint8_t* data, size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const size_t zero = std::min(input.find('\0'), size);
  std::vector<Override> overrides;
  for (std::string_view rest = input.substr(zero); rest.size() > 1;) {
    rest.remove_prefix(1);  // the zero, or the line feed
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(line.size());
    if (auto assignment = parseOverride(line)) overrides.push_back(std::move(*assignment));
  }
  auto scene = parseScene(input.substr(0, zero), "scene.json", "/nonexistent", overrides);
  if (!scene) {
    RILL_REQUIRE(!scene.error().message.empty());
    return 0;
  }
  // Fuzzed scenes must not open files.
  if (std::any_of(scene->fill.begin(), scene->fill.end(),
                  [](const Fill& fill) { return std::holds_alternative<ParticleFile>(fill.shape); }))
    return 0;
  const auto particles = makeParticles(*scene, 2000);
  if (!particles) {
    RILL_REQUIRE(!particles.error().message.empty());
    return 0;
  }
  RILL_REQUIRE(particles->positions.size() <= 2000 && particles->velocities.size() == particles->positions.size());
  scene->fluid.spacing = particles->spacing;
  RILL_REQUIRE(capacityOf(*scene, particles->positions.size()) <= kMaxParticles);
  const auto setup = makeFluidSetup(
      *scene, {.capacity = static_cast<uint32_t>(particles->positions.size()), .origin = particles->origin, .extent = {1, 1, 1}});
  RILL_REQUIRE(setup || !setup.error().message.empty());
  if (setup)
    for (const PressureProbeRecord& probe : setup->pressureProbes)
      RILL_REQUIRE(std::isfinite(probe.x) && std::isfinite(probe.y) && std::isfinite(probe.z));
  const SimulationKeys keys = simulationKeys(*scene, *particles);
  RILL_REQUIRE(firstDifference(keys, keys).empty());
  return 0;
}

}  // namespace rill::test
