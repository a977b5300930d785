// The rules of `fluid` and `fluids`, and of the keys that name a fluid.
#include <algorithm>
#include <limits>
#include <map>

#include "model/name_rules.hpp"

namespace rill::model {
namespace {

CheckResult fittingMass(double density, double spacing, std::vector<std::string> keys) {
  const double mass = density * spacing * spacing * spacing;
  if (mass >= std::numeric_limits<float>::min() && mass <= std::numeric_limits<float>::max()) return {};
  return Fault{"the mass of a particle, density x spacing^3, is " + roundedNumber(mass) + " kg; expected a mass that fits a 32-bit float",
               std::move(keys)};
}

std::vector<std::string_view> fluidNames(const Scene& scene) {
  std::vector<std::string_view> names;
  for (const FluidMaterial& fluid : scene.fluids) names.push_back(fluid.name);
  return names;
}

/// `path`: of the object whose key `fluid` has the name.
CheckResult knownFluid(const Scene& scene, const std::string& name, const std::string& path) {
  if (name.empty()) return {};
  const std::string key = memberPath(path, "fluid");
  if (scene.fluids.empty())
    return Fault{"found " + inQuotes(name) + ", but the scene has no \"fluids\"; expected a fluid of that name there, or no key", {key}};
  return knownName(name, fluidNames(scene), "fluid", "a fluid", key);
}

CheckResult fewDiffuse(const std::vector<FluidMaterial>& fluids) {
  size_t diffusing = 0;
  for (size_t i = 0; i < fluids.size(); ++i) {
    if (!(fluids[i].diffusion > 0) || ++diffusing <= kMaxDiffusing) continue;
    return Fault{"found " + roundedNumber(fluids[i].diffusion) + " m^2/s in a fifth fluid; expected a diffusion above 0 in at most " +
                     std::to_string(kMaxDiffusing),
                 {memberPath(elementPath("fluids", i), "diffusion")}};
  }
  return {};
}

CheckResult checkInterfaces(const Scene& scene) {
  if (scene.interfaces.empty()) return {};
  if (scene.fluids.empty()) return Fault{"the scene has no \"fluids\"; expected two or more there, or no interfaces", {"interfaces"}};
  const std::vector<std::string_view> names = fluidNames(scene);
  std::map<std::pair<std::string, std::string>, size_t> seen;
  for (size_t i = 0; i < scene.interfaces.size(); ++i) {
    const auto& [one, other] = scene.interfaces[i].between;
    const std::string path = memberPath(elementPath("interfaces", i), "between");
    if (CheckResult fault = knownName(one, names, "fluid", "a fluid", elementPath(path, 0))) return fault;
    if (CheckResult fault = knownName(other, names, "fluid", "a fluid", elementPath(path, 1))) return fault;
    if (one == other) return Fault{"found " + inQuotes(one) + " twice; expected two fluids", {path}};
    const auto [first, fresh] = seen.emplace(std::minmax(one, other), i);
    if (!fresh)
      return Fault{inQuotes(one) + " and " + inQuotes(other) + " are also those of " + elementPath("interfaces", first->second) +
                       "; expected each pair once",
                   {path}};
  }
  return {};
}

}  // namespace

CheckResult checkRules(const FluidSettings& fluid) {
  if (fluid.spacing <= 0) return {};
  return fittingMass(fluid.density, fluid.spacing, {"spacing", "density"});
}

CheckResult checkRules(const std::vector<FluidMaterial>& fluids) { return uniqueNames(fluids, "fluids", true); }

Fault emptyFluidName(const Scene& scene) {
  return {"found \"\"" + (scene.fluids.empty() ? ", but the scene has no \"fluids\"; expected no key"
                                               : ", expected one of " + quotedList(fluidNames(scene)) + ", or no key")};
}

CheckResult checkFluids(const Scene& scene) {
  if (CheckResult fault = fewDiffuse(scene.fluids)) return fault;
  if (CheckResult fault = checkInterfaces(scene)) return fault;
  for (size_t i = 0; scene.fluid.spacing > 0 && i < scene.fluids.size(); ++i) {
    const double density = scene.fluids[i].density.value_or(scene.fluid.density);
    const std::string path = memberPath(elementPath("fluids", i), "density");
    if (CheckResult fault = fittingMass(density, scene.fluid.spacing, {path, "fluid.spacing"})) return fault;
  }
  for (size_t i = 0; i < scene.fill.size(); ++i)
    if (CheckResult fault = knownFluid(scene, scene.fill[i].fluid, elementPath("fill", i))) return fault;
  for (size_t i = 0; i < scene.emitters.size(); ++i)
    if (CheckResult fault = knownFluid(scene, scene.emitters[i].fluid, elementPath("emitters", i))) return fault;
  if (!scene.domain || !scene.domain->inflow) return {};
  return knownFluid(scene, scene.domain->inflow->fluid, "domain.inflow");
}

}  // namespace rill::model
