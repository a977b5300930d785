// Export of the compiled frame as Graphviz and as JSON.
#include "gpu/vulkan_error.hpp"
#include "graph/graph_impl.hpp"
#include "graph/json_text.hpp"

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

/// Size, placement and lifetime; for imported buffers the size only.
std::string GraphImpl::memoryLabel(uint32_t index) const {
  const ResourceData& resource = resources[index];
  if (resource.imported) return resource.isImage ? "imported" : bytesText(resource.size) + ", imported";
  const uint32_t placement = memoryOf(index).placement;
  if (placement == kNone) return "unused";
  const Placement& place = planOf(resource).placements[placement];
  return bytesText(place.size) + " in " + (resource.isImage ? "image heap " : "heap ") + std::to_string(place.heap) + " from " +
         bytesText(place.offset) + "\\npasses " + std::to_string(place.first) + " to " + std::to_string(place.last);
}

// Passes from top to bottom in execution order, resources beside the first pass that uses them. Blue edges: writes; gray: reads.
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
                  sizeText(resource) + memoryLabel(access.resource) + "\"]";
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
  JsonText out;
  const auto nameOf = [&](uint32_t resource) -> std::string_view { return names[resources[resource].name]; };
  const auto barrierTo = [&](const PlannedBarrier& barrier) {
    if (barrier.empty()) {
      out.null();
      return;
    }
    out.begin('{');
    out.key("source_stage").number(barrier.scope.sourceStage);
    out.key("source_access").number(barrier.scope.sourceAccess);
    out.key("target_stage").number(barrier.scope.targetStage);
    out.key("target_access").number(barrier.scope.targetAccess);
    out.key("because").begin('[');
    for (uint32_t i = barrier.causes.first; i < barrier.causes.first + barrier.causes.count; ++i) {
      out.begin('{').key("resource").text(nameOf(causes[i].resource));
      out.key("hazard").text(hazardName(causes[i].hazard)).key("use").text(causes[i].use).end('}');
    }
    out.end(']').key("layouts").begin('[');
    for (uint32_t i = barrier.transitions.first; i < barrier.transitions.first + barrier.transitions.count; ++i) {
      out.begin('{').key("resource").text(nameOf(transitions[i].resource));
      out.key("from").number(transitions[i].from).key("to").number(transitions[i].to).end('}');
    }
    out.end(']').end('}');
  };
  out.begin('{').key("passes").begin('[');
  for (const PassData& pass : passes) {
    out.begin('{').key("name").text(names[pass.name]).key("culled").boolean(!pass.alive);
    if (!pass.alive) out.key("reason").text(pass.reason);
    out.key("uses").begin('[');
    for (uint32_t k = pass.accesses.first; k < pass.accesses.first + pass.accesses.count; ++k) {
      const Access& access = accesses[k];
      out.begin('{').key("resource").text(nameOf(access.resource)).key("use").text(useRow(access.use).name);
      out.key("version").number(access.version).key("write").boolean(access.write).end('}');
    }
    out.end(']').key("barrier");
    barrierTo(pass.barrier);
    out.end('}');
  }
  out.end(']').key("final_barrier");
  barrierTo(finalBarrier);
  out.key("resources").begin('[');
  for (const ResourceData& resource : resources) {
    out.begin('{').key("name").text(names[resource.name]).key("bytes").number(resource.size).key("imported").boolean(resource.imported);
    if (resource.isImage) {
      out.key("image").begin('{').key("format").number(resource.desc.format);
      out.key("width").number(resource.desc.width).key("height").number(resource.desc.height).end('}');
    }
    if (resource.placement != kNone) {
      const Placement& place = planOf(resource).placements[resource.placement];
      out.key("memory").begin('{').key("heap").number(place.heap).key("offset").number(place.offset);
      out.key("first_pass").number(place.first).key("last_pass").number(place.last).end('}');
    }
    out.end('}');
  }
  out.end(']').key("heaps").begin('[');
  for (const TransientHeap& heap : heapReports) {
    out.begin('{').key("kind").text(heap.images ? "images" : "buffers").key("transients").number(heap.transients);
    out.key("bytes").number(heap.bytes).key("bytes_without_aliasing").number(heap.separate).end('}');
  }
  out.end(']').key("skipped").begin('[');
  for (const Skipped& skip : skips) out.begin('{').key("name").text(names[skip.name]).key("reason").text(skip.reason).end('}');
  out.end(']').end('}');
  return out.take();
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
