#include "rill/whitewater.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "core/words.hpp"
#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/graph_impl.hpp"
#include "render/check_input.hpp"
#include "shared/solid_records.h"
#include "whitewater/whitewater_impl.hpp"

namespace rill {
namespace {

constexpr uint32_t kMaxWhitewater = 1u << 22;

Error whiteError(ErrorKind kind, const std::string& message) { return {kind, "whitewater: " + message}; }

Expected<void> checkWhitewater(const WhitewaterDesc& desc) {
  const auto number = [](const char* name, double value, bool valid, const char* expected) -> Expected<void> {
    if (valid && std::isfinite(value)) return {};
    return whiteError(ErrorKind::BadInput, std::string(name) + " is " + shortestNumber(value) + "; expected " + expected);
  };
  for (const auto& [name, value] : {std::pair{"capacity", desc.capacity}, {"room", desc.room}})
    if (value < 1 || value > kMaxWhitewater)
      return whiteError(ErrorKind::BadInput,
                        std::string(name) + " is " + grouped(value) + "; expected 1 to " + grouped(kMaxWhitewater) + " particles");
  if (auto ok = number("parcel_m3", desc.parcel_m3, desc.parcel_m3 >= 1e-30 && desc.parcel_m3 <= 1e30, "1e-30 to 1e30 (m^3)"); !ok)
    return ok;
  if (auto ok = number("trapping", desc.trapping, desc.trapping >= 0 && desc.trapping <= 1e6, "0 to 1e6"); !ok) return ok;
  if (auto ok = number("breaking", desc.breaking, desc.breaking >= 0 && desc.breaking <= 1e6, "0 to 1e6"); !ok) return ok;
  if (auto ok = number("life_s", desc.life_s, desc.life_s >= 1e-6 && desc.life_s <= 1e9, "1e-6 to 1e9 (s)"); !ok) return ok;
  for (size_t a = 0; a < 3; ++a)
    for (const auto& [name, vector] : {std::pair{"gravity", desc.gravity}, {"origin", desc.origin}})
      if (auto ok = number(name, vector[a], std::abs(vector[a]) <= 1e30, "numbers of at most 1e30"); !ok) return ok;
  if (!desc.snapshot) return {};
  const WhitewaterSnapshot& s = *desc.snapshot;
  const size_t count = s.place.size();
  const bool fits = count <= desc.room && s.motion.size() == count &&
                    (s.counts.empty() ? count == 0 : s.counts.size() == kWhiteCountWords && s.counts[kWhiteCount] == count);
  if (!fits) return whiteError(ErrorKind::BadInput, "the snapshot of " + grouped(count) + " particles does not fit");
  return {};
}

Expected<void> checkSolids(const Graph& graph, const FluidState& fluid, const WhitewaterDesc& desc) {
  if (desc.solids == 0) return {};
  const auto& resources = implOf(graph).resources;
  const uint32_t solids = fluid.boundaries.index;
  if (fluid.boundaries == BufferRef{} || solids >= resources.size() || resources[solids].size < desc.solids * sizeof(SolidRecord))
    return whiteError(ErrorKind::BadInput, "FluidState::boundaries is null or too small; expected the records of " + grouped(desc.solids) +
                                               (desc.solids == 1 ? " solid" : " solids"));
  if (desc.meshes && fluid.meshWords == BufferRef{})
    return whiteError(ErrorKind::BadInput, "FluidState::meshWords is null; expected the fields of the meshes among the solids");
  return {};
}

}  // namespace

Expected<std::unique_ptr<WhitewaterImpl>> WhitewaterImpl::create(Device& device, const WhitewaterDesc& desc) {
  if (auto valid = checkWhitewater(desc); !valid) return valid.error();
  auto impl = std::make_unique<WhitewaterImpl>();
  impl->desc = desc;
  impl->desc.snapshot = nullptr;
  impl->bins_ = std::bit_ceil(std::max(desc.capacity / 4, 64u));
  impl->bytes = uint64_t{desc.room} * 32 + kWhiteCountBytes;
  const uint64_t largest = std::max<uint64_t>(desc.room, desc.capacity) * 16;
  const auto tooLarge = [&](uint64_t needed, uint64_t found) {
    return whiteError(ErrorKind::TooLarge, grouped(desc.room) + " diffuse particles need " + grouped(needed) + " bytes; found " +
                                               grouped(found) + " on the device");
  };
  if (largest > device.info().maxBufferBytes) return tooLarge(largest, device.info().maxBufferBytes);
  if (impl->bytes > device.availableBytes()) return tooLarge(impl->bytes, device.availableBytes());

  auto sort = KeySort::create(device, {.count = desc.capacity, .keyRange = uint64_t{impl->bins_} + 1, .start = true});
  if (!sort) return sort.error();
  impl->sort_.emplace(*std::move(sort));
  for (const auto& [scan, count] : {std::pair{&impl->birthScan_, desc.capacity}, {&impl->aliveScan_, desc.room}}) {
    auto created = Scan::create(device, count + 1);
    if (!created) return created.error();
    *scan = *created;
  }
  ModulePipelines make(device);
  const bool texels = usesTexelReads(device);
  const auto amongSolids = [&](const std::string& name, bool reads) {
    return desc.solids == 0 ? make.make(name, reads) : make.make(name + "_solids", reads, {{"MESHES", desc.meshes}});
  };
  impl->pipelines_ = {.keys = make.make("whitewater/keys"),
                      .gather = make.make("whitewater/gather"),
                      .surface = amongSolids("whitewater/surface", texels),
                      .births = make.make("whitewater/births", texels),
                      .begin = make.make("whitewater/begin"),
                      .advance = amongSolids("whitewater/advance", texels),
                      .compact = make.make("whitewater/compact"),
                      .emit = amongSolids("whitewater/emit", false),
                      .finish = make.make("whitewater/finish")};
  if (auto made = make.result(); !made) return made.error();
  if (auto made = impl->makeBuffers(device); !made) return made.error();
  const size_t staged = desc.snapshot ? desc.snapshot->place.size() : 0;
  auto staging = createBuffer(device, "whitewater start", kWhiteCountBytes + staged * 32, MemoryKind::Upload);
  if (!staging) return staging.error();
  impl->staging_ = *std::move(staging);
  impl->stage(desc.snapshot);
  return impl;
}

Expected<void> WhitewaterImpl::makeBuffers(Device& device) {
  struct Kept {
    const char* name;
    Buffer* buffer;
    uint64_t size;
  };
  for (const Kept& kept :
       {Kept{"whitewater places", &place_, uint64_t{desc.room} * 16}, Kept{"whitewater motions", &motion_, uint64_t{desc.room} * 16},
        Kept{"whitewater counts", &counts_, kWhiteCountBytes}}) {
    auto made = createBuffer(device, kept.name, kept.size);
    if (!made) return made.error();
    *kept.buffer = *std::move(made);
  }
  return {};
}

/// Counts, then places, then motions.
void WhitewaterImpl::stage(const WhitewaterSnapshot* snapshot) {
  std::byte* to = staging_.mapped();
  std::memset(to, 0, kWhiteCountBytes);
  if (!snapshot || snapshot->counts.empty()) return;
  std::memcpy(to, snapshot->counts.data(), kWhiteCountBytes);
  staged_ = snapshot->place.size();
  if (staged_ == 0) return;
  std::memcpy(to + kWhiteCountBytes, snapshot->place.data(), staged_ * 16);
  std::memcpy(to + kWhiteCountBytes + staged_ * 16, snapshot->motion.data(), staged_ * 16);
}

Expected<Whitewater> Whitewater::create(Device& device, const WhitewaterDesc& desc) {
  auto impl = WhitewaterImpl::create(device, desc);
  if (!impl) return impl.error();
  return Whitewater(*std::move(impl));
}

Whitewater::Whitewater(std::unique_ptr<WhitewaterImpl> impl) : impl_(std::move(impl)) {}
Whitewater::~Whitewater() = default;
Whitewater::Whitewater(Whitewater&&) noexcept = default;
Whitewater& Whitewater::operator=(Whitewater&&) noexcept = default;

WhitewaterState Whitewater::addTo(Graph& graph, const FluidState& fluid, double seconds, std::optional<Double3> gravity) {
  auto valid = checkFluid(graph, fluid);
  if (valid && fluid.capacity > impl_->desc.capacity)
    valid = whiteError(ErrorKind::BadInput, "FluidState::capacity is " + grouped(fluid.capacity) + "; expected at most " +
                                                grouped(impl_->desc.capacity) + ", the whitewater's capacity");
  if (valid && fluid.capacity > 0 && fluid.velocity == BufferRef{})
    valid = whiteError(ErrorKind::BadInput, "FluidState::velocity is null; expected the velocities of the fluid");
  const auto& resources = implOf(graph).resources;
  const uint32_t velocity = fluid.velocity.index;
  if (valid && fluid.capacity > 0 && velocity < resources.size() && resources[velocity].size < uint64_t{fluid.capacity} * 16)
    valid = whiteError(ErrorKind::BadInput, "FluidState::velocity has " + grouped(resources[velocity].size) +
                                                " bytes; expected 16 for each of its " + grouped(fluid.capacity) + " particles");
  if (valid && fluid.capacity > 0 && seconds > 0) valid = checkSolids(graph, fluid, impl_->desc);
  if (valid && !(seconds >= 0 && seconds <= 1e6))
    valid = whiteError(ErrorKind::BadInput, "the step is " + shortestNumber(seconds) + "; expected 0 to 1e6 (s)");
  const Double3 pull = gravity.value_or(impl_->desc.gravity);
  for (const double a : pull)
    if (valid && !(std::abs(a) <= 1e30))
      valid = whiteError(ErrorKind::BadInput, "gravity is " + shortestNumber(a) + "; expected numbers of at most 1e30 (m/s^2)");
  if (!valid) {
    implOf(graph).fail(valid.error().message);
    return {};
  }
  return impl_->addTo(graph, fluid, seconds, pull);
}

const WhitewaterDesc& Whitewater::desc() const { return impl_->desc; }
uint64_t Whitewater::bytes() const { return impl_->bytes; }

WhitewaterStats whitewaterStats(std::span<const uint32_t> counts) {
  WhitewaterStats stats;
  if (counts.size() < kWhiteCountWords) return stats;
  const auto both = [&](uint32_t low) { return counts[low] | uint64_t{counts[low + 1]} << 32; };
  stats.spray = counts[kWhiteSprayCount + kWhiteSpray];
  stats.foam = counts[kWhiteSprayCount + kWhiteFoam];
  stats.bubbles = counts[kWhiteSprayCount + kWhiteBubble];
  stats.emitted = both(kWhiteEmitted);
  stats.dissolved = both(kWhiteDissolved);
  stats.overflow = both(kWhiteOverflow);
  stats.boundHits = counts[kWhiteBoundHits];
  return stats;
}

}  // namespace rill
