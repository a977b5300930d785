#include "capture/frame_files.hpp"

#include <utility>

#include "core/words.hpp"
#include "shared/atomic_file.hpp"
#include "shared/exr.hpp"
#include "shared/mesh_file.hpp"
#include "shared/message.hpp"
#include "shared/ply.hpp"
#include "shared/png.hpp"
#include "shared/vtk_file.hpp"

namespace rill::capture {
namespace fs = std::filesystem;

bool FrameFiles::usesFolder() const {
  return options_.images || options_.exportPly || options_.exportMesh || options_.exportVtk || options_.exportPoses;
}

Expected<void> FrameFiles::check() const {
  if (options_.video)
    if (auto valid = Video::check(*options_.video); !valid) return valid;
  return usesFolder() ? apps::checkFolderPlace("--out", place_) : Expected<void>();
}

Expected<void> FrameFiles::create() {
  if (usesFolder()) {
    auto folder = OutputFolder::prepare(place_, options_.resume.has_value());
    if (!folder) return folder.error();
    folder_ = std::make_unique<OutputFolder>(std::move(*folder));
  }
  if (options_.video) {
    auto video = Video::start(*options_.video, options_.width, options_.height, fps_);
    if (!video) return video.error();
    video_.emplace(*std::move(video));
  }
  if (options_.exportPoses) {
    poses_.emplace(scene_);
    if (first_ > 0) poses_->keep(folder_->file("poses.csv"), first_);
  }
  return {};
}

Expected<void> FrameFiles::write(uint32_t number, double time_s, offline::Simulation& simulation) {
  if (auto written = writeImages(number, simulation); !written) return written;
  if (poses_)
    if (auto added = poses_->add(number, time_s, simulation); !added) return added;
  if (auto written = writeMesh(number, time_s, simulation); !written) return written;
  return writeParticles(number, time_s, simulation);
}

Expected<void> FrameFiles::writeImages(uint32_t number, offline::Simulation& simulation) {
  if (options_.exr) {
    auto image = simulation.renderLinear(options_.width, options_.height);
    if (!image) return image.error();
    if (auto written = apps::writeExr(folder_->frame(number, "exr"), *image); !written) return written;
  }
  const bool png = options_.images && !options_.exr;
  if (!options_.video && !png) return {};
  auto image = simulation.render(options_.view, options_.width, options_.height);
  if (!image) return image.error();
  if (png)
    if (auto written = apps::writePng(folder_->frame(number, "png"), *image); !written) return written;
  return video_ ? video_->add(*image) : Expected<void>();
}

Expected<void> FrameFiles::writeMesh(uint32_t number, double time_s, offline::Simulation& simulation) {
  if (!options_.exportMesh) return {};
  auto mesh = simulation.mesh(options_.meshCell);
  if (!mesh) return mesh.error();
  if (mesh->tooFar > 0 && !meshWarned_) {
    apps::printMessage("rill-capture", "warning: frame " + std::to_string(number) + ": " + grouped(mesh->tooFar) +
                                           " particles are too far away to be in the mesh");
    meshWarned_ = true;
  }
  auto bytes = apps::encodeMesh(*mesh, time_s, options_.meshFormat);
  if (!bytes) return bytes.error();
  return apps::writeFile(folder_->frame(number, apps::meshExtension(options_.meshFormat)), *bytes);
}

Expected<void> FrameFiles::writeParticles(uint32_t number, double time_s, offline::Simulation& simulation) const {
  if (!options_.exportPly && !options_.exportVtk) return {};
  auto particles = simulation.particles();
  if (!particles) return particles.error();
  if (options_.exportPly)
    if (auto written = apps::writePly(folder_->frame(number, "ply"), *particles, time_s); !written) return written;
  if (options_.exportVtk)
    if (auto written = apps::writeFile(folder_->frame(number, "vtu"), apps::encodeVtu(*particles, time_s)); !written) return written;
  return scene_.look.whitewater ? writeWhitewater(number, time_s, simulation) : Expected<void>();
}

Expected<void> FrameFiles::writeWhitewater(uint32_t number, double time_s, offline::Simulation& simulation) const {
  auto white = simulation.whitewater();
  if (!white) return white.error();
  const auto write = [&](bool wanted, const char* extension, auto encode) {
    return wanted ? apps::writeFile(folder_->frame(number, extension), encode(*white, time_s)) : Expected<void>();
  };
  if (auto written = write(options_.exportPly, "whitewater.ply", apps::encodeWhitewaterPly); !written) return written;
  return write(options_.exportVtk, "whitewater.vtu", apps::encodeWhitewaterVtu);
}

Expected<void> FrameFiles::writePoses() const {
  return poses_ ? apps::writeFile(folder_->file("poses.csv"), poses_->text()) : Expected<void>();
}

Expected<void> FrameFiles::writeSeries(size_t frames) const {
  const auto write = [&](bool wanted, const char* name, const char* extension) -> Expected<void> {
    if (!wanted) return {};
    std::vector<std::pair<double, std::string>> files;
    for (uint32_t k = 0; k < first_ + static_cast<uint32_t>(frames); ++k) {
      std::error_code ignored;
      const fs::path file = folder_->frame(k, extension);
      if (k >= first_ || fs::exists(file, ignored)) files.emplace_back(k / fps_, file.filename().string());
    }
    return apps::writeFile(folder_->file(name), apps::encodePvd(files));
  };
  if (auto written = write(options_.exportVtk, "particles.pvd", "vtu"); !written) return written;
  if (auto written = write(options_.exportVtk && scene_.look.whitewater, "whitewater.pvd", "whitewater.vtu"); !written) return written;
  return write(options_.exportMesh && options_.meshFormat == apps::MeshFormat::Vtp, "mesh.pvd", "mesh.vtp");
}

std::vector<std::string> FrameFiles::places(size_t frames) const {
  std::vector<std::string> all;
  if ((options_.images || options_.exportPly || options_.exportVtk || options_.exportMesh) && frames > 0) {
    const auto last = static_cast<uint32_t>(first_ + frames - 1);
    const char* kind = options_.exr          ? "exr"
                       : options_.images     ? "png"
                       : options_.exportPly  ? "ply"
                       : options_.exportMesh ? apps::meshExtension(options_.meshFormat)
                                             : "vtu";
    all.push_back("frames: " + folder_->frame(first_, kind).string() +
                  (last > first_ ? " to " + folder_->frame(last, kind).filename().string() : ""));
  }
  if (poses_) all.push_back("poses: " + folder_->file("poses.csv").string());
  return all;
}

}  // namespace rill::capture
