#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "capture/film_options.hpp"
#include "capture/requirement.hpp"
#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/offline.hpp"
#include "rill/scene_io.hpp"
#include "shared/device_option.hpp"
#include "shared/mesh_file.hpp"
#include "shared/program.hpp"

namespace rill::capture {

/// Maximum number of frames of a capture.
constexpr uint32_t kMaxFrames = 10'000'000;

/// The options of a command line, validated as far as that is possible without the scene.
struct Options {
  std::string scene;                         ///< a name or a path
  std::optional<uint32_t> frames;            ///< none: the scene's duration
  double fps = 60;                           ///< frames per simulated second
  bool fpsGiven = false;                     ///< otherwise --resume uses the frame rate of the checkpoint
  uint32_t width = 1280, height = 720;       ///< pixels
  std::optional<std::filesystem::path> out;  ///< none: out/SCENE
  std::string view = "final";
  double orbit_degPerS = 0;                    ///< rotation of the camera about its target
  double exposure_stops = 0;                   ///< of the view final
  FilmOptions film;                            ///< of the view final
  std::optional<std::filesystem::path> video;  ///< video file of the images
  std::optional<std::filesystem::path> stats;
  std::optional<std::filesystem::path> graph;  ///< passes of the last image, in Graphviz's dot language
  bool exportPly = false, exportPoses = false, exportMesh = false, exportVtk = false;
  apps::MeshFormat meshFormat = apps::MeshFormat::Ply;
  double meshCell = 0.5;                            ///< spacings
  std::optional<std::filesystem::path> checkpoint;  ///< file to write
  std::optional<double> checkpointEvery_s;          ///< wall time
  std::optional<std::filesystem::path> resume;      ///< checkpoint to resume from
  std::optional<std::filesystem::path> play;        ///< folder of PLY files to draw instead of simulating
  std::vector<Override> overrides;                  ///< of scene keys, in order; --particles is the last one
  apps::DeviceOption device;
  ArrayReads reads = ArrayReads::Auto;
  std::vector<Requirement> requirements;
  bool explain = false, images = true, quiet = false;
  bool exr = false;       ///< images are linear OpenEXR files in place of PNG
  bool passTimes = true;  ///< for --stats and --explain
  std::string command;    ///< the command line, quoted for a shell
};

/// What simulations and players need of them, at `fps` frames per simulated second. Pass times are as by default.
offline::Options offlineOptions(const Options& options, double fps);

/// BadInput with the option, what was given and what was expected.
Expected<apps::CommandLine<Options>> parseCommandLine(int count, const char* const* arguments);

}  // namespace rill::capture
