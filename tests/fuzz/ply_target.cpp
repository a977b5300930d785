#include "fill/ply_reader.hpp"
#include "fuzz/memory_file.hpp"
#include "fuzz/require.hpp"
#include "fuzz/targets.hpp"

namespace rill::test {

int fuzzPly(const uint8_t* data, size_t size) {
  const MemoryFile memory(data, size);
  if (!memory) return 0;
  const auto file = PlyFile::open(memory.path(), 2);
  if (file && file->count() <= 100'000)
    if (const auto particles = file->read()) {
      RILL_REQUIRE(particles->positions.size() == file->count());
      RILL_REQUIRE(particles->velocities.empty() || particles->velocities.size() == file->count());
      RILL_REQUIRE(particles->fluids.empty() || particles->fluids.size() == file->count());
      for (const uint8_t fluid : particles->fluids) RILL_REQUIRE(fluid < 2);
    }
  return 0;
}

}  // namespace rill::test
