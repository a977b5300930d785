#pragma once
// Whitewater: shaders/whitewater in double precision, with a search over all particles.
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "rill/whitewater.hpp"
#include "shape/pose.hpp"
#include "sph/mesh_field.hpp"

namespace rill::reference {

/// A solid at the end of a step, relative to the origin.
struct WhiteSolid {
  Shape shape;
  Pose pose;
  std::shared_ptr<const MeshField> field = {};  ///< of a mesh
};

/// Fluid particles, m and m/s relative to the origin, and the solids among them.
struct WhiteFluid {
  std::vector<glm::dvec3> positions, velocities;
  double spacing = 0;  ///< m
  std::vector<WhiteSolid> solids = {};
};

/// Signed distance of a point from a solid and the outward normal.
SurfacePoint whiteDistance(const WhiteSolid& solid, const glm::dvec3& x);

/// What the fluid does at a particle; zeros where it is slow.
struct WhiteFlow {
  glm::dvec3 normal{0};   ///< out of the fluid
  double area = 0;        ///< of the particle's part of the surface, m^2
  double strainRate = 0;  ///< 1/s
  double curvature = 0;   ///< mean of the surface, above 0 where it is convex, 1/m
  double rate = 0;        ///< diffuse particles a second
};

struct WhiteParticle {
  glm::dvec3 position{0}, velocity{0};
  double age = 0;    ///< s
  uint32_t tag = 0;  ///< as in WhitewaterState::motion
};

/// Of each fluid particle.
std::vector<WhiteFlow> whiteFlow(const WhiteFluid& fluid, const WhitewaterDesc& desc);

/// The fluid's share of the space around a point, walls counted as fluid, and its mean velocity there.
struct WhiteSample {
  double share = 0;
  glm::dvec3 velocity{0};
};
WhiteSample whiteSample(const WhiteFluid& fluid, const WhitewaterDesc& desc, const glm::dvec3& point);

/// The particles after a step, without new ones. In their order.
std::vector<WhiteParticle> whiteAdvance(std::span<const WhiteParticle> particles, const WhiteFluid& fluid, const WhitewaterDesc& desc,
                                        double seconds);

/// Indices of the fluid's particles in the order of the bins of a device whose Whitewater has room for `capacity` of them.
std::vector<uint32_t> whiteOrder(const WhiteFluid& fluid, uint32_t capacity);

/// The particles that a step emits, in the order of the device. `step`: the number of steps before.
std::vector<WhiteParticle> whiteBirths(const WhiteFluid& fluid, const WhitewaterDesc& desc, double seconds, uint32_t step);

}  // namespace rill::reference
