// The compiled frame for people (Graphviz) and for tools (JSON).
#include <nlohmann/json.hpp>

#include "gpu/vulkan_error.hpp"
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
  if (!resource.isImage) return "";
  return std::to_string(resource.width()) + " x " + std::to_string(resource.height()) + ", format " + std::to_string(resource.desc.format) +
         "\\n";
}

}  // namespace

/// Bytes, place and lifetime; of an import its bytes, where they are known.
std::string GraphImpl::memoryText(uint32_t index) const {
  const ResourceData& resource = resources[index];
  if (resource.imported) return resource.isImage ? "imported" : bytesText(resource.size) + ", imported";
  const uint32_t placement = memoryOf(index).placement;
  if (placement == kNone) return "no pass that runs uses it";
  const Placement& place = planOf(resource).placements[placement];
  return bytesText(place.size) + " in " + (resource.isImage ? "image heap " : "heap ") + std::to_string(place.heap) + " from " +
         bytesText(place.offset) + "\\npasses " + std::to_string(place.first) + " to " + std::to_string(place.last);
}

// Passes from the top in the order in which they run, resources beside the first pass that uses them. Blue: written; grey: read.
std::string GraphImpl::dot() const {
  std::string out =
      "digraph frame {\n"
      "  node [fontname=\"Helvetica\", fontsize=10, height=0.3, margin=\"0.08,0.04\"];\n"
      "  edge [arrowsize=0.6];\n"
      "  ranksep=0.25;\n"
      "  nodesep=0.15;\n";
  std::vector<bool> drawn(resources.size());
  for (size_t p = 0; p < passes.size(); ++p) {
    const PassData& pass = passes[p];
    const std::string node = "p" + std::to_string(p);
    out += "  " + node + " [shape=ellipse, group=passes, label=\"" + std::to_string(p) + "  " + escaped(names[pass.name]) +
           (pass.alive ? "\", style=filled, fillcolor=\"#eef4fa\"" : "\\nculled: " + escaped(pass.reason) + "\", style=dashed") + "];\n";
    if (p > 0) out += "  p" + std::to_string(p - 1) + " -> " + node + " [weight=100, style=invis];\n";
    std::string beside;
    for (uint32_t k = pass.accesses.first; k < pass.accesses.first + pass.accesses.count; ++k) {
      const Access& access = accesses[k];
      const ResourceData& resource = resources[access.resource];
      const std::string other = "r" + std::to_string(access.resource);
      if (!drawn[access.resource]) {
        drawn[access.resource] = true;
        beside += "; " + other + " [shape=" + (resource.imported ? "box3d" : "box") + ", fontsize=8, label=\"" +
                  escaped(names[resource.name]) + (resource.desc.levels > 1 ? ", level " + std::to_string(resource.level) : "") + "\\n" +
                  sizeText(resource) + memoryText(access.resource) + "\"]";
      }
      out += "  " + (access.write ? node + " -> " + other : other + " -> " + node) + " [constraint=false, color=\"" +
             (access.write ? "#2f6fab" : "#999999") + "\", tooltip=\"" + useRow(access.use).name + ", version " +
             std::to_string(access.version) + "\"" + (pass.alive ? "" : ", style=dashed") + "];\n";
    }
    if (!beside.empty()) out += "  {rank=same; " + node + beside + "}\n";
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
  out["heaps"] = Json::array();
  for (const TransientHeap& heap : heapReports)
    out["heaps"].push_back({{"kind", heap.images ? "images" : "buffers"},
                            {"transients", heap.transients},
                            {"bytes", heap.bytes},
                            {"bytes_without_aliasing", heap.separate}});
  out["skipped"] = Json::array();
  for (const Skipped& skip : skips) out["skipped"].push_back({{"name", names[skip.name]}, {"reason", skip.reason}});
  return out.dump(2);
}

std::vector<TransientReport> GraphImpl::transients() const {
  std::vector<TransientReport> all;
  for (const ResourceData& resource : resources) {
    if (resource.placement == kNone) continue;
    const Placement& place = planOf(resource).placements[resource.placement];
    all.push_back({names[resource.name], resource.isImage, place.heap, place.offset, place.size, place.first, place.last});
  }
  return all;
}

}  // namespace rill
