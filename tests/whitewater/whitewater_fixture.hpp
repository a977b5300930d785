#pragma once
// Steps of diffuse particles past given fluid, and the comparison with the reference.
#include <bit>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <vector>

#include "reference/whitewater.hpp"
#include "rill/whitewater.hpp"
#include "shape/records.hpp"
#include "sph/mesh_field.hpp"
#include "support/gpu_test.hpp"
#include "whitewater/whitewater_records.h"

namespace rill::test {
namespace whitewater_test {

using glm::dvec3;
using reference::WhiteFluid;
using reference::WhiteParticle;
using reference::WhiteSolid;

inline Float3 velocityOf(const std::array<uint32_t, 4>& motion) {
  return {std::bit_cast<float>(motion[0]), std::bit_cast<float>(motion[1]), std::bit_cast<float>(motion[2])};
}

class WhitewaterTest : public GpuTest {
 protected:
  Whitewater create(const WhitewaterDesc& desc) {
    auto made = Whitewater::create(device(), desc);
    EXPECT_TRUE(made) << made.error().message;
    return *std::move(made);
  }
  /// Steps of equal length past the same fluid.
  WhitewaterSnapshot step(Whitewater& white, const WhiteFluid& fluid, double seconds, int steps = 1) {
    std::vector<Float4> position, velocity;
    for (const auto& p : fluid.positions) position.push_back({float(p.x), float(p.y), float(p.z), 7});
    for (const auto& v : fluid.velocities) velocity.push_back({float(v.x), float(v.y), float(v.z), 1});
    const auto count = static_cast<uint32_t>(position.size());
    const Buffer positions = upload("position", position.empty() ? std::vector<Float4>(1) : position);
    const Buffer velocities = upload("velocity", velocity.empty() ? std::vector<Float4>(1) : velocity);
    std::vector<SolidRecord> solids;
    std::vector<uint32_t> words;
    for (const WhiteSolid& solid : fluid.solids) {
      SolidRecord& record = solids.emplace_back();
      record.shape = recordOf(solid.shape);
      record.pose = recordOf(solid.pose, {});
      record.radius = static_cast<float>(boundingRadius(solid.shape));
      record.body = kNoBody;
      if (!solid.field) continue;
      record.shape.field = static_cast<uint32_t>(words.size());
      words.insert(words.end(), solid.field->words().begin(), solid.field->words().end());
    }
    const Buffer records = upload("solids", solids.empty() ? std::vector<SolidRecord>(1) : solids);
    const Buffer fields = upload("fields", words.empty() ? std::vector<uint32_t>(1) : words);
    Graph graph;
    Ticket tickets[3];
    for (int k = 0; k < steps; ++k) {
      graph.reset();
      FluidState state;
      state.capacity = count;
      state.spacing = static_cast<float>(fluid.spacing);
      state.position = graph.import("position", importOf(positions));
      state.velocity = graph.import("velocity", importOf(velocities));
      if (!solids.empty()) {
        state.boundaries = graph.import("solids", importOf(records));
        if (!words.empty()) state.meshWords = graph.import("fields of meshes", importOf(fields));
      }
      const WhitewaterState made = white.addTo(graph, state, seconds);
      tickets[0] = graph.readback(made.counts);
      if (k + 1 == steps) {
        tickets[1] = graph.readback(made.place);
        tickets[2] = graph.readback(made.motion);
      }
      run(graph);
    }
    WhitewaterSnapshot after;
    after.counts = read<uint32_t>(graph, tickets[0]);
    after.place = read<Float4>(graph, tickets[1]);
    after.motion = read<std::array<uint32_t, 4>>(graph, tickets[2]);
    if (after.counts.empty() || after.counts[kWhiteCount] > after.place.size()) {
      ADD_FAILURE() << "no counts";
      return {};
    }
    after.place.resize(after.counts[kWhiteCount]);
    after.motion.resize(after.counts[kWhiteCount]);
    return after;
  }
};

inline WhiteFluid block(double spacing, const dvec3& size, const std::function<dvec3(const dvec3&)>& velocity, double jitter = 0) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-jitter * spacing, jitter * spacing);
  WhiteFluid fluid{.spacing = spacing};
  for (int i = 0; i < std::lround(size.x / spacing); ++i)
    for (int j = 0; j < std::lround(size.y / spacing); ++j)
      for (int k = 0; k < std::lround(size.z / spacing); ++k) {
        const dvec3 x = spacing * dvec3(i + 0.5, j + 0.5, k + 0.5) + dvec3(off(random), off(random), off(random));
        fluid.positions.push_back(x);
        fluid.velocities.push_back(velocity(x));
      }
  return fluid;
}

inline WhiteFluid ball(double spacing, double radius, const std::function<dvec3(const dvec3&)>& velocity) {
  WhiteFluid fluid{.spacing = spacing};
  const int n = static_cast<int>(radius / spacing) + 1;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k)
        if (const dvec3 x = spacing * dvec3(i + 0.5, j + 0.5, k + 0.5); glm::length(x) < radius) {
          fluid.positions.push_back(x);
          fluid.velocities.push_back(velocity(x));
        }
  return fluid;
}

inline WhitewaterSnapshot snapshotOf(const std::vector<WhiteParticle>& particles) {
  WhitewaterSnapshot s;
  s.counts.assign(kWhiteCountWords, 0);
  s.counts[kWhiteCount] = static_cast<uint32_t>(particles.size());
  for (const WhiteParticle& p : particles) {
    s.place.push_back({float(p.position.x), float(p.position.y), float(p.position.z), float(p.age)});
    s.motion.push_back({std::bit_cast<uint32_t>(float(p.velocity.x)), std::bit_cast<uint32_t>(float(p.velocity.y)),
                        std::bit_cast<uint32_t>(float(p.velocity.z)), p.tag});
  }
  return s;
}

/// Compares particles by their random bits, in order. A few may differ: where a share or a number is close to a threshold.
inline void expectLikeReference(const WhitewaterSnapshot& made, size_t from, size_t count, const std::vector<WhiteParticle>& expected,
                                double tolerance, size_t few = 0) {
  std::multimap<uint32_t, size_t> byTag;
  for (size_t k = 0; k < expected.size(); ++k) byTag.emplace(expected[k].tag >> 2, k);
  size_t missing = 0, kinds = 0, far = 0, last = 0, unordered = 0;
  for (size_t k = from; k < from + count; ++k) {
    const auto found = byTag.find(made.motion[k][3] >> 2);
    if (found == byTag.end()) {
      ++missing;
      continue;
    }
    const WhiteParticle& p = expected[found->second];
    unordered += found->second < last ? 1 : 0;
    last = found->second;
    if ((p.tag & 3) != (made.motion[k][3] & 3)) {
      ++kinds;
      continue;
    }
    const Float3 v = velocityOf(made.motion[k]);
    const dvec3 x(made.place[k].x, made.place[k].y, made.place[k].z);
    far += glm::length(x - p.position) > tolerance || glm::length(dvec3(v.x, v.y, v.z) - p.velocity) > 100 * tolerance ||
                   std::abs(double{made.place[k].w} - p.age) > 1e-5
               ? 1
               : 0;
  }
  EXPECT_NEAR(double(count), double(expected.size()), 2 + 0.003 * double(expected.size()));
  EXPECT_LE(missing, 2 + expected.size() / 300);
  EXPECT_LE(kinds, 2 + expected.size() / 300);
  EXPECT_LE(far, few);
  EXPECT_LE(unordered, 2u);
}

}  // namespace whitewater_test
}  // namespace rill::test
