#include "offline/whitewater_run.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "views/whitewater_view_records.h"
#include "whitewater/whitewater_records.h"

namespace rill::offline {
namespace {

/// Diffuse particles that stand for as much volume as the fluid has. It does not depend on the spacing, so nor does the emission.
constexpr double kParcels = 1'500'000;
constexpr uint32_t kRandomShift = 8;  ///< of a tag; below are its class and bits that pictures do not use

template <class Record>
std::vector<Record> wholeRecords(std::span<const std::byte> bytes) {
  std::vector<Record> all(bytes.size() / sizeof(Record));
  if (!all.empty()) std::memcpy(all.data(), bytes.data(), all.size() * sizeof(Record));
  return all;
}

}  // namespace

WhitewaterDesc whitewaterOf(const Scene& scene, const ParticleSet& particles, uint32_t capacity) {
  const double fluid = double(std::max<uint64_t>(particles.positions.size(), capacity)) * std::pow(scene.fluid.spacing, 3);
  return {.capacity = capacity,
          .parcel_m3 = fluid / kParcels,
          .gravity = scene.gravity,
          .domain = scene.domain,
          .origin = particles.origin,
          .solids = static_cast<uint32_t>(scene.solids.size()),
          .meshes = std::ranges::any_of(scene.solids, [](const Solid& s) { return std::holds_alternative<MeshShape>(s.shape); }),
          .seed = scene.seed};
}

double drawnRadius(const WhitewaterDesc& desc) { return std::cbrt(desc.parcel_m3 * 3 / (4 * std::numbers::pi)); }

Double3 gravityAt(const Scene& scene, double time_s) {
  Double3 gravity = scene.gravity;
  for (const GravityChange& change : scene.gravity_changes)
    if (change.at <= time_s) gravity = change.value;
  return gravity;
}

WhitewaterTickets whitewaterReadout(Graph& graph, const WhitewaterState& state) {
  return {graph.readback(state.place), graph.readback(state.motion), graph.readback(state.counts)};
}

WhitewaterSnapshot collectWhitewater(const Graph& graph, const WhitewaterTickets& tickets) {
  WhitewaterSnapshot state;
  state.counts = wholeRecords<uint32_t>(graph.data(tickets.counts));
  state.place = wholeRecords<Float4>(graph.data(tickets.place));
  state.motion = wholeRecords<std::array<uint32_t, 4>>(graph.data(tickets.motion));
  const size_t count = state.counts.empty() ? 0 : std::min<size_t>({state.counts[0], state.place.size(), state.motion.size()});
  state.place.resize(count);
  state.motion.resize(count);
  return state;
}

DiffuseParticles diffuseParticles(const WhitewaterSnapshot& state, const Double3& origin) {
  DiffuseParticles all;
  for (size_t k = 0; k < state.place.size(); ++k) {
    const Float4& p = state.place[k];
    const auto& [x, y, z, tag] = state.motion[k];
    all.positions.push_back({static_cast<float>(origin.x + double{p.x}), static_cast<float>(origin.y + double{p.y}),
                             static_cast<float>(origin.z + double{p.z})});
    all.velocities.push_back({std::bit_cast<float>(x), std::bit_cast<float>(y), std::bit_cast<float>(z)});
    all.ages.push_back(p.w);
    all.classes.push_back(static_cast<WhitewaterClass>(tag & 3));
    all.randoms.push_back(tag >> kRandomShift);
  }
  return all;
}

WhitewaterSnapshot whitewaterSnapshot(const DiffuseParticles& particles, const Double3& origin) {
  WhitewaterSnapshot state;
  state.counts.resize(kWhiteCountWords);
  state.counts[kWhiteCount] = static_cast<uint32_t>(particles.positions.size());
  for (size_t k = 0; k < particles.positions.size(); ++k) {
    const Float3 &p = particles.positions[k], &v = particles.velocities[k];
    state.place.push_back(
        {static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y), static_cast<float>(p.z - origin.z), particles.ages[k]});
    const uint32_t random = particles.randoms.empty() ? kWhiteMeanTag : particles.randoms[k] << kRandomShift;
    state.motion.push_back({std::bit_cast<uint32_t>(v.x), std::bit_cast<uint32_t>(v.y), std::bit_cast<uint32_t>(v.z),
                            random | static_cast<uint32_t>(particles.classes[k])});
  }
  return state;
}

}  // namespace rill::offline
