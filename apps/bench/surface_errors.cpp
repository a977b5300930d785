#include "bench/surface_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rill::bench {
namespace {

constexpr double kEdgeWidth = 1.5;  // spacings
constexpr double kDepthStep = 4;    // spacings: smallest step in depth that is an edge

double angleDegrees(const Double3& a, const Double3& b) {
  return std::acos(std::clamp(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1.0, 1.0)) * 180 / std::numbers::pi;
}

double meanOf(double sum, double count) { return sum / std::max(count, 1.0); }

/// Applies to `n` the minimal rotation that maps `from` to (0, 0, -1).
Double3 rotated(const Double3& n, const Double3& from) {
  const double axis[2] = {-from[1], from[0]};  // cross product of `from` and (0, 0, -1); its z is 0
  const Double3 cross = {axis[1] * n[2], -axis[0] * n[2], axis[0] * n[1] - axis[1] * n[0]};
  const Double3 twice = {axis[1] * cross[2], -axis[0] * cross[2], axis[0] * cross[1] - axis[1] * cross[0]};
  const double scale = 1 / (1 - from[2]);  // 1 / (1 + cosine); visible surfaces face the eye
  return {n[0] + cross[0] + scale * twice[0], n[1] + cross[1] + scale * twice[1], n[2] + cross[2] + scale * twice[2]};
}

}  // namespace

ReferenceSurface referenceSurface(const Shape& shape, const Eye& eye) {
  const size_t width = eye.width, height = eye.height;
  ReferenceSurface out;
  out.points.resize(width * height);
  out.regions.resize(width * height, ReferenceSurface::Region::Outside);
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x) {
      const double across = ((double(x) + 0.5) / double(width) * 2 - 1) * eye.tanHalfFovX,
                   up = (1 - (double(y) + 0.5) / double(height) * 2) * eye.tanHalfFovY;
      if (shape.intersect(across, up, out.points[y * width + x])) out.regions[y * width + x] = ReferenceSurface::Region::Interior;
    }
  const size_t band = std::max(size_t{1}, static_cast<size_t>(kEdgeWidth * double(height) / (2 * eye.tanHalfFovY * eye.distance)));
  const auto edge = [&](size_t i, size_t j) {
    return out.regions[j] == ReferenceSurface::Region::Outside || std::abs(out.points[j].depth - out.points[i].depth) > kDepthStep;
  };
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x) {
      const size_t i = y * width + x;
      if (out.regions[i] == ReferenceSurface::Region::Outside) continue;
      if ((x >= band && edge(i, i - band)) || (x + band < width && edge(i, i + band)) || (y >= band && edge(i, i - band * width)) ||
          (y + band < height && edge(i, i + band * width)))
        out.regions[i] = ReferenceSurface::Region::Edge;
    }
  return out;
}

Errors surfaceErrors(const ReferenceSurface& surface, const RenderedSurface& rendered) {
  using enum ReferenceSurface::Region;
  std::vector<double> inside;
  double sum = 0, square = 0, edgeSum = 0, edges = 0, both = 0, either = 0;
  for (size_t i = 0; i < rendered.depth.size(); ++i) {
    const bool found = std::isfinite(rendered.depth[i]), expected = surface.regions[i] != Outside;
    both += found && expected;
    either += found || expected;
    if (!found || !expected) continue;
    const double error = angleDegrees(rendered.normal[i], surface.points[i].normal);
    if (surface.regions[i] == Edge) {
      edgeSum += error;
      ++edges;
      continue;
    }
    inside.push_back(error);
    sum += error;
    square += std::pow(rendered.depth[i] - surface.points[i].depth, 2);
  }
  Errors e;
  const double count = double(inside.size());
  e.mean = meanOf(sum, count);
  e.depth = std::sqrt(meanOf(square, count));
  e.edge = meanOf(edgeSum, edges);
  e.iou = meanOf(both, either);
  if (!inside.empty()) {
    const auto percentile = inside.begin() + static_cast<std::ptrdiff_t>(0.95 * (count - 1));
    std::nth_element(inside.begin(), percentile, inside.end());
    e.p95 = *percentile;
  }
  return e;
}

double normalChange(const RenderedSurface& before, const RenderedSurface& after, double maxDepthDifference) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < before.depth.size(); ++i) {
    if (!std::isfinite(before.depth[i]) || !(std::abs(before.depth[i] - after.depth[i]) <= maxDepthDifference)) continue;
    sum += angleDegrees(before.normal[i], after.normal[i]);
    ++count;
  }
  return meanOf(sum, count);
}

double errorChange(const ReferenceSurface& referenceBefore, const RenderedSurface& before, const ReferenceSurface& referenceAfter,
                   const RenderedSurface& after) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < before.depth.size(); ++i) {
    if (referenceBefore.regions[i] != ReferenceSurface::Region::Interior || referenceAfter.regions[i] != ReferenceSurface::Region::Interior)
      continue;
    if (!std::isfinite(before.depth[i]) || !std::isfinite(after.depth[i])) continue;
    const auto a = rotated(before.normal[i], referenceBefore.points[i].normal),
               b = rotated(after.normal[i], referenceAfter.points[i].normal);
    sum += angleDegrees(a, b);
    ++count;
  }
  return meanOf(sum, count);
}

}  // namespace rill::bench
