#pragma once
// How far a picture's surface is from the true one.
#include <array>
#include <cstdint>
#include <vector>

#include "bench/surface_shapes.hpp"

namespace rill::bench {

/// A perspective camera at the origin that looks along +z of view space; lengths in spacings.
struct Eye {
  uint32_t width = 0, height = 0;     ///< pixels
  double tangentX = 0, tangentY = 0;  ///< of half the field of view
  double distance = 0;                ///< of what it looks at
};

/// A picture's surface as it was read back, a pixel each.
struct Drawn {
  std::vector<float> depth;                   ///< infinite: no fluid
  std::vector<std::array<double, 3>> normal;  ///< in view space
};

/// The true one.
struct TrueSurface {
  enum class Where : uint8_t { Nowhere, Edge, Inside };  ///< an edge: 1.5 spacings around it
  std::vector<Truth> truth;
  std::vector<Where> where;
};
TrueSurface trueSurface(const Shape& shape, const Eye& eye);

struct Errors {
  double mean = 0, p95 = 0;  ///< degrees, away from edges
  double edge = 0;           ///< mean along edges, degrees
  double depth = 0;          ///< rms, spacings, away from edges
  double overlap = 1;        ///< of silhouettes: both over either
};
Errors surfaceErrors(const TrueSurface& surface, const Drawn& drawn);

/// Mean angle between the normals of two pictures, degrees, where both have fluid within `nearby` of the same depth.
double normalChange(const Drawn& before, const Drawn& after, double nearby);

/// The same of what is wrong with them: a normal as it is seen from the true one, so that true motion is not counted.
double errorChange(const TrueSurface& trueBefore, const Drawn& before, const TrueSurface& trueAfter, const Drawn& after);

}  // namespace rill::bench
