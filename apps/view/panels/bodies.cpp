// The bodies of the scene; density, load and height of the selected one.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/vector_math.hpp"
#include "shape/mass.hpp"
#include "view/panels/board.hpp"

namespace rill::view {
namespace {

constexpr double kMinDensity = 1, kMaxDensity = 20000;  // kg/m^3, of the slider
constexpr size_t kMaxRows = 6;

std::string nameOf(const Scene& scene, uint32_t solid) {
  const std::string& name = scene.solids[solid].name;
  return name.empty() ? "solids[" + std::to_string(solid) + "]" : name;
}

void bodyRow(Board& board, const BodyMotion& body) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string label = nameOf(board.session.scene(), body.solid) + "##" + std::to_string(body.solid);
  if (ImGui::Selectable(label.c_str(), body.solid == board.settings.body, ImGuiSelectableFlags_SpanAllColumns))
    board.settings.body = body.solid;
  ImGui::TableNextColumn();
  ImGui::Text("%.3f", body.center.y);
  ImGui::TableNextColumn();
  if (body.stopped)
    ImGui::TextUnformatted("stopped");
  else
    ImGui::Text("%.2f", length(body.velocity));
}

void bodyTable(Board& board, std::span<const BodyMotion> bodies) {
  const float row = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
  const float height = row * static_cast<float>(1 + std::min(bodies.size(), kMaxRows)) + 2;
  if (!ImGui::BeginTable("bodies", 3, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp,
                         ImVec2(0, height)))
    return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("body", ImGuiTableColumnFlags_WidthStretch, 2);
  ImGui::TableSetupColumn("height, m", ImGuiTableColumnFlags_WidthStretch, 1.2f);
  ImGui::TableSetupColumn("m/s", ImGuiTableColumnFlags_WidthStretch, 0.9f);
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(bodies.size()));
  while (clipper.Step())
    for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) bodyRow(board, bodies[static_cast<size_t>(k)]);
  ImGui::EndTable();
}

/// A change is requested when the drag ends.
void densityField(Board& board, uint32_t solid) {
  const Solid& shown = board.session.scene().solids[solid];
  const std::string key = "density of solids[" + std::to_string(solid) + "]";
  double density = shown.body->mass > 0 ? shown.body->mass / massOf(shown.shape, 1).mass : shown.body->density;
  if (board.held.key == key) density = board.held.value[0];
  ImGui::SetNextItemWidth(ImGui::GetWindowContentRegionMax().x * 0.42f);
  ImGui::SliderScalar("density [kg/m^3]", ImGuiDataType_Double, &density, &kMinDensity, &kMaxDensity, "%.4g",
                      ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemDeactivatedAfterEdit()) board.requests.density = DensityChange{solid, density};
  if (ImGui::IsItemActive())
    board.held = {key, {density, 0, 0}};
  else if (board.held.key == key)
    board.held = {};
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("changes the running simulation; with Ctrl and a click you can type it");
}

/// The last value, and a plot of all between the smallest and the largest.
void bodyPlot(const char* name, const History& history, const char* format) {
  const std::vector<float>& values = history.values();
  if (values.empty()) return;
  char now[48];
  std::snprintf(now, sizeof now, format, static_cast<double>(values.back()));
  figureLine(name, "%s", now);
  const auto [low, high] = std::ranges::minmax(values);
  const float around = std::max(0.1f * (high - low), 1e-3f * std::max(std::abs(low), std::abs(high)) + 1e-6f);
  plot(name, history, low - around, high + around, 3);
}

}  // namespace

void bodyPanel(Board& board) {
  const auto bodies = board.session.runner().fluid().bodies();
  if (std::ranges::find(bodies, board.settings.body, &BodyMotion::solid) == bodies.end()) board.settings.body = bodies.front().solid;
  bodyTable(board, bodies);
  densityField(board, board.settings.body);
  const BodyHistory& history = board.histories.body;
  if (history.solid != board.settings.body) return;
  bodyPlot("vertical load", history.load_N, "%.4g N");
  bodyPlot("height", history.height_m, "%.3f m");
}

}  // namespace rill::view
