#pragma once
// What follows from a scene alone and several layers need.
#include "rill/scene.hpp"

namespace rill {

/// m/s^2, of the whole schedule.
double strongestGravity(const Scene& scene);
/// Along one axis.
double strongestGravity(const Scene& scene, int axis);

/// Whether the scene asks for sleep, and its fluid is one that can.
bool maySleep(const Scene& scene);

}  // namespace rill
