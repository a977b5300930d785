// The compiled frame for people (Graphviz) and for tools (JSON).
#include <nlohmann/json.hpp>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string sizeText(const ResourceData& resource) {
  if (!resource.isImage) return std::to_string(resource.size) + " bytes";
  return std::to_string(resource.desc.width) + " x " + std::to_string(resource.desc.height) + " of format " +
         std::to_string(resource.desc.format);
}

}  // namespace

std::string GraphImpl::dot() const {
  std::string out = "digraph frame {\n  rankdir=LR;\n  node [fontname=\"Helvetica\", fontsize=10];\n";
  for (size_t r = 0; r < resources.size(); ++r)
    out += "  r" + std::to_string(r) + " [shape=" + (resources[r].imported ? "box3d" : "box") + ", label=\"" +
           escaped(names[resources[r].name]) + "\\n" + sizeText(resources[r]) + "\"];\n";
  for (size_t p = 0; p < passes.size(); ++p) {
    const PassData& pass = passes[p];
    const std::string node = "  p" + std::to_string(p);
    out += node + " [shape=ellipse, label=\"" + escaped(names[pass.name]) +
           (pass.alive ? "\"" : "\\nculled: " + escaped(pass.reason) + "\", style=dashed") + "];\n";
    for (uint32_t k = pass.accesses.first; k < pass.accesses.first + pass.accesses.count; ++k) {
      const Access& access = accesses[k];
      const std::string resource = "  r" + std::to_string(access.resource);
      const std::string label = std::string(" [label=\"") + useRow(access.use).name + " v" + std::to_string(access.version) + "\"" +
                                (pass.alive ? "" : ", style=dashed") + "];\n";
      out += (access.write ? node + " ->" + resource : resource + " ->" + node) + label;
    }
  }
  return out + "}\n";
}

std::string GraphImpl::json() const {
  using Json = nlohmann::ordered_json;
  const auto barrierJson = [&](const PlannedBarrier& barrier) -> Json {
    if (barrier.empty()) return nullptr;
    Json why = Json::array();
    for (uint32_t i = barrier.causes.first; i < barrier.causes.first + barrier.causes.count; ++i)
      why.push_back({{"resource", names[resources[causes[i].resource].name]},
                     {"hazard", hazardName(causes[i].hazard)},
                     {"use", useRow(causes[i].use).name}});
    Json layouts = Json::array();
    for (uint32_t i = barrier.transitions.first; i < barrier.transitions.first + barrier.transitions.count; ++i)
      layouts.push_back(
          {{"resource", names[resources[transitions[i].resource].name]}, {"from", transitions[i].from}, {"to", transitions[i].to}});
    return {{"source_stage", barrier.scope.sourceStage},
            {"source_access", barrier.scope.sourceAccess},
            {"target_stage", barrier.scope.targetStage},
            {"target_access", barrier.scope.targetAccess},
            {"because", std::move(why)},
            {"layouts", std::move(layouts)}};
  };
  Json out;
  out["passes"] = Json::array();
  for (const PassData& pass : passes) {
    Json entry{{"name", names[pass.name]}, {"culled", !pass.alive}};
    if (!pass.alive) entry["reason"] = pass.reason;
    Json uses = Json::array();
    for (uint32_t k = pass.accesses.first; k < pass.accesses.first + pass.accesses.count; ++k)
      uses.push_back({{"resource", names[resources[accesses[k].resource].name]},
                      {"use", useRow(accesses[k].use).name},
                      {"version", accesses[k].version},
                      {"write", accesses[k].write}});
    entry["uses"] = std::move(uses);
    entry["barrier"] = barrierJson(pass.barrier);
    out["passes"].push_back(std::move(entry));
  }
  out["final_barrier"] = barrierJson(finalBarrier);
  out["resources"] = Json::array();
  for (const ResourceData& resource : resources) {
    Json entry{{"name", names[resource.name]}, {"bytes", resource.size}, {"imported", resource.imported}};
    if (resource.isImage)
      entry["image"] = {{"format", resource.desc.format}, {"width", resource.desc.width}, {"height", resource.desc.height}};
    if (resource.placement != kNone) {
      const Placement& place = planOf(resource).placements[resource.placement];
      entry["memory"] = {{"heap", place.heap}, {"offset", place.offset}, {"first_pass", place.first}, {"last_pass", place.last}};
    }
    out["resources"].push_back(std::move(entry));
  }
  out["heaps"] = plans[0].heapSizes;
  out["image_heaps"] = plans[1].heapSizes;
  out["skipped"] = Json::array();
  for (const Skipped& skip : skips) out["skipped"].push_back({{"name", names[skip.name]}, {"reason", skip.reason}});
  return out.dump(2);
}

}  // namespace rill
