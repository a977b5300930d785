// capacityOf(): how many particles a scene may have at a time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fill/mouth.hpp"
#include "rill/particles.hpp"

namespace rill {
namespace {

constexpr uint64_t kAll = std::numeric_limits<uint64_t>::max();

/// `count` rounded up; the largest number if it is no 64-bit one.
uint64_t wholeNumber(double count) {
  const double up = std::ceil(count);
  if (!(up < 0x1p64)) return kAll;
  return up > 0 ? static_cast<uint64_t>(up) : 0;
}

uint64_t sum(uint64_t a, uint64_t b) { return a > kAll - b ? kAll : a + b; }

}  // namespace

uint64_t capacityOf(const Scene& scene, uint64_t filled) {
  uint64_t capacity = scene.fluid.capacity;
  if (capacity == 0) {
    const double spacing = scene.fluid.spacing, volume = spacing * spacing * spacing;
    capacity = filled;
    for (const Emitter& emitter : emittersOf(scene)) {
      const double end = std::min(emitter.until.value_or(scene.duration), scene.duration);
      const double time = std::max(end - emitter.from, 0.0);
      capacity = sum(capacity, wholeNumber(flowOf(emitter) * time / volume));
      capacity = sum(capacity, wholeNumber(areaOf(emitter.mouth) / (spacing * spacing)));
    }
  }
  return std::min(capacity, kMaxParticles);
}

}  // namespace rill
