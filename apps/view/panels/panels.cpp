// Lays out the panels: a column at each side, a status line at the bottom.
#include <algorithm>
#include <cstdarg>

#include "view/panels/board.hpp"

namespace rill::view {
namespace {

bool begin(const char* name, const Area& area, ImGuiWindowFlags more = 0) {
  ImGui::SetNextWindowPos(ImVec2(static_cast<float>(area.x), static_cast<float>(area.y)));
  ImGui::SetNextWindowSize(ImVec2(static_cast<float>(area.width), static_cast<float>(area.height)));
  return ImGui::Begin(name, nullptr,
                      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus | more);
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
  add(board.framesPerSecond < 10 ? "%.1f frames/s" : "%.0f frames/s", board.framesPerSecond);
  if (board.pictureScale < 1) add("picture at %.0f %% (%.0f ms)", 100 * board.pictureScale, 1e3 * board.picture_s);
  if (runner.last().pieces > 1) add("a step takes %.0f ms, in %u pieces", 1e3 * runner.last().seconds, runner.last().pieces);
  if (runner.last().timeDropped_s > 0) add("%.3g ms dropped (solver.max_substeps)", 1e3 * runner.last().timeDropped_s);
  ImGui::TextUnformatted(text.c_str());
}

/// From the point that a body was grabbed by to the pointer.
void pullLine(const Board& board) {
  if (!board.pullLine) return;
  const auto at = [&](size_t k) { return ImVec2(static_cast<float>((*board.pullLine)[k].x), static_cast<float>((*board.pullLine)[k].y)); };
  const float width = 2 * board.interface.scale();
  const Area& area = board.layout.picture;
  ImDrawList& lines = *ImGui::GetBackgroundDrawList();
  lines.PushClipRect(ImVec2(static_cast<float>(area.x), static_cast<float>(area.y)),
                     ImVec2(static_cast<float>(area.x + area.width), static_cast<float>(area.y + area.height)));
  lines.AddLine(at(0), at(1), IM_COL32(255, 200, 60, 255), width);
  lines.AddCircleFilled(at(0), 2 * width, IM_COL32(255, 200, 60, 255));
  lines.PopClipRect();
}

void messageBox(Board& board) {
  if (board.message.empty()) return;
  const Area& area = board.layout.picture;
  const float gap = ImGui::GetFontSize(), width = static_cast<float>(area.width) - 2 * gap;
  ImGui::SetNextWindowPos(ImVec2(static_cast<float>(area.x) + gap, static_cast<float>(area.y) + gap));
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, 1e6f));
  ImGui::Begin("message", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);  // keeps the focus of a text field
  ImGui::PushTextWrapPos(width - gap);
  ImGui::TextUnformatted(board.message.c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::Button("Close")) board.message.clear();
  ImGui::End();
}

}  // namespace

void figureLine(const char* name, const char* format, ...) {
  ImGui::TextUnformatted(name);
  const float after = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetFontSize();
  ImGui::SameLine(std::max(after, ImGui::GetWindowContentRegionMax().x * 0.56f));
  va_list arguments;
  va_start(arguments, format);
  ImGui::TextV(format, arguments);
  va_end(arguments);
}

void drawPanels(Board& board) {
  const Layout& layout = board.layout;
  if (board.settings.panels) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    begin("left", layout.left);
    section(board, "Scene", scenePanel, true);
    section(board, "Parameters", parameterPanel, true);
    ImGui::End();
    begin("right", layout.right);
    section(board, "Figures", figurePanel, true);
    if (!board.session.runner().fluid().bodies().empty()) section(board, "Bodies", bodyPanel, true);
    if (hasFlows(board.session.scene())) section(board, "Flows", flowPanel, true);
    section(board, "Memory", memoryPanel, false);
    section(board, "Passes", passPanel, true);
    ImGui::End();
    const float above = 0.5f * (static_cast<float>(layout.status.height) - ImGui::GetTextLineHeight());
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(8 * board.interface.scale(), std::max(above, 0.0f)));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    begin("status", layout.status, ImGuiWindowFlags_NoScrollbar);
    statusLine(board);
    ImGui::End();
    ImGui::PopStyleVar(3);
  }
  pullLine(board);
  legendOverlay(board);
  messageBox(board);
  if (board.settings.help) helpOverlay(board);
}

}  // namespace rill::view
