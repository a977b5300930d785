#pragma once
// Errors of a rendered surface against the analytic reference.
#include <array>
#include <cstdint>
#include <vector>

#include "bench/surface_shapes.hpp"

namespace rill::bench {

/// A perspective camera at the origin that looks along +z of view space; lengths in spacings.
struct Eye {
  uint32_t width = 0, height = 0;           ///< pixels
  double tanHalfFovX = 0, tanHalfFovY = 0;  ///< tangents of half the field of view
  double distance = 0;                      ///< to the subject
};

/// A surface read back from the GPU, one value per pixel.
struct RenderedSurface {
  std::vector<float> depth;     ///< infinite: no fluid
  std::vector<Double3> normal;  ///< in view space
};

/// The analytic surface per pixel.
struct ReferenceSurface {
  enum class Region : uint8_t { Outside, Edge, Interior };  ///< Edge: within 1.5 spacings of a silhouette or depth step
  std::vector<ReferencePoint> points;
  std::vector<Region> regions;
};
ReferenceSurface referenceSurface(const Shape& shape, const Eye& eye);

struct Errors {
  double mean = 0, p95 = 0;  ///< degrees, interior pixels
  double edge = 0;           ///< mean of edge pixels, degrees
  double depth = 0;          ///< root mean square, spacings, interior pixels
  double iou = 1;            ///< intersection over union of the silhouettes
};
Errors surfaceErrors(const ReferenceSurface& surface, const RenderedSurface& rendered);

/// Mean angle between the normals of two pictures, degrees, over pixels whose depths differ by at most `maxDepthDifference`.
double normalChange(const RenderedSurface& before, const RenderedSurface& after, double maxDepthDifference);

/// Mean angle between the errors of the normals of two pictures, degrees: motion of the reference surface is excluded.
double errorChange(const ReferenceSurface& referenceBefore, const RenderedSurface& before, const ReferenceSurface& referenceAfter,
                   const RenderedSurface& after);

}  // namespace rill::bench
