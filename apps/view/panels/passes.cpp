// Passes of the last step and the last image: time, or the reason why skipped.
#include <cfloat>

#include "view/panels/board.hpp"

namespace rill::view {
namespace {

void row(Board& board, const std::string& name, double ms, uint32_t recorded, uint32_t executed, bool isNew) {
  History& history = board.histories.passes[name];
  if (isNew) history.add(ms);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(name.c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s, recorded %u times, executed %u times", name.c_str(), recorded, executed);
  ImGui::TableNextColumn();
  ImGui::Text("%.2f", ms);
  ImGui::TableNextColumn();
  const auto& values = history.values();
  ImGui::PushID(name.c_str());
  ImGui::PlotLines("##ms", values.data(), static_cast<int>(values.size()), 0, nullptr, 0, FLT_MAX,
                   ImVec2(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize()));
  ImGui::PopID();
}

/// A line below the table: the reason is too long for a column.
void skippedLine(std::string_view name, std::string_view reason) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%.*s: %.*s", static_cast<int>(name.size()), name.data(), static_cast<int>(reason.size()), reason.data());
  ImGui::PopTextWrapPos();
}

bool beginTable(const char* name) {
  if (!ImGui::BeginTable(name, 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return false;
  ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch, 0.6f);
  ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, 3.2f * ImGui::GetFontSize());
  ImGui::TableSetupColumn("history", ImGuiTableColumnFlags_WidthStretch, 0.3f);
  ImGui::TableHeadersRow();
  return true;
}

}  // namespace

void passPanel(Board& board) {
  const Runner& runner = board.session.runner();
  const bool isNew = runner.steps() != board.histories.passesOf;
  board.histories.passesOf = runner.steps();
  ImGui::TextDisabled("simulation, last step");
  if (beginTable("simulation")) {
    for (const offline::PassTime& pass : runner.log().times()) row(board, pass.name, pass.ms, pass.recorded, pass.executed, isNew);
    ImGui::EndTable();
  }
  for (const auto& [name, reason] : runner.log().skipped()) skippedLine(name, reason);
  ImGui::TextDisabled("picture");
  if (beginTable("picture")) {
    for (const Timing& pass : board.display.pictureTimings()) row(board, std::string(pass.name), pass.ms, pass.runs, pass.runs, isNew);
    ImGui::EndTable();
  }
  for (const PassReport& pass : board.display.pictureReport())
    if (!pass.reason.empty()) skippedLine(pass.name, pass.reason);
}

}  // namespace rill::view
