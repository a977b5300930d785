#include "reference/whitewater.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <numeric>

#include "whitewater/white_hash.h"
#include "whitewater/whitewater_records.h"

namespace rill::reference {
namespace {

using glm::dvec3;

double supportOf(const WhiteFluid& fluid) { return double{kWhiteSupport} * fluid.spacing; }
dvec3 whiteVector(const Double3& v) { return {v.x, v.y, v.z}; }

double kernelOf(double q) {
  return q < 1 ? 315 / (64 * std::numbers::pi * std::pow(double{kWhiteSupport}, 3)) * std::pow(1 - q * q, 3) : 0;
}
double kernelSlopeOf(double q) {
  return q < 1 ? -6 * 315 / (64 * std::numbers::pi * std::pow(double{kWhiteSupport}, 3)) * q * std::pow(1 - q * q, 2) : 0;
}
/// Integral of the kernel over a half-space, by Simpson's rule over its marginal.
double shareWithin(double distance) {
  const double end = std::clamp(distance, -1.0, 1.0);
  const auto marginal = [](double z) { return 315.0 / 256 * std::pow(1 - z * z, 4); };
  constexpr int kParts = 200;
  double sum = 0;
  for (int k = 0; k < kParts; ++k) {
    const double a = -1 + (end + 1) * k / kParts, b = -1 + (end + 1) * (k + 1) / kParts;
    sum += (b - a) / 6 * (marginal(a) + 4 * marginal(0.5 * (a + b)) + marginal(b));
  }
  return sum;
}

struct WhiteWall {
  int axis;
  double at, inward;  // m; 1 or -1
};
std::vector<WhiteWall> wallsOf(const WhitewaterDesc& desc) {
  std::vector<WhiteWall> walls;
  if (!desc.domain) return walls;
  for (int axis = 0; axis < 3; ++axis) {
    const size_t a = size_t(axis);
    if (!(desc.domain->open >> (2 * axis) & 1)) walls.push_back({axis, desc.domain->min[a] - desc.origin[a], 1});
    if (!(desc.domain->open >> (2 * axis + 1) & 1)) walls.push_back({axis, desc.domain->max[a] - desc.origin[a], -1});
  }
  return walls;
}

dvec3 backAgain(const Pose& pose, const Double3& local) { return whiteVector(pose.center) + whiteVector(toScene(pose, local)); }

/// A particle's path in a step, cut off where it first meets each solid.
struct WhitePath {
  dvec3 to, velocity;
  bool met = false;
};

/// Where a line first meets a solid from outside, m; as it does the surface of its field, of a mesh.
std::optional<double> entryOf(const WhiteSolid& solid, const Double3& from, const dvec3& along, double length) {
  if (!solid.field) return rayEntry(solid.shape, from, {along.x, along.y, along.z});
  const auto inside = [&](double t) {
    return solid.field->sample({from.x + t * along.x, from.y + t * along.y, from.z + t * along.z}).distance < 0;
  };
  constexpr int kParts = 400;
  if (inside(0)) return std::nullopt;
  for (int k = 1; k <= kParts; ++k) {
    double low = length * (k - 1) / kParts, high = length * k / kParts;
    if (!inside(high)) continue;
    for (int n = 0; n < 40; ++n) (inside(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    return high;
  }
  return std::nullopt;
}

/// From x to `to`: in the frame of a solid, which moves and turns back to its place at the start of the step, the path is a straight line.
WhitePath heldBack(const WhiteFluid& fluid, const dvec3& x, const dvec3& to, const dvec3& velocity, double seconds) {
  WhitePath path{to, velocity};
  for (const WhiteSolid& solid : fluid.solids) {
    Pose before = solid.pose;
    for (glm::length_t a = 0; a < 3; ++a) before.center[a] -= seconds * before.velocity[a];
    before.rotation = turned(before.rotation, -seconds, before.angularVelocity);
    const Double3 from = localPoint(before, {x.x, x.y, x.z}), end = localPoint(solid.pose, {path.to.x, path.to.y, path.to.z});
    const dvec3 line = whiteVector(end) - whiteVector(from);
    const double length = glm::length(line);
    const dvec3 along = length > 0 ? line / length : dvec3(0);
    const std::optional<double> entry = length > 0 ? entryOf(solid, from, along, length) : std::nullopt;
    dvec3 at = path.to;
    if (entry && *entry <= length) {
      const dvec3 local = whiteVector(from) + *entry * along;
      at = backAgain(solid.pose, {local.x, local.y, local.z});
    } else if (whiteDistance(solid, at).distance >= 0) {
      continue;
    }
    const SurfacePoint surface = whiteDistance(solid, at);
    const dvec3 normal = whiteVector(surface.normal);
    path.met = true;
    path.to = at + (double{kWhiteClearance} * fluid.spacing - surface.distance) * normal;
    const dvec3 moving = whiteVector(velocityAt(solid.pose, {path.to.x, path.to.y, path.to.z}));
    path.velocity -= std::min(glm::dot(path.velocity - moving, normal), 0.0) * normal;
  }
  return path;
}

/// Whether no particle can be at x: in a solid, or farther beyond a wall than `slack`.
bool isBlocked(const WhiteFluid& fluid, const WhitewaterDesc& desc, const dvec3& x, double slack) {
  for (const WhiteSolid& solid : fluid.solids)
    if (whiteDistance(solid, x).distance < 0) return true;
  for (const WhiteWall& wall : wallsOf(desc))
    if (wall.inward * (x[wall.axis] - wall.at) < -slack) return true;
  return false;
}

double unitOf(uint32_t number) { return double(number >> 8) / 16777216; }

dvec3 inBall(uint32_t hash, uint32_t first) {
  const double z = 2 * unitOf(whiteNumber(hash, first)) - 1, turn = 2 * std::numbers::pi * unitOf(whiteNumber(hash, first + 1));
  const double ring = std::sqrt(1 - z * z), r = std::cbrt(unitOf(whiteNumber(hash, first + 2)));
  return r * dvec3(ring * std::cos(turn), ring * std::sin(turn), z);
}

double ramp(double x, double low, double high) { return std::clamp((x - low) / (high - low), 0.0, 1.0); }

}  // namespace

SurfacePoint whiteDistance(const WhiteSolid& solid, const dvec3& x) {
  if (!solid.field) return surfaceAt(solid.shape, solid.pose, {x.x, x.y, x.z});
  const MeshField::Sample sample = solid.field->sample(localPoint(solid.pose, {x.x, x.y, x.z}));
  const dvec3 gradient = whiteVector(toScene(solid.pose, sample.gradient));
  const dvec3 normal = glm::length(gradient) > 1e-6 ? glm::normalize(gradient) : whiteVector(toScene(solid.pose, {0, 1, 0}));
  return {sample.distance, {normal.x, normal.y, normal.z}};
}

std::vector<WhiteFlow> whiteFlow(const WhiteFluid& fluid, const WhitewaterDesc& desc) {
  const double h = supportOf(fluid), d = fluid.spacing;
  const size_t n = fluid.positions.size();
  std::vector<WhiteFlow> flows(n);
  const auto forNear = [&](size_t i, auto&& visit) {
    for (size_t j = 0; j < n; ++j)
      if (const dvec3 to = fluid.positions[j] - fluid.positions[i]; glm::length(to) < h) visit(j, to, glm::length(to) / h);
  };
  for (size_t i = 0; i < n; ++i) {
    WhiteFlow& flow = flows[i];
    if (glm::dot(fluid.velocities[i], fluid.velocities[i]) < double{kWhiteSlow}) continue;
    dvec3 slope(0);
    glm::dmat3 spread(0), moved(0);
    forNear(i, [&](size_t j, const dvec3& to, double q) {
      const dvec3 dv = fluid.velocities[j] - fluid.velocities[i];
      if (q > 0) slope -= kernelSlopeOf(q) * glm::normalize(to);
      spread += kernelOf(q) * glm::outerProduct(to / d, to / d);
      moved += kernelOf(q) * glm::outerProduct(dv, to / d);
    });
    for (const WhiteWall& wall : wallsOf(desc)) {
      const double s = wall.inward * (fluid.positions[i][wall.axis] - wall.at) / h;
      if (std::abs(s) < 1) slope[wall.axis] -= wall.inward * 315.0 / 256 * std::pow(1 - s * s, 4);
    }
    for (const WhiteSolid& solid : fluid.solids) {
      const SurfacePoint surface = whiteDistance(solid, fluid.positions[i]);
      if (const double s = surface.distance / h; std::abs(s) < 1)
        slope -= 315.0 / 256 * std::pow(1 - s * s, 4) * whiteVector(surface.normal);
    }
    const double steep = glm::length(slope), trace = spread[0][0] + spread[1][1] + spread[2][2];
    flow.normal = steep > 1e-6 ? -slope / steep : dvec3(0);
    flow.area = 2 * d * d * steep / double{kWhiteSupport};
    if (trace > 1e-3) {
      const glm::dmat3 gradient = moved * glm::inverse(spread + glm::dmat3(1e-3 * trace));
      const glm::dmat3 strain = 0.5 * (gradient + glm::transpose(gradient));
      for (int a = 0; a < 3; ++a) flow.strainRate += 2 * glm::dot(strain[a], strain[a]);
      flow.strainRate = std::sqrt(flow.strainRate) / d;
    }
  }
  const auto brokenUp = [&](double acceleration) {
    return ramp(acceleration / std::max(glm::length(whiteVector(desc.gravity)), 1e-3), kWhiteInertiaLow, kWhiteInertiaHigh);
  };
  for (size_t i = 0; i < n; ++i) {
    WhiteFlow& flow = flows[i];
    double bend = 0, squares = 0;
    forNear(i, [&](size_t j, const dvec3& to, double q) {
      const double weight = kernelOf(q) * flows[j].area;
      bend += weight * glm::dot(flows[j].normal - flow.normal, to);
      squares += weight * glm::dot(to, to);
    });
    flow.curvature = squares > 0 ? std::clamp(bend / squares, 0.0, 1 / d) : 0;
    const dvec3& v = fluid.velocities[i];
    const double speed = glm::length(v), outward = glm::dot(v, flow.normal);
    const double energy = ramp(0.5 * speed * speed, kWhiteEnergyLow, kWhiteEnergyHigh);
    double volume = desc.trapping * d * d * d * flow.strainRate * brokenUp(speed * flow.strainRate);
    if (flow.area > 0.01 * d * d && outward > double{kWhiteCrestCosine} * speed)
      volume += desc.breaking * flow.area * outward * brokenUp(outward * outward * flow.curvature);
    flow.rate = energy * volume / desc.parcel_m3;
  }
  return flows;
}

WhiteSample whiteSample(const WhiteFluid& fluid, const WhitewaterDesc& desc, const dvec3& point) {
  WhiteSample sample;
  double weights = 0, inside = 1;
  for (size_t j = 0; j < fluid.positions.size(); ++j) {
    const double weight = kernelOf(glm::length(fluid.positions[j] - point) / supportOf(fluid));
    weights += weight;
    sample.velocity += weight * fluid.velocities[j];
  }
  for (const WhiteWall& wall : wallsOf(desc)) inside *= shareWithin(wall.inward * (point[wall.axis] - wall.at) / supportOf(fluid));
  for (const WhiteSolid& solid : fluid.solids) inside *= shareWithin(whiteDistance(solid, point).distance / supportOf(fluid));
  if (weights > 0) sample.velocity /= weights;
  sample.share = weights / std::max(inside, 0.1);
  return sample;
}

std::vector<WhiteParticle> whiteAdvance(std::span<const WhiteParticle> particles, const WhiteFluid& fluid, const WhitewaterDesc& desc,
                                        double seconds) {
  std::vector<WhiteParticle> after;
  const dvec3 g = whiteVector(desc.gravity);
  for (const WhiteParticle& p : particles) {
    const bool flew = (p.tag & 3) == kWhiteSpray;
    const WhiteSample at = whiteSample(fluid, desc, p.position + seconds * p.velocity + (flew ? 0.5 * seconds * seconds * g : dvec3(0)));
    const uint32_t kind = at.share < double{kWhiteSprayBelow}    ? kWhiteSpray
                          : at.share > double{kWhiteBubbleAbove} ? kWhiteBubble
                                                                 : kWhiteFoam;
    WhiteParticle to = p;
    if (kind == kWhiteSpray) {
      to.velocity += seconds * g;
    } else if (kind == kWhiteFoam) {
      to.velocity = at.velocity;
    } else {
      const double pull = glm::length(g);
      const dvec3 rising = at.velocity - (pull > 1e-3 ? double{kWhiteRise} * g / pull : dvec3(0));
      to.velocity = rising + std::exp(-2 * seconds * pull / double{kWhiteRise}) * (p.velocity - rising);
    }
    to.position += 0.5 * seconds * (p.velocity + to.velocity);
    to.age += seconds * (kind == kWhiteBubble ? double{kWhiteBubbleAging} : 1);
    to.tag = (p.tag & ~3u) | kind;
    bool lives = to.age < desc.life_s * (0.5 + unitOf(pairMix(p.tag >> 2)));
    for (const WhiteWall& wall : wallsOf(desc))
      if (wall.inward * (to.position[wall.axis] - wall.at) < 0) {
        to.position[wall.axis] = wall.at;
        lives = lives && kind != kWhiteSpray;
      }
    const WhitePath path = heldBack(fluid, p.position, to.position, to.velocity, seconds);
    to.position = path.to;
    to.velocity = path.velocity;
    if (path.met) lives = lives && kind != kWhiteSpray && !isBlocked(fluid, desc, path.to, double{kWhiteClearance} * fluid.spacing);
    if (lives) after.push_back(to);
  }
  return after;
}

std::vector<uint32_t> whiteOrder(const WhiteFluid& fluid, uint32_t capacity) {
  const uint32_t bins = std::bit_ceil(std::max(capacity / 4, 64u));
  std::vector<uint32_t> order(fluid.positions.size()), bin;
  std::iota(order.begin(), order.end(), 0u);
  for (const dvec3& x : fluid.positions) {
    std::array<uint32_t, 3> cell{};
    for (int a = 0; a < 3; ++a)
      cell[size_t(a)] = uint32_t(int32_t(std::floor(static_cast<float>(x[a]) / (kWhiteSupport * static_cast<float>(fluid.spacing)))));
    bin.push_back(whiteBin(cell[0], cell[1], cell[2], bins));
  }
  std::ranges::stable_sort(order, {}, [&](uint32_t i) { return bin[i]; });
  return order;
}

std::vector<WhiteParticle> whiteBirths(const WhiteFluid& fluid, const WhitewaterDesc& desc, double seconds, uint32_t step) {
  std::vector<WhiteParticle> born;
  const std::vector<WhiteFlow> flows = whiteFlow(fluid, desc);
  const std::vector<uint32_t> order = whiteOrder(fluid, desc.capacity);
  const auto seed = static_cast<uint32_t>(desc.seed ^ desc.seed >> 32);
  for (uint32_t slot = 0; slot < order.size(); ++slot) {
    const WhiteFlow& flow = flows[order[slot]];
    const dvec3& v = fluid.velocities[order[slot]];
    const double speed = glm::length(v);
    const auto count = static_cast<uint32_t>(flow.rate * seconds + unitOf(whiteHash(seed, slot, step, kWhiteNone)));
    const bool leaves = glm::dot(v, flow.normal) > double{kWhiteCrestCosine} * speed;
    const uint32_t kind = flow.area < 0.2 * fluid.spacing * fluid.spacing ? kWhiteBubble : leaves ? kWhiteSpray : kWhiteFoam;
    for (uint32_t k = 0; k < std::min(count, kWhiteMaxBirths); ++k) {
      const uint32_t hash = whiteHash(seed, slot, step, k);
      WhiteParticle p;
      p.position = fluid.positions[order[slot]] + fluid.spacing * inBall(hash, 0) - unitOf(whiteNumber(hash, 3)) * seconds * v;
      for (const WhiteWall& wall : wallsOf(desc))
        if (wall.inward * (p.position[wall.axis] - wall.at) < 0) p.position[wall.axis] = wall.at;
      const dvec3& origin = fluid.positions[order[slot]];
      const WhitePath path = heldBack(fluid, origin, p.position, v + double{kWhiteSpread} * speed * inBall(hash, 4), 0);
      p.position = path.met && isBlocked(fluid, desc, path.to, 0) ? origin : path.to;
      p.velocity = path.velocity;
      p.tag = hash << 2 | kind;
      born.push_back(p);
    }
  }
  return born;
}

}  // namespace rill::reference
