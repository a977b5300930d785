#pragma once
// Images of half floats, read back.
#include <cmath>
#include <cstdint>

#include "rill/graph.hpp"

namespace rill::test {

/// The value of a half float that is finite and not negative.
inline double halfValue(uint16_t half) {
  return std::ldexp(half < 1024 ? half : (half & 1023) + 1024, half < 1024 ? -24 : (half >> 10) - 25);
}

/// The texels of an RGBA image of half floats.
inline Ticket readbackHalves(Graph& graph, ImageRef image, uint64_t pixels) {
  BufferRef copied = graph.create("pixels", {pixels * 8});
  graph.pass("copy pixels", [&](Pass& pass) {
    pass.read(image, Use::CopySource);
    copied = pass.write(copied, Use::CopyTarget);
    return [=](Commands& commands) { commands.copy(image, copied); };
  });
  return graph.readback(copied);
}

}  // namespace rill::test
