#include "capture/raw_options.hpp"

#include <string_view>

#include "core/words.hpp"
#include "rill/offline.hpp"
#include "rill/version.hpp"
#include "shared/device_option.hpp"
#include "shared/option_text.hpp"

namespace rill::capture {

void declareOptions(CLI::App& app, RawOptions& raw) {
  const auto once = [&](const std::string& name, std::string& value, const std::string& about, const std::string& type,
                        const std::string& group) { app.add_option(name, value, about)->type_name(type)->group(group); };
  const auto list = [&](const std::string& name, std::vector<std::string>& values, const std::string& about, const std::string& type,
                        const std::string& group) {
    app.add_option(name, values, about)
        ->type_name(type)
        ->group(group)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->expected(1);
  };
  const std::string what = "Scene", written = "Output", film = "Film effects", run = "Run";
  app.add_option("SCENE", raw.scene, "name of a scene, or path of a .json file")->type_name("")->required()->group(what);
  once("--frames", raw.frames, "number of frames, including the start (default: the scene's duration)", "N", what);
  once("--fps", raw.fps, "frames per simulated second (default: 60)", "F", what);
  once("--particles", raw.particles, "approximate number of particles (1 to " + grouped(kMaxParticles) + "); replaces fluid.spacing", "N",
       what);
  once("--resume", raw.resume, "continue from a checkpoint of the same scene; --frames counts the frames of this run", "FILE", what);
  once("--play", raw.play, "draw the .ply files of a folder in order of their names, instead of simulating", "DIR", what);
  list("--set", raw.set, "override a key of the scene, for example fluid.viscosity=0.1", "KEY=VALUE", what);

  once("--out", raw.out, "folder for the frames, created if missing (default: out/SCENE)", "DIR", written);
  once("--size", raw.size, "image size in pixels (default: 1280x720)", "WxH", written);
  once("--view", raw.view, "view to draw: " + apps::viewNames() + " (default: final)", "VIEW", written);
  once("--orbit", raw.orbit, "rotate the camera about its target, in degrees per simulated second", "DEG_PER_S", written);
  once("--exposure", raw.exposure, "brighten the view final by EV stops, each twice the light (-10 to 10, default: 0)", "EV", written);
  once("--samples", raw.samples, "mean of N pictures of the view final, each at another point of the pixels (1 to 256, default: 1)", "N",
       film);
  once("--shutter", raw.shutter,
       "motion blur: the shutter is open for DEG / 360 of a frame's time (0 to 360, default: 0; 180 is usual; --samples: " +
           std::to_string(offline::kFilmSamples) + ")",
       "DEG", film);
  once("--aperture", raw.aperture,
       "depth of field of a lens with this f-number before a full-frame sensor (0.5 to 64, default: none; --samples: " +
           std::to_string(offline::kFilmSamples) + ")",
       "F", film);
  once("--focus", raw.focus, "distance that is sharp with --aperture, in meters (default: that of the camera's target)", "M", film);
  once("--video", raw.video, "also write the images as a video (.mp4, .mkv or .mov; needs the program ffmpeg)", "FILE", written);
  app.add_flag("--exr", raw.exr,
               "write images of the view final as OpenEXR in linear light, before exposure and tone curve, in place of PNG")
      ->group(written);
  app.add_flag("--no-images", raw.noImages, "write no image files; without --video render none")->group(written);
  list("--export", raw.exportAs,
       "write of each frame the particles (ply; vtk: .vtu and DIR/particles.pvd for ParaView; those of whitewater as .whitewater.ply or "
       "vtu), the fluid's surface (mesh), or where the solids are (poses: DIR/poses.csv); may be repeated",
       "FORMAT", written);
  once("--mesh-format", raw.meshFormat, "of --export mesh: ply, obj, glb or vtp (with DIR/mesh.pvd) (default: ply)", "FORMAT", written);
  once("--mesh-cell", raw.meshCell, "side of the mesh's grid cells in particle spacings, 0.25 to 1 (default: 0.5)", "SPACINGS", written);
  once("--stats", raw.stats, "write all figures of all frames as JSON; - is standard output", "FILE", written);

  once("--graph", raw.graph, "write the render graph of the last image (without images: of the last simulation step) for Graphviz",
       "FILE.dot", written);
  once("--checkpoint", raw.checkpoint, "write the state that --resume continues from, at the end and on Ctrl-C", "FILE", written);
  once("--checkpoint-every", raw.checkpointEvery, "also write it every SECONDS of wall time, after the frame in progress", "SECONDS",
       written);

  app.add_flag("--no-pass-times", raw.noPassTimes, "do not time passes for --stats and --explain, which slows down software devices")
      ->group(run);
  once("--device", raw.device, apps::kDeviceHelp, "NAME", run);
  once("--reads", raw.reads, "how kernels read arrays: auto (by the device's vendor), storage (buffers) or texels (default: auto)", "KIND",
       run);
  list("--require", raw.require, "exit with 3 unless it holds, for example 'outside<1'", "FIGURE<NUMBER", run);
  app.add_flag("--explain", raw.explain, "list all passes: how often recorded and run, time, or the reason why skipped")->group(run);
  app.add_flag("--quiet", raw.quiet, "print nothing but errors")->group(run);
  app.set_help_flag("-h,--help", "show this text")->group(run);
  app.set_version_flag("--version", std::string("rill-capture ") + RILL_VERSION, "show the version")->group(run);
}

std::vector<std::string> expandLists(int count, const char* const* arguments) {
  std::vector<std::string> expanded;
  std::string list;    // the list option that the last argument belongs to
  bool value = false;  // the next argument is its value whatever its form
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    const bool option = argument.starts_with('-');
    if (value) {
      value = false;
    } else if (argument == "--set" || argument == "--require") {
      list = argument;
      value = true;
    } else if (option || list.empty()) {
      list.clear();
    } else {
      const size_t sign = argument.find_first_of(list == "--set" ? "=" : "<>");
      // Keys contain no '/': a path that contains a '=' is the scene.
      const bool another = sign != std::string_view::npos && sign > 0 && argument.substr(0, sign).find('/') == std::string_view::npos;
      if (another)
        expanded.push_back(list);
      else
        list.clear();
    }
    expanded.emplace_back(argument);
  }
  return expanded;
}

}  // namespace rill::capture
