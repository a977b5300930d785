// Selection of scene and view, and playback.
#include <cstdio>

#include "rill/offline.hpp"
#include "view/panels/board.hpp"

namespace rill::view {
namespace {

template <class Names>
std::string combo(const char* label, const std::string& chosen, const Names& names) {
  std::string picked;
  ImGui::SetNextItemWidth(-80 * ImGui::GetFontSize() / 15);
  if (!ImGui::BeginCombo(label, chosen.c_str())) return picked;
  for (const auto& name : names)
    if (ImGui::Selectable(std::string(name).c_str(), std::string(name) == chosen)) picked = name;
  ImGui::EndCombo();
  return picked;
}

/// Continues the line if a button with this text fits.
void sameLineIfFits(const char* button) {
  const float right = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + ImGui::CalcTextSize(button).x;
  if (right + 2 * ImGui::GetStyle().FramePadding.x < ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) ImGui::SameLine();
}

void exposureSlider(double& stops) {
  constexpr double kLeast = -offline::kMaxExposure_stops, kMost = offline::kMaxExposure_stops;
  ImGui::SetNextItemWidth(-80 * ImGui::GetFontSize() / 15);
  ImGui::SliderScalar("exposure", ImGuiDataType_Double, &stops, &kLeast, &kMost, "%+.1f stops", ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("each stop is twice the light; double click to reset");
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) stops = 0;
}

}  // namespace

void scenePanel(Board& board) {
  Requests& requests = board.requests;
  if (const std::string picked = combo("scene", board.scene, board.scenes); !picked.empty()) requests.open = picked;
  if (const std::string picked = combo("view", board.settings.view, offline::Simulation::views()); !picked.empty())
    board.settings.view = picked;

  if (ImGui::Button(board.settings.paused ? "Continue (P)" : "Pause (P)")) board.settings.paused = !board.settings.paused;
  ImGui::SameLine();
  if (ImGui::Button("Step (O)")) requests.oneStep = true;
  sameLineIfFits("Restart (R)");
  if (ImGui::Button("Restart (R)")) requests.restart = true;
  if (ImGui::Button("Save scene")) requests.save = true;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("saves the scene with its changes to a .json file in the current folder");
  ImGui::SameLine();
  if (ImGui::Button(board.interface.theme() == Theme::Dark ? "Light" : "Dark"))
    board.interface.setTheme(board.interface.theme() == Theme::Dark ? Theme::Light : Theme::Dark);
  sameLineIfFits("Help (F1)");
  if (ImGui::Button("Help (F1)")) board.settings.help = true;

  constexpr struct {
    const char* name;
    double scale;
  } kScales[] = {{"automatic", 0}, {"100 %", 1}, {"75 %", 0.75}, {"50 %", 0.5}};
  const char* now = kScales[0].name;
  for (const auto& row : kScales)
    if (row.scale == board.settings.scale) now = row.name;
  ImGui::SetNextItemWidth(-80 * ImGui::GetFontSize() / 15);
  if (ImGui::BeginCombo("resolution", now)) {
    for (const auto& row : kScales)
      if (ImGui::Selectable(row.name, row.scale == board.settings.scale)) board.settings.scale = row.scale;
    ImGui::EndCombo();
  }
  ImGui::SetNextItemWidth(-80 * ImGui::GetFontSize() / 15);
  if (ImGui::BeginCombo("present", std::string(presentModeName(board.display.mode())).c_str())) {
    for (const VkPresentModeKHR mode : board.display.modes())
      if (ImGui::Selectable(std::string(presentModeName(mode)).c_str(), mode == board.display.mode())) requests.mode = mode;
    ImGui::EndCombo();
  }
  if (board.devices.size() > 1) {
    ImGui::SetNextItemWidth(-80 * ImGui::GetFontSize() / 15);
    if (ImGui::BeginCombo("device", board.device.c_str())) {
      for (const offline::ListedDevice& device : board.devices) {
        const std::string name = device.name + ", " + device.driver + "##" + std::to_string(device.index);
        const auto flags = device.unusable.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
        if (ImGui::Selectable(name.c_str(), device.name + ", " + device.driver == board.device, flags)) requests.device = device.index;
        if (!device.unusable.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
          ImGui::SetTooltip("%s", device.unusable.c_str());
      }
      ImGui::EndCombo();
    }
  }
  ImGui::BeginDisabled(board.settings.view != "final");
  exposureSlider(board.settings.exposure_stops);
  ImGui::EndDisabled();
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", board.device.c_str());
  if (!board.session.scene().about.empty()) ImGui::TextDisabled("%s", board.session.scene().about.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace rill::view
