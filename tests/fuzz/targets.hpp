#pragma once
// What is fuzzed: each takes any bytes and must neither crash nor read beyond them. All return 0, as libFuzzer wants.
#include <cstddef>
#include <cstdint>

namespace rill::test {

/// A scene's text; after a zero byte, overrides, one a line.
int fuzzScene(const uint8_t* data, size_t size);
/// A PLY file of particles.
int fuzzPly(const uint8_t* data, size_t size);
/// A checkpoint's file, as it is and with a checksum that holds.
int fuzzCheckpoint(const uint8_t* data, size_t size);

}  // namespace rill::test
