#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "fill/ply_reader.hpp"
#include "fuzz/require.hpp"
#include "fuzz/targets.hpp"

namespace rill::test {

int fuzzPly(const uint8_t* data, size_t size) {
  // The reader takes a path, so the input is written to a memory file.
  const int descriptor = ::memfd_create("fuzz", MFD_CLOEXEC);
  if (descriptor < 0) return 0;
  const bool written = ::write(descriptor, data, size) == static_cast<ssize_t>(size);
  if (written) {
    const auto file = PlyFile::open("/proc/self/fd/" + std::to_string(descriptor));
    if (file && file->count() <= 100'000)
      if (const auto particles = file->read()) {
        RILL_REQUIRE(particles->positions.size() == file->count());
        RILL_REQUIRE(particles->velocities.empty() || particles->velocities.size() == file->count());
      }
  }
  ::close(descriptor);
  return 0;
}

}  // namespace rill::test
