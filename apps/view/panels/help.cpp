// The help overlay: mouse uses and key bindings.
#include "view/keys.hpp"
#include "view/panels/board.hpp"

namespace rill::view {
namespace {

void row(std::string_view what, std::string_view about) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what.data(), what.data() + what.size());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(about.data(), about.data() + about.size());
}

}  // namespace

void helpOverlay(Board& board) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), 0, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowFocus();  // over the panels
  ImGui::Begin(
      "Mouse and keys", &board.settings.help,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
    for (const MouseUse& use : mouseUses()) row(use.how, use.about);
    for (const KeyBinding& binding : keyBindings()) row(binding.name, binding.about);
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace rill::view
