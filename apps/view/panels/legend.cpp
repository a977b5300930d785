// The legend of views that color particles.
#include <cstdio>

#include "view/panels/board.hpp"
#include "views/color_map.hpp"

namespace rill::view {

void legendOverlay(Board& board) {
  const auto legend = board.session.painter().legend(board.settings.view, board.session.runner().time_s());
  if (!legend || board.settings.help) return;  // the help covers it
  const float em = ImGui::GetFontSize();
  const Area& area = board.layout.picture;
  ImGui::SetNextWindowPos(ImVec2(static_cast<float>(area.x) + 0.6f * em, static_cast<float>(area.y + area.height) - 0.6f * em), 0,
                          ImVec2(0, 1));
  ImGui::Begin("legend", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_AlwaysAutoResize);
  const bool speed = legend->color == ParticleColor::Speed;
  ImGui::TextUnformatted(speed ? "speed, m/s" : "compression, %");
  const float width = 12 * em, height = 0.7f * em;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  constexpr int kBands = 64;
  for (int k = 0; k < kBands; ++k) {
    const Float3 c = mapColor(legend->color, (k + 0.5) / kBands);
    const auto edge = [&](int band) { return at.x + width * static_cast<float>(band) / kBands; };
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(edge(k), at.y), ImVec2(edge(k + 1), at.y + height),
                                              IM_COL32(srgbByte(c.x), srgbByte(c.y), srgbByte(c.z), 255));
  }
  ImGui::Dummy(ImVec2(width, height));
  char limit[32];
  std::snprintf(limit, sizeof limit, "%.3g", speed ? legend->max : 100 * legend->max);
  ImGui::TextUnformatted("0");
  ImGui::SameLine(width - ImGui::CalcTextSize(limit).x);
  ImGui::TextUnformatted(limit);
  ImGui::End();
}

}  // namespace rill::view
