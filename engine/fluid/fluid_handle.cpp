// The public Fluid: a handle that passes every call on to FluidImpl.
#include <algorithm>
#include <limits>
#include <optional>

#include "core/vector_math.hpp"
#include "fluid/fluid_impl.hpp"
#include "shape/records.hpp"

namespace rill {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const DrivenSolid* drivenSolid(const FluidSetup& setup, uint32_t solid) {
  const auto found = std::ranges::find(setup.driven, solid, &DrivenSolid::solid);
  return found == setup.driven.end() ? nullptr : &*found;
}

}  // namespace

Fluid::Fluid(std::unique_ptr<FluidImpl> impl) : impl_(std::move(impl)) {}
Fluid::~Fluid() = default;
Fluid::Fluid(Fluid&&) noexcept = default;
Fluid& Fluid::operator=(Fluid&&) noexcept = default;

Expected<Fluid> Fluid::create(Device& device, const FluidDesc& desc) {
  auto impl = FluidImpl::create(device, desc);
  if (!impl) return impl.error();
  return Fluid(std::move(*impl));
}

FluidState Fluid::addTo(Graph& graph, const FluidStep& step) { return impl_->addTo(graph, step); }

FluidState Fluid::present(Graph& graph) const { return impl_->present(graph); }

std::optional<FluidStats> Fluid::stats() const {
  impl_->poll();
  return impl_->stats;
}

const FluidProgress& Fluid::progress() const {
  impl_->poll();
  return impl_->progress;
}

std::vector<FluidPassRuns> Fluid::passRuns() const {
  impl_->poll();
  return impl_->passRuns();
}

std::span<const PressureReading> Fluid::pressures() const {
  impl_->poll();
  return impl_->pressures;
}

std::span<const FlowReading> Fluid::emitted() const {
  impl_->poll();
  return impl_->emitted;
}

std::span<const FlowReading> Fluid::drained() const {
  impl_->poll();
  return impl_->drained;
}

std::span<const SolidLoad> Fluid::solidLoads() const {
  impl_->poll();
  return impl_->solidLoads;
}

std::span<const BodyMotion> Fluid::bodies() const {
  impl_->poll();
  return impl_->bodyMotions;
}

Double3 Fluid::drivenCenter(uint32_t solid) const {
  const DrivenSolid* driven = drivenSolid(impl_->setup, solid);
  if (!driven) return {kNaN, kNaN, kNaN};
  return along(impl_->origin, 1, centerOf(driven->pose));
}

Quaternion Fluid::drivenRotation(uint32_t solid) const {
  const DrivenSolid* driven = drivenSolid(impl_->setup, solid);
  return driven ? rotationOf(driven->pose) : Quaternion{kNaN, kNaN, kNaN, kNaN};
}

uint32_t Fluid::count() const {
  impl_->poll();
  return impl_->count;
}
uint32_t Fluid::capacity() const { return impl_->capacity; }
uint32_t Fluid::substepsPerBlock() const { return impl_->setup.substepsPerBlock; }
uint32_t Fluid::substepsToComplete() const {
  return substepsPerBlock() * (impl_->setup.params.maxSubsteps + kSettleSubsteps + impl_->setup.params.initialPressureIterations);
}
FluidMemory Fluid::memory() const { return impl_->memory; }
std::span<const FluidBuffer> Fluid::buffers() const { return impl_->made; }
std::span<const std::string> Fluid::warnings() const { return impl_->setup.warnings; }

}  // namespace rill
