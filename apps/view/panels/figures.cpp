// Figures of the simulation over the last steps.
#include <algorithm>
#include <cstdio>

#include "core/words.hpp"
#include "view/panels/board.hpp"

namespace rill::view {
namespace {

/// From 0 on. `format`: of a line with the last value above the plot; null: no line.
void figurePlot(const char* name, const History& history, const char* format) {
  const std::vector<float>& values = history.values();
  if (values.empty()) return;
  if (format) {
    char now[48];
    std::snprintf(now, sizeof now, format, static_cast<double>(values.back()));
    figureLine(name, "%s", now);
  }
  const float top = *std::ranges::max_element(values);
  plot(name, history, 0, top > 0 ? 1.1f * top : 1, 2);
}

}  // namespace

void plot(const char* name, const History& history, float low, float high, float ems) {
  const std::vector<float>& values = history.values();
  ImGui::PushID(name);
  ImGui::PlotLines("##plot", values.data(), static_cast<int>(values.size()), 0, nullptr, low, high,
                   ImVec2(ImGui::GetContentRegionAvail().x, ems * ImGui::GetFontSize()));
  ImGui::PopID();
}

void figurePanel(Board& board) {
  const Histories& h = board.histories;
  figureLine("particles", "%s", grouped(board.session.runner().fluid().count()).c_str());
  figurePlot("particles", h.particles, nullptr);
  figurePlot("step", h.wall_ms, "%.1f ms");
  figurePlot("substeps a step", h.substeps, "%.0f");
  figurePlot("iterations a step", h.iterations, "%.0f");
  figurePlot("compression mean", h.error, "%.3f %%");
  if (board.stats) {
    figureLine("compression p99", "%.3f %%", 100 * board.stats->densityErrorP99);
    figureLine("max speed", "%.3g m/s", board.stats->maxSpeed);
    figureLine("energy", "%.4g J", board.stats->kinetic_J + board.stats->potential_J);
    if (board.stats->sleeping) figureLine("asleep", "%s particles", grouped(*board.stats->sleeping).c_str());
    figureLine("outside; not finite", "%llu; %llu", static_cast<unsigned long long>(board.stats->outside),
               static_cast<unsigned long long>(board.stats->nonFinite));
  }
  const DeviceMemory& memory = board.memory;
  if (memory.used)
    figureLine("device memory", "%s of %s MiB", grouped(*memory.used >> 20).c_str(), grouped(*memory.budget >> 20).c_str());
  else if (memory.size > 0)
    figureLine("device memory", "%s MiB in all", grouped(memory.size >> 20).c_str());
  if (memory.size > 0 && ImGui::IsItemHovered())
    ImGui::SetTooltip(memory.used ? "used by this program, of what the driver grants it now; the device has %s MiB"
                                  : "the driver does not report use (VK_EXT_memory_budget); the device has %s MiB",
                      grouped(memory.size >> 20).c_str());
}

}  // namespace rill::view
