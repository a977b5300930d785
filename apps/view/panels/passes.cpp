// The passes of the last step and of the last picture: time, or why there was none.
#include <cfloat>

#include "view/panels/board.hpp"

namespace rill::view {
namespace {

void row(Board& board, const std::string& name, double ms, uint32_t runs, uint32_t ran, bool fresh) {
  History& history = board.histories.passes[name];
  if (fresh) history.add(ms);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(name.c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s, recorded %u times, ran %u", name.c_str(), runs, ran);
  ImGui::TableNextColumn();
  ImGui::Text("%.2f", ms);
  ImGui::TableNextColumn();
  const auto& values = history.values();
  ImGui::PushID(name.c_str());
  ImGui::PlotLines("##ms", values.data(), static_cast<int>(values.size()), 0, nullptr, 0, FLT_MAX,
                   ImVec2(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize()));
  ImGui::PopID();
}

/// Below the table, where there is room for the reason.
void left(std::string_view name, std::string_view reason) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%.*s: %.*s", static_cast<int>(name.size()), name.data(), static_cast<int>(reason.size()), reason.data());
  ImGui::PopTextWrapPos();
}

bool beginTable(const char* name) {
  if (!ImGui::BeginTable(name, 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return false;
  ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch, 0.6f);
  ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, 3.2f * ImGui::GetFontSize());
  ImGui::TableSetupColumn("lately", ImGuiTableColumnFlags_WidthStretch, 0.3f);
  ImGui::TableHeadersRow();
  return true;
}

}  // namespace

void passPanel(Board& board) {
  const Runner& runner = board.session.runner();
  const bool fresh = runner.steps() != board.histories.passesOf;
  board.histories.passesOf = runner.steps();
  ImGui::TextDisabled("simulation, last step");
  if (beginTable("simulation")) {
    for (const offline::PassTime& pass : runner.log().times()) row(board, pass.name, pass.ms, pass.runs, pass.ran, fresh);
    ImGui::EndTable();
  }
  for (const auto& [name, reason] : runner.log().skipped()) left(name, reason);
  ImGui::TextDisabled("picture");
  if (beginTable("picture")) {
    for (const Timing& pass : board.display.pictureTimings()) row(board, std::string(pass.name), pass.ms, pass.runs, pass.runs, fresh);
    ImGui::EndTable();
  }
  for (const PassReport& pass : board.display.pictureReport())
    if (!pass.reason.empty()) left(pass.name, pass.reason);
}

}  // namespace rill::view
