#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rill/scene_io.hpp"
#include "shared/device_option.hpp"
#include "shared/program.hpp"
#include "view/present_mode.hpp"

namespace rill::view {

/// The options of a command line, validated as far as that is possible without the scene.
struct Options {
  std::string scene = "dam-break";  ///< a name or a path
  apps::DeviceOption device;
  uint32_t width = 1280, height = 720;  ///< of the window, pixels
  std::optional<float> scale;           ///< of text and buttons; none: the display's
  std::string view = "final";
  double exposure_stops = 0;  ///< of the view final
  VkPresentModeKHR present = VK_PRESENT_MODE_FIFO_KHR;
  std::vector<Override> overrides;  ///< of scene keys, in order
  std::optional<uint64_t> frames;   ///< displayed frames after which the program ends
  std::optional<std::filesystem::path> screenshot;
  std::optional<std::filesystem::path> script;
  bool listDevices = false;  ///< print the devices and end
  bool lockstep = false;     ///< one step per displayed frame, however long it takes
  bool validate = false;
};

/// BadInput with the option, what was given and what was expected.
Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments);

}  // namespace rill::view
