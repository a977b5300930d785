// Device memory by purpose, with a list of buffers for each.
#include <algorithm>
#include <tuple>

#include "view/panels/board.hpp"

namespace rill::view {
namespace {

double mebibytes(uint64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }
double kibibytes(uint64_t bytes) { return static_cast<double>(bytes) / (1 << 10); }

/// A tree node with a size; true where it is open.
bool line(const char* name, uint64_t bytes) {
  const bool open = ImGui::TreeNodeEx(name, ImGuiTreeNodeFlags_SpanAvailWidth);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.66f);
  ImGui::Text("%.1f MiB", mebibytes(bytes));
  return open;
}

/// `places`: with a column for offsets.
bool beginTable(const char* name, bool places) {
  if (!ImGui::BeginTable(name, places ? 3 : 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return false;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("KiB", ImGuiTableColumnFlags_WidthFixed, 3.6f * ImGui::GetFontSize());
  if (places) ImGui::TableSetupColumn("at KiB", ImGuiTableColumnFlags_WidthFixed, 4.6f * ImGui::GetFontSize());
  ImGui::TableHeadersRow();
  return true;
}

void row(std::string_view name, uint64_t bytes) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(name.data(), name.data() + name.size());
  ImGui::TableNextColumn();
  ImGui::Text("%.1f", kibibytes(bytes));
}

void fluid(const Runner& runner) {
  if (line("fluid", runner.fluid().memory().total())) {
    if (beginTable("fluid's", false)) {
      std::vector<FluidBuffer> all(runner.fluid().buffers().begin(), runner.fluid().buffers().end());
      std::ranges::stable_sort(all, std::ranges::greater{}, &FluidBuffer::bytes);
      for (const FluidBuffer& buffer : all) row(buffer.name, buffer.bytes);
      ImGui::EndTable();
    }
    ImGui::TreePop();
  }
}

/// Transient resources, sorted by offset, so that aliased ones are adjacent; those of repeated passes have one line.
void transients(const char* name, const Graph& graph) {
  uint64_t separate = 0;
  for (const TransientHeap& heap : graph.transientHeaps()) separate += heap.separate;
  const bool open = line(name, graph.transientBytes());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("with aliasing; without it %.1f MiB", mebibytes(separate));
  if (!open) return;
  std::vector<TransientReport> all = graph.transients();
  const auto place = [](const TransientReport& r) { return std::tuple(r.image, r.heap, r.offset, r.name); };
  std::ranges::stable_sort(all, {}, place);
  if (beginTable(name, true)) {
    for (size_t k = 0; k < all.size(); ++k) {
      if (k > 0 && place(all[k]) == place(all[k - 1])) continue;
      row(all[k].name, all[k].bytes);
      ImGui::TableNextColumn();
      ImGui::Text("%s%u: %.0f", all[k].image ? "i" : "b", all[k].heap, kibibytes(all[k].offset));
      if (ImGui::IsItemHovered())
        ImGui::SetTooltip("in heap %u of %s, from %.1f KiB on; passes %u to %u", all[k].heap, all[k].image ? "images" : "buffers",
                          kibibytes(all[k].offset), all[k].first, all[k].last);
    }
    ImGui::EndTable();
  }
  ImGui::TreePop();
}

}  // namespace

void memoryPanel(Board& board) {
  const Runner& runner = board.session.runner();
  fluid(runner);
  transients("step's passes", runner.stepGraph());
  transients("picture's passes", board.display.pictureGraph());
  transients("window's passes", board.display.windowGraph());
  if (line("shown picture", board.display.pictureBytes())) ImGui::TreePop();
}

}  // namespace rill::view
