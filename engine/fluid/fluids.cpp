#include "fluid/fluids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>

#include "core/shares.hpp"
#include "core/words.hpp"
#include "fluid/numbers.hpp"
#include "fluid/settings.hpp"

namespace rill {

static_assert(kFluidLedgers == kMaxFluids);

namespace {

constexpr double kMaxDensityRatio = 1000;  // multipliers of the lightest fluid keep the precision of halves

template <class Value>
double largestOf(const Scene& scene, Value&& value) {
  double largest = 0;
  for (const ResolvedFluid& fluid : resolvedFluids(scene)) largest = std::max(largest, value(fluid));
  return largest;
}

double kinematic(const ResolvedFluid& fluid) { return largestViscosity(rheologyOf(fluid)) / fluid.density; }
double kinematicAtRest(const ResolvedFluid& fluid) { return viscosityAt(rheologyOf(fluid), 0) / fluid.density; }

constexpr std::array<float FluidParams::*, kMaxFluids> kInverseMasses{
    &FluidParams::inverseMass0, &FluidParams::inverseMass1, &FluidParams::inverseMass2, &FluidParams::inverseMass3,
    &FluidParams::inverseMass4, &FluidParams::inverseMass5, &FluidParams::inverseMass6, &FluidParams::inverseMass7};
constexpr std::array<float FluidParams::*, kMaxFluids> kViscosities{
    &FluidParams::viscosity0, &FluidParams::viscosity1, &FluidParams::viscosity2, &FluidParams::viscosity3,
    &FluidParams::viscosity4, &FluidParams::viscosity5, &FluidParams::viscosity6, &FluidParams::viscosity7};
constexpr std::array<float FluidParams::*, kMaxFluids> kTensions{&FluidParams::tension0, &FluidParams::tension1, &FluidParams::tension2,
                                                                 &FluidParams::tension3, &FluidParams::tension4, &FluidParams::tension5,
                                                                 &FluidParams::tension6, &FluidParams::tension7};
constexpr std::array<float FluidParams::*, kMaxFluids> kYields{&FluidParams::yield0, &FluidParams::yield1, &FluidParams::yield2,
                                                               &FluidParams::yield3, &FluidParams::yield4, &FluidParams::yield5,
                                                               &FluidParams::yield6, &FluidParams::yield7};
constexpr std::array<float FluidParams::*, kMaxFluids> kConsistencies{
    &FluidParams::consistency0, &FluidParams::consistency1, &FluidParams::consistency2, &FluidParams::consistency3,
    &FluidParams::consistency4, &FluidParams::consistency5, &FluidParams::consistency6, &FluidParams::consistency7};
constexpr std::array<float FluidParams::*, kMaxFluids> kThinnings{&FluidParams::thinning0, &FluidParams::thinning1, &FluidParams::thinning2,
                                                                  &FluidParams::thinning3, &FluidParams::thinning4, &FluidParams::thinning5,
                                                                  &FluidParams::thinning6, &FluidParams::thinning7};

// Two of a row a word, as unpackUnorm2x16() reads them.
void addCover(const InterfaceCover& cover, FluidParams& params) {
  constexpr size_t kWords = kMaxFluids / 2;
  std::array<uint32_t, kMaxFluids* kWords> words = {};
  for (size_t a = 0; a < kMaxFluids; ++a)
    for (size_t b = 0; b < kMaxFluids; ++b)
      words[a * kWords + b / 2] |= static_cast<uint32_t>(std::lround(cover[a][b] * 65535)) << (b % 2 * 16);
  static_assert(offsetof(FluidParams, cover7D) == offsetof(FluidParams, cover0A) + (words.size() - 1) * sizeof(uint32_t));
  std::memcpy(reinterpret_cast<std::byte*>(&params) + offsetof(FluidParams, cover0A), words.data(), sizeof words);
}

constexpr std::array<uint32_t FluidParams::*, kMaxDiffusing> kDiffusing{&FluidParams::diffusing0, &FluidParams::diffusing1,
                                                                        &FluidParams::diffusing2, &FluidParams::diffusing3};

}  // namespace

Rheology rheologyOf(const ResolvedFluid& fluid) { return {fluid.viscosity, fluid.yieldStress, fluid.flowIndex}; }

double densestFluid(const Scene& scene) {
  return largestOf(scene, [](const ResolvedFluid& fluid) { return fluid.density; });
}

double largestViscosity(const Scene& scene) {
  return largestOf(scene, [](const ResolvedFluid& fluid) { return largestViscosity(rheologyOf(fluid)); });
}

double largestKinematicViscosity(const Scene& scene) { return largestOf(scene, kinematic); }

double smallestKinematicViscosity(const Scene& scene) {
  return kinematicAtRest(std::ranges::min(resolvedFluids(scene), {}, kinematicAtRest));
}

bool hasShearViscosity(const Scene& scene) {
  return std::ranges::any_of(resolvedFluids(scene), [](const ResolvedFluid& fluid) { return isShearDependent(rheologyOf(fluid)); });
}

double leastDensityDifference(const Scene& scene) {
  std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  std::ranges::sort(fluids, {}, &ResolvedFluid::density);
  double least = 1;
  for (size_t k = 1; k < fluids.size(); ++k)
    if (fluids[k - 1].density < fluids[k].density) least = std::min(least, 1 - fluids[k - 1].density / fluids[k].density);
  return least;
}

double largestTension(const Scene& scene) {
  return largestOf(scene, [](const ResolvedFluid& fluid) { return fluid.surfaceTension; });
}

double largestKinematicTension(const Scene& scene) {
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  const InterfaceCover cover = interfaceCover(scene);
  double largest = 0;
  for (size_t k = 0; k < fluids.size(); ++k) largest = std::max(largest, kinematicTension(fluids, cover, k).value);
  return largest;
}

InterfaceCover interfaceCover(const Scene& scene) {
  InterfaceCover cover = wholeCover();
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  for (const FluidInterface& pair : scene.interfaces) {
    const size_t a = fluidIndex(scene, pair.between.first), b = fluidIndex(scene, pair.between.second);
    if (pair.tension > 0 && a < fluids.size() && b < fluids.size())
      cover[a][b] = cover[b][a] = interfaceCover(pair.tension / (fluids[a].surfaceTension + fluids[b].surfaceTension));
  }
  return cover;
}

bool hasInterfaces(const Scene& scene) {
  return std::ranges::any_of(scene.interfaces, [](const FluidInterface& pair) { return pair.tension > 0; });
}

// What a particle does to samples that it covers in part goes with the square of m_ab.
KinematicTension kinematicTension(const std::vector<ResolvedFluid>& fluids, const InterfaceCover& cover, size_t k) {
  KinematicTension fastest{k, fluids[k].surfaceTension / fluids[k].density};
  for (size_t b = 0; b < fluids.size(); ++b) {
    if (b == k || cover[k][b] == 1) continue;
    const double value = cover[k][b] * cover[k][b] * fluids[b].surfaceTension / fluids[k].density;
    if (value > fastest.value) fastest = {b, value};
  }
  return fastest;
}

double fastestViscosity(const Scene& scene) {
  const double viscosity = largestViscosity(scene);
  return viscosity > 0 ? largestKinematicViscosity(scene) * densestFluid(scene) / viscosity : 0;
}

void warnOfKeysWithoutEffect(const Scene& scene, FluidSetup& setup) {
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  size_t inherit = 0, viscous = 0;  // fluids that take fluid.flow_index, and those of them with viscosity
  for (size_t k = 0; k < fluids.size(); ++k) {
    const std::string key = scene.fluids.empty() ? "fluid" : "fluids." + fluids[k].name;
    if (scene.fluids.empty() || !scene.fluids[k].flow_index) {
      ++inherit;
      viscous += fluids[k].viscosity > 0 ? 1 : 0;
    } else if (fluids[k].flowIndex != 1 && fluids[k].viscosity == 0) {
      setup.warnings.push_back(key + ".flow_index: has no effect: its viscosity is 0, expected more (Pa s)");
    }
    if (fluids[k].diffusion > 0 && fluids.size() == 1)
      setup.warnings.push_back(key + ".diffusion: has no effect in a scene with one fluid, expected two or more in fluids");
  }
  if (scene.fluid.flow_index != 1 && inherit > 0 && viscous == 0)
    setup.warnings.push_back("fluid.flow_index: has no effect: the viscosity of every fluid that has it is 0, expected more (Pa s)");
}

Float4 unmixed(const FluidParams& params, uint8_t fluid) {
  const std::array diffusing{params.diffusing0, params.diffusing1, params.diffusing2, params.diffusing3};
  return unmixed(std::span<const uint32_t>(diffusing), fluid);
}

void addShearViscosity(const Scene& scene, FluidSetup& setup) {
  if (!hasShearViscosity(scene)) return;
  setup.shearViscosity = true;
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  const double largest = largestViscosity(scene);
  for (size_t k = 0; k < fluids.size(); ++k) {
    setup.params.*kYields[k] = f(fluids[k].yieldStress / largest);
    setup.params.*kConsistencies[k] = f(fluids[k].viscosity / largest);
    setup.params.*kThinnings[k] = f(fluids[k].flowIndex - 1);
  }
}

void addFluids(const Scene& scene, FluidSetup& setup) {
  if (scene.fluids.size() < 2) return;
  const std::vector<ResolvedFluid> fluids = resolvedFluids(scene);
  const double densest = densestFluid(scene), viscosity = largestViscosity(scene), tension = largestTension(scene);
  setup.fluids = static_cast<uint32_t>(fluids.size());
  for (size_t k = 0; k < fluids.size(); ++k) {
    const double ratio = densest / fluids[k].density;
    setup.params.*kInverseMasses[k] = f(std::min(ratio, kMaxDensityRatio));
    if (ratio > kMaxDensityRatio)
      setup.warnings.push_back("fluids." + fluids[k].name + ".density: found " + roundedNumber(fluids[k].density) + " kg/m^3, " +
                               roundedNumber(ratio) + " times less than the densest fluid; expected at most " +
                               roundedNumber(kMaxDensityRatio) + " times; it is simulated with " +
                               roundedNumber(densest / kMaxDensityRatio) + " kg/m^3");
    setup.params.*kViscosities[k] = viscosity > 0 ? f(fluids[k].viscosity / viscosity) : 0;
    setup.params.*kTensions[k] = tension > 0 ? f(fluids[k].surfaceTension / tension) : 0;
  }
  setup.interfaces = hasInterfaces(scene);
  addCover(interfaceCover(scene), setup.params);
  for (const auto index : kDiffusing) setup.params.*index = kNoFluid;
  const std::vector<size_t> diffusing = diffusingFluids(scene);
  for (size_t k = 0; k < diffusing.size(); ++k) setup.params.*kDiffusing[k] = static_cast<uint32_t>(diffusing[k]);
}

}  // namespace rill
