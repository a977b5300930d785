// A host that loads scene files installed with Rill, from the package's scene folder.
#include <cstdio>
#include <rill/particles.hpp>
#include <rill/scene_io.hpp>
#include <rill/version.hpp>
#include <string_view>

int main() {
  auto scene = rill::loadScene(SCENES "/dam-break.json");
  if (!scene) return std::puts(scene.error().message.c_str()), 1;
  const auto particles = rill::makeParticles(*scene);
  if (!particles || particles->positions.empty()) return std::puts("no particles"), 1;
  const auto refused = rill::parseScene("{", "broken", ".");
  if (refused) return std::puts("an invalid scene was accepted"), 1;
  return rill::version() == std::string_view(RILL_VERSION) ? 0 : 1;
}
