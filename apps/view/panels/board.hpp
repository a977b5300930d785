#pragma once
// What the panels show, and what hands ask for in them. The viewer reads the requests between two frames.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "view/display.hpp"
#include "view/interface.hpp"
#include "view/layout.hpp"
#include "view/playback.hpp"
#include "view/session.hpp"

namespace rill::view {

/// A number of the scene that a hand is changing: the scene gets it when the hand lets go.
struct HeldEdit {
  std::string key;
  std::array<double, 3> value{};
};

/// What is chosen, by hands or by the command line.
struct Settings {
  std::string view = "final";
  bool paused = false, panels = true, help = false;
  double scale = 0;  ///< of the picture; 0: as the machine allows
};

/// What was asked for in this frame.
struct Requests {
  std::optional<Override> change;
  std::optional<std::string> reset;  ///< key
  std::optional<std::filesystem::path> open;
  std::optional<VkPresentModeKHR> mode;
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
  std::string& message;  ///< an error or a notice, until a hand closes it
  Layout layout;
  std::optional<FluidStats> stats;
  double framesPerSecond = 0;
  double speed = 1;         ///< simulated over real time
  double pictureScale = 1;  ///< now
  double picture_s = 0;     ///< device time of the last picture
  bool lockstep = false;
  Requests requests;
};

/// Draws all panels that are to be seen, none over another.
void drawPanels(Board& board);

void scenePanel(Board& board);
void parameterPanel(Board& board);
void figurePanel(Board& board);
void passPanel(Board& board);
void memoryPanel(Board& board);
void helpOverlay(Board& board);
void legendOverlay(Board& board);

/// A line of name and figure, the figures under each other.
void figureLine(const char* name, const char* format, ...) IM_FMTARGS(2);

}  // namespace rill::view
