#pragma once
// Data that the panels show, and requests that they make. The viewer handles the requests between two frames.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "offline/device_list.hpp"
#include "view/display.hpp"
#include "view/held_edit.hpp"
#include "view/interface.hpp"
#include "view/layout.hpp"
#include "view/memory_meter.hpp"
#include "view/playback.hpp"
#include "view/session.hpp"
#include "view/settings.hpp"

namespace rill::view {

/// A change of a body's density.
struct DensityChange {
  uint32_t solid = 0;
  double density = 0;  ///< kg/m^3
};

/// Requests of this frame.
struct Requests {
  std::optional<Override> change;
  std::optional<std::string> reset;  ///< key
  std::optional<std::filesystem::path> open;
  std::optional<VkPresentModeKHR> mode;
  std::optional<size_t> device;  ///< index
  std::optional<DensityChange> density;
  std::optional<EmitterTarget> emitter;
  bool restart = false, oneStep = false, save = false;
};

struct Board {
  Session& session;
  Display& display;
  Interface& interface;
  Settings& settings;
  const std::vector<std::string>& scenes;  ///< names
  const std::string& scene;                ///< the one that is open
  const std::string& device;               ///< name and driver
  Histories& histories;
  HeldEdit& held;
  std::string& message;  ///< an error or a notice, until it is closed
  Layout layout;
  std::optional<FluidStats> stats;
  double framesPerSecond = 0;
  double speed = 1;         ///< simulated over real time
  double pictureScale = 1;  ///< now
  double picture_s = 0;     ///< device time of the last picture
  std::span<const offline::ListedDevice> devices;
  DeviceMemory memory;
  std::optional<std::array<Place, 2>> pullLine;  ///< see Controls::pullLine()
  bool lockstep = false;
  Requests requests;
};

/// Draws all visible panels.
void drawPanels(Board& board);

void scenePanel(Board& board);
void parameterPanel(Board& board);
void figurePanel(Board& board);
void bodyPanel(Board& board);
void flowPanel(Board& board);
void passPanel(Board& board);
void memoryPanel(Board& board);
void helpOverlay(Board& board);
void legendOverlay(Board& board);

/// A line with a name and a value; values are aligned.
void figureLine(const char* name, const char* format, ...) IM_FMTARGS(2);
/// A plot from `low` to `high`, `ems` high.
void plot(const char* name, const History& history, float low, float high, float ems);

}  // namespace rill::view
