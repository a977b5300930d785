#include "bench/experiments/start_file.hpp"

#include <utility>

#include "shared/ply.hpp"

namespace rill::bench {

Expected<StartFile> StartFile::write(const Cloud& cloud) {
  auto folder = apps::TemporaryFolder::make();
  if (!folder) return folder.error();
  StartFile start(std::move(*folder));
  const auto narrow = [](const Double3& point) {
    return Float3{static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])};
  };
  offline::Particles particles;
  for (size_t i = 0; i < cloud.size(); ++i) {
    particles.positions.push_back(narrow(cloud.position[i]));
    particles.velocities.push_back(narrow(cloud.velocity[i]));
    particles.densities.push_back(0);
    particles.ids.push_back(static_cast<uint32_t>(i));
  }
  if (auto written = apps::writePly(start.file(), particles, 0); !written) return written.error();
  return start;
}

Fill StartFile::fill() const {
  Fill fill;
  fill.shape = ParticleFile{file()};
  return fill;
}

}  // namespace rill::bench
