#include "fluid/trial.hpp"

#include <cstdlib>
#include <cstring>
#include <random>

#include "shape/shape.hpp"

namespace rill::test {

const char* nameOf(Gather gather) {
  return gather == Gather::Texel ? "list through texel buffers"
                                 : (gather == Gather::Storage ? "list through storage buffers, passes merged" : "grid");
}

std::span<const Gather> gathersInTurn() {
  const char* chosen = std::getenv("RILL_TEST_GATHERS");
  return chosen && std::strcmp(chosen, "first") == 0 ? std::span(kGathers).first(1) : std::span(kGathers);
}

Scene Trial::timedScene() const {
  Scene timed = scene;
  timed.solver.time_step = step;
  return timed;
}

ParticleSet Trial::particles() const {
  ParticleSet set;
  set.origin = origin;
  for (const glm::dvec3& p : x) set.positions.push_back(narrow(p));
  for (const glm::dvec3& p : v) set.velocities.push_back(narrow(p));
  set.velocities.resize(set.positions.size());
  set.fluids = fluids;
  for (const glm::dvec4& c : concentration) set.concentrations.push_back({float(c.x), float(c.y), float(c.z), float(c.w)});
  return set;
}

Trial trial() {
  Trial t;
  t.scene.fluid.spacing = 1.0 / 16;
  t.scene.solver.tolerance = 0;
  t.scene.fluid.tensile = 0;
  t.scene.solver.cfl = 10;
  t.scene.solver.max_substeps = 256;
  t.scene.solver.relaxation = 0.7;
  t.scene.solver.regularization = 0.02;
  t.scene.solver.warm_start = 0.1;
  t.scene.solver.artificial_viscosity = 0;
  return t;
}

void setWalls(Trial& trial, glm::dvec3 size, SideMask open) {
  Domain domain;
  for (int a = 0; a < 3; ++a) {
    domain.min[a] = trial.origin[a];
    domain.max[a] = trial.origin[a] + size[a];
  }
  domain.open = open;
  trial.scene.domain = domain;
}

Solid ball(glm::dvec3 center, double radius) {
  Solid solid;
  solid.shape = SphereShape{{center.x, center.y, center.z}, radius};
  return solid;
}

Solid slab(glm::dvec3 low, glm::dvec3 high) {
  Solid solid;
  solid.shape = BoxShape{{low.x, low.y, low.z}, {high.x, high.y, high.z}};
  return solid;
}

std::vector<glm::dvec3> block(glm::ivec3 count, double d, glm::dvec3 from, double jitter, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-jitter, jitter);
  std::vector<glm::dvec3> x;
  for (int k = 0; k < count.z; ++k)
    for (int j = 0; j < count.y; ++j)
      for (int i = 0; i < count.x; ++i) {
        glm::dvec3 p = from + d * glm::dvec3(i + 0.5, j + 0.5, k + 0.5);
        for (int a = 0; a < 3; ++a) p[a] += d * part(random);
        x.push_back(p);
      }
  return x;
}

void addOutsideSolids(Trial& trial, const std::vector<glm::dvec3>& points) {
  for (const glm::dvec3& x : points) {
    bool outside = true;
    for (const Solid& solid : trial.scene.solids)
      outside &= surfaceAt(solid.shape, solidPose(solid, 0), {x.x, x.y, x.z}).distance > 0.52 * trial.d();
    if (outside) trial.x.push_back(x);
  }
}

}  // namespace rill::test
