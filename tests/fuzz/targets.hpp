#pragma once
// Fuzz targets: they accept any bytes without crashing or reading out of bounds, and return 0 as libFuzzer requires.
#include <cstddef>
#include <cstdint>

namespace rill::test {

/// Scene text, optionally followed by a zero byte and overrides, one per line.
int fuzzScene(const uint8_t* data, size_t size);
/// A PLY file of particles.
int fuzzPly(const uint8_t* data, size_t size);
/// A mesh file, after a letter for its format: o OBJ, s STL, g glTF, b binary glTF, else PLY.
int fuzzMesh(const uint8_t* data, size_t size);
/// A checkpoint file, unmodified and with corrected size and checksum.
int fuzzCheckpoint(const uint8_t* data, size_t size);

}  // namespace rill::test
