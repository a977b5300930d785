// The pipelines of a fluid's passes, with the specialization constants of shaders/fluid/constants.glsl, and their dispatch commands.
#include <algorithm>

#include "fluid/fluid_impl.hpp"
#include "fluid/near_solids.hpp"
#include "gpu/device_impl.hpp"

namespace rill {
namespace {

constexpr uint32_t kFewSolids = 16;  // tested one by one; of more, a workgroup finds those near it first

ClusterChoice clusterOf(const Device& device) {
  const DeviceImpl& impl = implOf(device);
  return chooseCluster(impl.info, impl.canSetSubgroupSize, impl.vendor, kFluidGroup);
}

/// `power`, 1 to 16, if it is whole; else 0, for which shaders compute any power.
uint32_t wholePower(float power) {
  const auto whole = static_cast<uint32_t>(power);
  return static_cast<float>(whole) == power ? whole : 0;
}

/// What the dispatch commands of a pass are in: a buffer of their own for each shader that writes such, or that of all others.
FluidArray argumentsOf(const FluidPassRow& row, const FluidSetup& setup) {
  switch (row.extent) {
    case Extent::Contacts:
    case Extent::ContactBodies:
      return FluidArray::ContactCommands;
    case Extent::ContactPoints:
      return FluidArray::PointCommands;
    default:
      return runsControl(row.id, setup) ? FluidArray::DensityCommands : FluidArray::Commands;
  }
}

}  // namespace

Expected<void> FluidImpl::checkClusters(const Device& device) {
  if (const DeviceInfo& info = device.info(); clusterOf(device).cluster == 0)
    return Error{ErrorKind::NoDevice, "device '" + info.name + "' cannot run a fluid: its subgroups are of up to " +
                                          std::to_string(info.maxSubgroupSize) + " invocations, which do not divide workgroups of " +
                                          std::to_string(kFluidGroup) + ", and no size can be required in compute shaders"};
  return {};
}

std::vector<NamedConstant> FluidImpl::constants(Device& device) const {
  const FluidParams& p = setup.params;
  return {{"KERNEL", setup.kernel},
          {"CLUSTER", clusterOf(device).cluster},
          {"LIST_CAPACITY", p.listCapacity},
          {"WALLS", setup.walls},
          {"WARM", setup.warm},
          {"MULTIPLIERS", keepsMultipliers(setup)},
          {"SOLIDS", p.solidCount > 0},
          {"MESHES", !setup.meshWords.empty()},
          {"CULL_SOLIDS", p.solidCount > kFewSolids},
          {"NEAR_QUADS", nearSolidQuads(p.solidCount)},
          {"LOADS", setup.loads},
          {"BODIES", !setup.bodies.empty()},
          {"FIRM_SOLIDS", setup.solids.size() > setup.bodies.size()},
          {"SHEAR_VISCOSITY", setup.shearViscosity},
          {"NO_SLIP_WALLS", setup.noSlipWalls},
          {"NO_SLIP_SOLIDS", setup.noSlipSolids},
          {"REMOVES", setup.removes},
          {"OUTFLOW", setup.params.outflowLevel < kNoWall},
          {"MOUTHS", !setup.emitters.empty()},
          {"MOUTHS_MOVE", std::ranges::any_of(setup.emitters, [](const EmitterRecord& e) { return e.keyCount > 0; })},
          {"FORCES", hasForces(setup)},
          {"TENSION", p.tensionRate > 0},
          {"REGIONS", p.regionsX != 0},
          {"FLUIDS", setup.fluids > 1},
          {"INTERFACES", setup.interfaces},
          {"DIFFUSES", p.maxDiffusionRate > 0},
          {"ARTIFICIAL_PRESSURE", p.tensileRate > 0},
          {"TENSILE_POWER", wholePower(p.tensilePower)},
          {"THIN", setup.thin},
          {"LIST_OVERSIZED", sort_->listsOversized()},
          // Where a pass or a variant of it does not say otherwise:
          {"WALKS", false},
          {"NEAR_SOLIDS", false},
          {"REBUILDS", false}};
}

Expected<void> FluidImpl::preparePasses(Device& device) {
  for (const FluidPassRow& row : fluidPassTable()) {
    if (!exists(row.id, setup)) continue;
    if (auto ok = preparePass(device, row); !ok) return ok;
  }
  sortCommand_ = commands_.count();
  for (const uint32_t start : {kStartRebuild, kStartFigures})
    for (const GatedDispatch& d : sort_->dispatches())
      if (d.keysPerGroup > 0)
        commands_.add(start, kOverParticles, {d.keysPerGroup, 0, 1});
      else
        commands_.add(start, kOverShape, d.groups);
  if (commands_.count() > kMaxCommands)
    return Error{ErrorKind::Failed, "the passes of the fluid have " + std::to_string(commands_.count()) +
                                        " dispatch commands; expected at most " + std::to_string(kMaxCommands) + " (kMaxCommands)"};
  setup.params.commandCount = commands_.count();
  return {};
}

Expected<void> FluidImpl::preparePass(Device& device, const FluidPassRow& row) {
  PreparedPass& prepared = passes_[static_cast<size_t>(row.id)];
  const std::vector<NamedConstant> shared = constants(device);
  const bool counted = sort_->method() == SortMethod::Counting;
  std::string shader(row.shader);
  if (row.extent == Extent::Keys && counted) shader += "_counted";
  prepared.arguments = argumentsOf(row, setup);
  shader = shaderVariant(device, shader, "_merged", setup.mergesPasses);
  shader = texelVariant(device, shader, texel_);
  const ClusterChoice choice = clusterOf(device);

  const auto add = [&](uint32_t over, std::initializer_list<NamedConstant> own, SubgroupNeed subgroups = {}) -> Expected<void> {
    std::vector<NamedConstant> values(own);
    if (!row.options.constant.name.empty()) values.push_back(row.options.constant);
    values.insert(values.end(), shared.begin(), shared.end());  // the first value of a name counts
    auto pipeline = shaderPipeline(device, shader, values, subgroups);
    if (!pipeline) return pipeline.error();
    PreparedPass::Variant variant{*pipeline, over};
    for (const ShaderBinding& binding : (*pipeline)->bindings) {
      variant.arrays.push_back(arrayNamed(binding.name));
      if (variant.arrays.back() == FluidArray::kCount)
        return Error{ErrorKind::Shader, "shader '" + shader + "': no array of a fluid is named '" + std::string(binding.name) + "'"};
    }
    prepared.variants.push_back(std::move(variant));
    std::array<uint32_t, kStarts>& commands = prepared.commands.emplace_back();
    commands.fill(kNoCommand);
    for (Start start : row.starts) {
      if (start == Start::Always) continue;
      const GroupCount groups = over == kOverShape ? foldGroups(fixedGroups(row.extent)) : GroupCount{kFluidGroup, 0, 1};
      const auto share = [&](Start when) {
        const auto k = static_cast<uint32_t>(when);
        const bool second = over == kOverGrid || row.extent == Extent::ContactBodies;  // of two commands in a buffer of their own
        commands[k] = prepared.arguments == FluidArray::Commands ? commands_.shared(k, over, groups) : uint32_t{second};
      };
      share(start);
      if (start == Start::Correct) share(Start::CorrectOdd);
    }
    return {};
  };
  switch (row.extent) {
    case Extent::Gather:
      if (setup.params.listCapacity > 0)
        if (auto ok = add(kOverLists, {}, withoutCluster(device.info(), choice, kFluidGroup)); !ok) return ok;
      return add(kOverGrid, {{"WALKS", true}}, choice.need);
    case Extent::NearGather:
      // On GPUs, which merge passes, a dispatch more costs more than code that is not entered.
      if (setup.mergesPasses) return add(kOverNearSolids, {{"WALKS", true}}, choice.need);
      if (setup.params.listCapacity > 0)
        if (auto ok = add(kOverNearLists, {}, withoutCluster(device.info(), choice, kFluidGroup)); !ok) return ok;
      return add(kOverNearGrid, {{"WALKS", true}}, choice.need);
    case Extent::NearSolids:
      return add(kOverNearSolids, {{"NEAR_SOLIDS", true}}, row.options.clusters ? choice.need : SubgroupNeed{});
    case Extent::InReach:
      return add(kOverInReach, {{"NEAR_SOLIDS", true}});
    case Extent::NearMouths:
      return add(kOverNearMouths, {});
    case Extent::Chunks:
      return add(kOverChunk, {}, choice.need);
    case Extent::Particles:
      return add(kOverParticles, {}, row.options.clusters ? choice.need : SubgroupNeed{});
    case Extent::Keys:
      return add(counted ? kOverParticles : kOverShape, {});
    default:
      return add(kOverShape, {});
  }
}

}  // namespace rill
