// What the device holds before the first step: the scene's records and the particles of its start. That of a snapshot: resume_state.cpp.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "fluid/flows.hpp"
#include "fluid/fluid_impl.hpp"
#include "fluid/fluids.hpp"
#include "fluid/sleep.hpp"

namespace rill {
namespace {

/// w of a prediction without a push by solids (shaders/fluid/fluids.glsl).
float taggedFluid(uint8_t fluid) {
  constexpr float kMinTagged = 1e-30F;
  return std::bit_cast<float>((std::bit_cast<uint32_t>(kMinTagged) & ~7u) | fluid);
}

/// The vectors as four floats each, w from `ws` or, where that is empty, `w`; then `rest` up to `entries`.
std::function<void(std::byte*)> quads(std::vector<Float3> vectors, std::vector<float> ws, float w, Float4 rest, size_t entries) {
  return [vectors = std::move(vectors), ws = std::move(ws), w, rest, entries](std::byte* to) {
    for (size_t i = 0; i < entries; ++i) {
      const float own = i < ws.size() ? ws[i] : w;
      const Float4 quad = i < vectors.size() ? Float4{vectors[i].x, vectors[i].y, vectors[i].z, own} : rest;
      std::memcpy(to + i * sizeof quad, &quad, sizeof quad);
    }
  };
}

}  // namespace

void FluidImpl::stageScene() {
  staging_.emplace();
  const auto& shapes = commands_.shapes();
  staging_->add(slotOf(FluidArray::Params), &setup.params, sizeof setup.params);
  staging_->add(slotOf(FluidArray::Shapes), shapes.size() * sizeof shapes[0], bytesOf(shapes));
  staging_->add(slotOf(FluidArray::GravityChanges), setup.gravity.data(), setup.gravity.size() * 4);
  staging_->add(slotOf(FluidArray::Table), setup.tables.data(), setup.tables.size() * 4);
  staging_->add(slotOf(FluidArray::MeshWords), setup.meshWords.data(), setup.meshWords.size() * 4);
  staging_->add(slotOf(FluidArray::ContactPoints), setup.contactPoints.data(), setup.contactPoints.size() * sizeof(ContactPointRecord));
  staging_->add(slotOf(FluidArray::MouthPoints), setup.mouthPoints.data(), setup.mouthPoints.size() * sizeof setup.mouthPoints[0]);
  staging_->add(slotOf(FluidArray::Keyframes), setup.keyframes.data(), setup.keyframes.size() * 4);
  staging_->clear(slotOf(FluidArray::NearTangential));
  staging_->clear(slotOf(FluidArray::SolidSums));
  staging_->clear(slotOf(FluidArray::Commands));
  if (setup.params.tensionRate > 0) staging_->clear(slotOf(FluidArray::SurfaceParticle));
  staging_->clear(slotOf(FluidArray::DensityCommands));
  staging_->clear(slotOf(FluidArray::ContactCommands));
  staging_->clear(slotOf(FluidArray::PointCommands));
}

void FluidImpl::stageFlows() {
  if (!setup.removes) return;
  staging_->add(slotOf(FluidArray::Flow), &ledger, sizeof ledger);
  staging_->add(slotOf(FluidArray::Emitters), setup.emitters.data(), setup.emitters.size() * sizeof(EmitterRecord));
  staging_->add(slotOf(FluidArray::Drains), setup.drains.data(), setup.drains.size() * sizeof(DrainRecord));
}

void FluidImpl::stageParticles(std::vector<Float3> positions, std::vector<Float3> velocities, std::vector<uint8_t> fluids) {
  using enum FluidArray;
  // The entries without a particle, and the dummy neighbor behind them, are inactive.
  const Float4 inactive{kInactivePosition, kInactivePosition, kInactivePosition, 0.0f};
  const size_t entries = size_t{capacity} + 1;
  // Predictions start as the positions; they and `work` end with the dummy neighbor.
  const float w = rowOf(Position).w;
  if (setup.fluids > 1) {
    fluids.resize(positions.size());
    std::vector<float> tagged;
    for (const uint8_t fluid : fluids) tagged.push_back(taggedFluid(fluid));
    staging_->add(slotOf(Prediction), buffer(Prediction).size(), quads(positions, std::move(tagged), w, inactive, entries));
  }
  std::vector<float> stored(fluids.begin(), fluids.end());
  staging_->add(slotOf(Position), buffer(Position).size(), quads(std::move(positions), std::move(stored), w, inactive, entries));
  if (setup.fluids == 1) staging_->addSame(slotOf(Prediction), slotOf(Position));
  staging_->addSame(slotOf(Work), slotOf(Position));
  staging_->add(slotOf(Velocity), buffer(Velocity).size(),
                quads(std::move(velocities), {}, rowOf(Velocity).w, Float4{0, 0, 0, 1}, entries));
}

void FluidImpl::stageConcentrations(std::vector<Float4> given, const std::vector<uint8_t>& fluids) {
  if (!(setup.params.maxDiffusionRate > 0)) return;
  given.reserve(size_t{capacity} + 1);
  for (size_t i = given.size(); i < count; ++i) given.push_back(unmixed(setup.params, i < fluids.size() ? fluids[i] : uint8_t{0}));
  given.resize(size_t{capacity} + 1);  // with the dummy neighbor
  const uint64_t bytes = given.size() * sizeof given[0];
  staging_->add(slotOf(FluidArray::Concentration), bytes, bytesOf(std::move(given)));
}

void FluidImpl::stageStart(const ParticleSet& particles, bool settle) {
  std::vector<Float3> positions = particles.positions, velocities = particles.velocities;
  std::vector<uint32_t> id(count);
  FluidSums sums{};
  float fastest = 0;
  double squares = 0, motion = 0;
  for (uint32_t i = 0; i < count; ++i) {
    Float3 &x = positions[i], &v = velocities[i];
    const float speed = speedOf(v);
    const bool good = finite(x) && std::isfinite(speed);  // a speed that overflows would make every step 0
    if (!good) {
      ++sums.nonFinite;
      x = {kInactivePosition, kInactivePosition, kInactivePosition};
      v = {};
    }
    if (good) {
      const double squared = double{speed} * speed;
      fastest = std::max(fastest, speed), squares += squared;
      motion += std::min(squared / setup.params.layerHead, double{kMaxMotion});
    }
    id[i] = i;
  }
  sums.speedMax = std::bit_cast<uint32_t>(fastest);
  const auto motionUnits = static_cast<uint64_t>(std::round(motion / kMotionUnit));
  sums.motionLow = static_cast<uint32_t>(motionUnits), sums.motionHigh = static_cast<uint32_t>(motionUnits >> 32);
  sums.bodySpeed = std::bit_cast<uint32_t>(setup.params.bodySpeed);

  FluidControl control{};
  control.count = control.solved = count;
  control.listState = kListNone;
  control.speed = fastest;
  control.flowSpeed = std::min(fastest, kFlowTimes * static_cast<float>(std::sqrt(squares / std::max(count, 1u))));
  control.nextPhase = settle ? kPhaseSettling : kPhaseAdvancing;
  control.phaseLeft = settle ? kSettleSubsteps : 0;
  control.head = static_cast<float>(setup.head);
  control.desiredStep = static_cast<float>(setup.firstStep);
  control.emissionWait = kNever;

  stageConcentrations(particles.concentrations, particles.fluids);
  stageParticles(std::move(positions), std::move(velocities), setup.fluids > 1 ? particles.fluids : std::vector<uint8_t>());
  staging_->add(slotOf(FluidArray::Control), sizeof control, bytesOf(std::vector{control}));
  staging_->add(slotOf(FluidArray::Sums), sizeof sums, bytesOf(std::vector{sums}));
  staging_->add(slotOf(FluidArray::Solids), setup.solids.data(), setup.solids.size() * sizeof(SolidRecord));
  staging_->clear(slotOf(FluidArray::SolidLoads));
  staging_->add(slotOf(FluidArray::Bodies), setup.bodies.data(), setup.bodies.size() * sizeof(BodyRecord));
  staging_->clear(slotOf(FluidArray::Slips));
  staging_->add(slotOf(FluidArray::PressureProbes), setup.pressureProbes.data(), setup.pressureProbes.size() * sizeof(PressureProbeRecord));
  staging_->add(slotOf(FluidArray::Id), id.size() * 4, bytesOf(id));
  staging_->clear(slotOf(FluidArray::Warm));
  staging_->clear(slotOf(FluidArray::WarmAcceleration));
  staging_->clear(slotOf(FluidArray::Rest));
  staging_->clear(slotOf(FluidArray::Regions));
  ledger = firstLedger(count, sums.nonFinite);
  for (uint32_t i = 0; i < count && setup.fluids > 1; ++i) {
    const uint8_t fluid = particles.fluids.empty() ? 0 : particles.fluids[i];
    ++ledger.filledOf[fluid];
    if (!finite(particles.positions[i]) || !std::isfinite(speedOf(particles.velocities[i]))) ++ledger.inactiveOf[fluid];
  }
  stageFlows();
}

}  // namespace rill
