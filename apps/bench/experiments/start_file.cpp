#include "bench/experiments/start_file.hpp"

#include <cstdlib>
#include <utility>

#include "shared/ply.hpp"

namespace rill::bench {
namespace fs = std::filesystem;

Expected<StartFile> StartFile::write(const Cloud& cloud) {
  std::error_code failed;
  std::string pattern = (fs::temp_directory_path(failed) / "rill-bench-XXXXXX").string();
  if (failed || ::mkdtemp(pattern.data()) == nullptr) return Error{ErrorKind::Io, "making a temporary folder as " + pattern + " failed"};
  StartFile start{fs::path(pattern)};
  const auto narrow = [](const Point& point) {
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

StartFile::StartFile(StartFile&& other) noexcept : folder_(std::exchange(other.folder_, {})) {}

StartFile::~StartFile() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

Fill StartFile::fill() const {
  Fill fill;
  fill.particles = file();
  return fill;
}

}  // namespace rill::bench
