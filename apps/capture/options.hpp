#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "capture/requirement.hpp"
#include "rill/expected.hpp"
#include "rill/scene_io.hpp"
#include "shared/program.hpp"

namespace rill::capture {

/// The most frames that a capture writes.
constexpr uint32_t kMaxFrames = 10'000'000;

/// What a command line asks for. Judged as far as that is possible without the scene.
struct Options {
  std::string scene;                         ///< a name or a path
  std::optional<uint32_t> frames;            ///< none: the scene's duration
  double fps = 60;                           ///< frames a simulated second
  bool fpsGiven = false;                     ///< else a checkpoint's own are taken where a run goes on from one
  uint32_t width = 1280, height = 720;       ///< pixels
  std::optional<std::filesystem::path> out;  ///< none: out/SCENE
  std::string view = "final";
  double orbit_deg_per_s = 0;                  ///< of the camera around its target
  std::optional<std::filesystem::path> video;  ///< where the pictures go as one file
  std::optional<std::filesystem::path> stats;
  std::optional<std::filesystem::path> graph;  ///< where the last picture's passes go, as Graphviz's dot
  bool exportPly = false;
  std::optional<std::filesystem::path> checkpoint;  ///< where to
  std::optional<double> checkpointEvery_s;          ///< wall time
  std::optional<std::filesystem::path> resume;      ///< where from
  std::optional<std::filesystem::path> play;        ///< a folder of PLY files to draw in place of simulating
  std::vector<Override> overrides;                  ///< of the scene's keys, in order; --particles is the last one
  std::string device;
  std::vector<Requirement> requirements;
  bool explain = false, images = true, quiet = false;
  bool passTimes = true;  ///< where --stats or --explain would show them
  std::string command;    ///< the command line, quoted where a shell needs it
};

/// BadInput with a message that names the option, what was given and what was expected.
Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments);

}  // namespace rill::capture
