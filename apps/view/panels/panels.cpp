// Where the panels are: a column at each side, a line at the bottom.
#include <algorithm>
#include <cstdarg>

#include "view/panels/board.hpp"

namespace rill::view {
namespace {

constexpr float kLeft = 320, kRight = 330, kLine = 26, kGap = 8;  // at a scale of 1

bool begin(const char* name, float x, float y, float width, float height, ImGuiWindowFlags more = 0) {
  ImGui::SetNextWindowPos(ImVec2(x, y));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  return ImGui::Begin(name, nullptr,
                      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | more);
}

void section(Board& board, const char* name, void (*panel)(Board&), bool open) {
  if (!ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0)) return;
  ImGui::PushID(name);
  panel(board);
  ImGui::PopID();
}

void statusLine(Board& board) {
  const Runner& runner = board.session.runner();
  std::string text;
  char part[160];
  const auto add = [&](const char* format, auto... values) {
    std::snprintf(part, sizeof part, format, values...);
    text += (text.empty() ? "" : "   ") + std::string(part);
  };
  add("%s", board.settings.paused ? "paused"
            : board.lockstep      ? "in lockstep"
            : board.speed < 0.95  ? "slower than real time:"
                                  : "real time");
  if (!board.settings.paused && !board.lockstep && board.speed < 0.95) {
    std::snprintf(part, sizeof part, " %.2g\xC3\x97", board.speed);
    text += part;
  }
  add("t %.3f s", runner.time_s());
  add("step %llu", static_cast<unsigned long long>(runner.steps()));
  add("%.0f frames/s", board.framesPerSecond);
  if (board.pictureScale < 1) add("picture at %.0f %% (%.0f ms)", 100 * board.pictureScale, 1e3 * board.picture_s);
  if (runner.last().pieces > 1) add("a step takes %.0f ms, in %u pieces", 1e3 * runner.last().wall_s, runner.last().pieces);
  if (runner.last().time_dropped_s > 0) add("%.3g ms dropped (solver.max_substeps)", 1e3 * runner.last().time_dropped_s);
  ImGui::TextUnformatted(text.c_str());
}

void messageBox(Board& board, float middle, float top, float width) {
  if (board.message.empty()) return;
  ImGui::SetNextWindowPos(ImVec2(middle, top), 0, ImVec2(0.5f, 0));
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, 1e6f));
  ImGui::Begin(
      "message", nullptr,
      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushTextWrapPos(width - 16 * board.interface.scale());
  ImGui::TextUnformatted(board.message.c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::Button("Close")) board.message.clear();
  ImGui::End();
}

}  // namespace

void figureLine(const char* name, const char* format, ...) {
  ImGui::TextUnformatted(name);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.52f);
  va_list arguments;
  va_start(arguments, format);
  ImGui::TextV(format, arguments);
  va_end(arguments);
}

void drawPanels(Board& board) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float scale = board.interface.scale(), gap = kGap * scale, line = kLine * scale;
  // In a narrow window each column has two fifths, so that they do not meet.
  const float left = std::min(kLeft * scale, 0.4f * size.x), right = std::min(kRight * scale, 0.4f * size.x);
  const float height = std::max(size.y - line - 3 * gap, 1.0f);
  if (board.settings.panels) {
    begin("left", gap, gap, left, height);
    section(board, "Scene", scenePanel, true);
    section(board, "Parameters", parameterPanel, true);
    ImGui::End();
    begin("right", size.x - right - gap, gap, right, height);
    section(board, "Figures", figurePanel, true);
    section(board, "Passes", passPanel, true);
    section(board, "Memory", memoryPanel, false);
    ImGui::End();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(gap, 0.25f * line - 2 * scale));
    begin("status", gap, size.y - line - gap, size.x - 2 * gap, line, ImGuiWindowFlags_NoScrollbar);
    statusLine(board);
    ImGui::End();
    ImGui::PopStyleVar();
  }
  legendOverlay(board, board.settings.panels ? left + 2 * gap : gap, size.y - line - 2 * gap);
  const float from = board.settings.panels ? left + 2 * gap : gap, to = size.x - (board.settings.panels ? right + 2 * gap : gap);
  messageBox(board, 0.5f * (from + to), gap, std::max(to - from, 0.3f * size.x));
  if (board.settings.help) helpOverlay(board);
}

}  // namespace rill::view
