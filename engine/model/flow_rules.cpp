// The rules of emitters and drains.
#include <algorithm>
#include <unordered_map>

#include "core/mesh_plane.hpp"
#include "core/vector_math.hpp"
#include "core/words.hpp"
#include "model/rules.hpp"

namespace rill::model {
namespace {

/// Of numbers that fit a float, the length and products of such lengths fit a double.
CheckResult hasDirection(const Double3& v, std::string_view key) {
  if (length(v) > 0) return {};
  return Fault{"found a vector of zero length, expected a direction", {std::string(key)}};
}

template <class Timed>
CheckResult endsAfterStart(const Timed& flow) {
  if (!flow.until || *flow.until > flow.from) return {};
  return Fault{"found " + shortestNumber(*flow.until) + " s, expected a time later than from, " + shortestNumber(flow.from) + " s",
               {"until", "from"}};
}

}  // namespace

CheckResult checkSides(const Domain& domain) {
  const auto check = [&](const auto& flow, std::string_view key) -> CheckResult {
    const double height = domain.max.y - domain.min.y;
    const std::string side = memberPath(key, "side"), level = memberPath(key, "level");
    if (flow.side == Axis::PlusY || flow.side == Axis::MinusY)
      return Fault{"found a side across y, expected one of \"-x\", \"+x\", \"-z\", \"+z\"", {side}};
    if ((domain.open >> sideBit(flow.side) & 1U) != 0) return Fault{"found an open side, expected a closed one", {side, "open"}};
    if (flow.level < height) return {};
    return Fault{"found " + shortestNumber(flow.level) + ", expected a level below the domain's height, " + shortestNumber(height) + " (m)",
                 {level}};
  };
  if (domain.inflow)
    if (CheckResult fault = check(*domain.inflow, "inflow")) return fault;
  if (domain.outflow)
    if (CheckResult fault = check(*domain.outflow, "outflow")) return fault;
  if (domain.inflow && domain.outflow && domain.inflow->side == domain.outflow->side)
    return Fault{"found the side of the inflow, expected another one", {"outflow.side", "inflow.side"}};
  return {};
}

CheckResult checkRules(const DiscMouth& mouth) { return hasDirection(mouth.normal, "normal"); }

CheckResult checkRules(const RectMouth& mouth) {
  if (CheckResult fault = hasDirection(mouth.normal, "normal")) return fault;
  if (CheckResult fault = hasDirection(mouth.up, "up")) return fault;
  constexpr double kParallel = 1e-6;  // sine of the angle; less is lost in 32-bit floats
  if (length(cross(mouth.normal, mouth.up)) > kParallel * length(mouth.normal) * length(mouth.up)) return {};
  return Fault{"found " + roundedPlace(mouth.up) + ", which is parallel to the normal; expected another direction", {"up", "normal"}};
}

CheckResult checkRules(const MeshMouth& mouth) {
  if (CheckResult fault = unitQuaternion(mouth.rotation, "rotation")) return fault;
  if (!mouth.mesh) return Fault{"found no mesh; expected one of Mesh::create(), or a file that loadScene() reads", {"mesh"}};
  const auto bad = [&](const std::string& text) {
    return mouth.file.empty() ? Fault{text, {"mesh"}} : Fault{mouth.file.string() + ": " + text, {"file"}};
  };
  if (!mouth.mesh->twoSided()) return bad("found a mesh with an inside; expected one that was created two-sided");
  constexpr double kFlat = 1e-3, kRounding = 1e-6;  // of its size, and of its area
  const MeshPlane plane = planeOf(mouth.mesh->data());
  if (!(plane.total > 0)) return bad("the triangles have no area; expected a mouth with one");
  if (!(length(plane.normal) > 0)) return bad("the triangles face in opposite directions; expected all to face where the fluid goes");
  if (plane.offPlane > kFlat * plane.size)
    return bad("the mesh is not flat: its vertex at " + roundedPlace(plane.farthest) + " is " + roundedNumber(plane.offPlane) +
               " m off the plane of the triangles; expected at most " + roundedNumber(kFlat * plane.size) + " m, a thousandth of its size");
  if (plane.against > kRounding * plane.area)
    return bad("triangles of " + roundedNumber(plane.against) + " m^2 face against the others, the first at " +
               roundedPlace(plane.firstAgainst) + "; expected all to face where the fluid goes");
  return {};
}

CheckResult checkRules(const Emitter& emitter) { return endsAfterStart(emitter); }
CheckResult checkRules(const Drain& drain) { return endsAfterStart(drain); }

CheckResult collectFlowNames(const Scene& scene, std::vector<std::string_view>& names) {
  std::unordered_map<std::string_view, std::string> seen;
  const auto collect = [&](const auto& entries, std::string_view list) -> CheckResult {
    for (size_t i = 0; i < entries.size(); ++i) {
      const std::string& name = entries[i].name;
      if (name.empty()) continue;
      const std::string path = elementPath(list, i);
      const auto [first, fresh] = seen.emplace(name, path);
      if (!fresh)
        return Fault{inQuotes(name) + " is also the name of " + first->second + "; expected unique names among emitters and drains",
                     {memberPath(path, "name")}};
      names.push_back(name);
    }
    return {};
  };
  if (scene.domain && scene.domain->inflow) {
    seen.emplace("inflow", "domain.inflow");
    names.push_back("inflow");
  }
  if (CheckResult fault = collect(scene.emitters, "emitters")) return fault;
  return collect(scene.drains, "drains");
}

}  // namespace rill::model
