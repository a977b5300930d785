// Emitters with their flow, drains, where the particles went, and flows over time.
#include <algorithm>
#include <cmath>

#include "core/words.hpp"
#include "fill/mouth.hpp"
#include "view/panels/board.hpp"
#include "view/tap.hpp"

namespace rill::view {
namespace {

constexpr size_t kMaxFlowRows = 6;
constexpr double kMaxFlowFactor = 4;  // of a slider, over the flow in the scene
constexpr double kLiters = 1000;      // in m^3

std::string nameOr(const std::string& name, const char* list, size_t index) {
  return name.empty() ? std::string(list) + "[" + std::to_string(index) + "]" : name;
}

void volumeCell(double volume) {
  ImGui::TableNextColumn();
  ImGui::Text("%.4g", kLiters * volume);
}

/// The tap's slider sets what it pours while its key is held.
void emitterRow(Board& board, uint32_t emitter, const FlowReading& reading) {
  const Runner& runner = board.session.runner();
  const Emitter& shown = board.session.scene().emitters[emitter];
  const bool tap = runner.tap() == emitter;
  const double whole = flowOf(shown), set = board.settings.tapFlow > 0 ? board.settings.tapFlow : whole;
  double flow = kLiters * (tap ? set : runner.flows()[emitter]);
  const double low = 0, high = kLiters * kMaxFlowFactor * whole;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(tap ? "tap (key T)" : nameOr(shown.name, "emitters", emitter).c_str());
  ImGui::TableNextColumn();
  ImGui::PushID(static_cast<int>(emitter));
  ImGui::SetNextItemWidth(-1);
  const bool changed = ImGui::SliderScalar("##flow", ImGuiDataType_Double, &flow, &low, &high, "%.3g", ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip(tap ? "of the next time" : "changes the running simulation, until it is restarted");
  ImGui::PopID();
  if (changed && tap)
    board.settings.tapFlow = flow / kLiters;
  else if (changed)
    board.requests.emitter = EmitterTarget{.emitter = emitter, .flow = flow / kLiters};
  volumeCell(reading.volume);
}

void drainRow(const Board& board, size_t drain, const FlowReading& reading) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(nameOr(board.session.scene().drains[drain].name, "drains", drain).c_str());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("drain");
  volumeCell(reading.volume);
}

void flowTable(Board& board) {
  const auto emitted = board.session.runner().fluid().emitted(), drained = board.session.runner().fluid().drained();
  const size_t rows = emitted.size() + drained.size();
  if (rows == 0) return;
  const float row = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().CellPadding.y;
  const float height = row * static_cast<float>(1 + std::min(rows, kMaxFlowRows)) + 2;
  if (!ImGui::BeginTable("flows", 3, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp,
                         ImVec2(0, height)))
    return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 1.2f);
  ImGui::TableSetupColumn("flow, L/s", ImGuiTableColumnFlags_WidthStretch, 1.3f);
  ImGui::TableSetupColumn("volume, L", ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableHeadersRow();
  for (uint32_t k = 0; k < emitted.size(); ++k) emitterRow(board, k, emitted[k]);
  for (size_t k = 0; k < drained.size(); ++k) drainRow(board, k, drained[k]);
  ImGui::EndTable();
}

void ledgerLines(const FluidStats& stats, uint32_t capacity) {
  const FluidLedger& ledger = stats.ledger;
  const uint64_t present = ledger.filled + ledger.emitted - ledger.drained - ledger.left - ledger.inactive;
  figureLine("filled + emitted", "%s + %s", grouped(ledger.filled).c_str(), grouped(ledger.emitted).c_str());
  figureLine("present of capacity", "%s of %s", grouped(present).c_str(), grouped(capacity).c_str());
  figureLine("drained; left", "%s; %s", grouped(ledger.drained).c_str(), grouped(ledger.left).c_str());
  figureLine("inactive", "%s", grouped(ledger.inactive).c_str());
  figureLine("blocked", "%.2f s", stats.emitterBlocked_s);
  if (present >= capacity) ImGui::TextUnformatted("full: emitters wait for particles to leave");
}

void flowPlot(const char* name, const History& history) {
  const std::vector<float>& values = history.values();
  if (values.empty()) return;
  figureLine(name, "%.3g L/s", static_cast<double>(values.back()));
  const float top = *std::ranges::max_element(values);
  plot(name, history, 0, top > 0 ? 1.1f * top : 1, 2);
}

}  // namespace

void flowPanel(Board& board) {
  flowTable(board);
  if (board.stats) ledgerLines(*board.stats, board.session.runner().fluid().capacity());
  if (!board.histories.flows) return;
  flowPlot("flow in", board.histories.flows->in_L_s);
  flowPlot("flow out", board.histories.flows->out_L_s);
}

}  // namespace rill::view
