#include "bench/surface_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rill::bench {
namespace {

constexpr double kBand = 1.5;  // spacings: what belongs to an edge
constexpr double kJump = 4;    // spacings of depth between its sides

double angle(const double* a, const double* b) {
  return std::acos(std::clamp(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1.0, 1.0)) * 180 / std::numbers::pi;
}

double over(double sum, double count) { return sum / std::max(count, 1.0); }

/// `n` turned as `from` has to be turned, the shortest way, to look at the eye.
std::array<double, 3> turned(const std::array<double, 3>& n, const double* from) {
  const double axis[2] = {-from[1], from[0]};  // from x (0, 0, -1): its z is 0
  const double cross[3] = {axis[1] * n[2], -axis[0] * n[2], axis[0] * n[1] - axis[1] * n[0]};
  const double twice[3] = {axis[1] * cross[2], -axis[0] * cross[2], axis[0] * cross[1] - axis[1] * cross[0]};
  const double share = 1 / (1 - from[2]);  // 1 + the cosine; no visible surface looks straight away
  return {n[0] + cross[0] + share * twice[0], n[1] + cross[1] + share * twice[1], n[2] + cross[2] + share * twice[2]};
}

}  // namespace

TrueSurface trueSurface(const Shape& shape, const Eye& eye) {
  const size_t width = eye.width, height = eye.height;
  TrueSurface out;
  out.truth.resize(width * height);
  out.where.resize(width * height, TrueSurface::Where::Nowhere);
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x) {
      const double across = ((double(x) + 0.5) / double(width) * 2 - 1) * eye.tangentX,
                   up = (1 - (double(y) + 0.5) / double(height) * 2) * eye.tangentY;
      if (shape.hit(across, up, out.truth[y * width + x])) out.where[y * width + x] = TrueSurface::Where::Inside;
    }
  const size_t band = std::max(size_t{1}, static_cast<size_t>(kBand * double(height) / (2 * eye.tangentY * eye.distance)));
  const auto edge = [&](size_t i, size_t j) {
    return out.where[j] == TrueSurface::Where::Nowhere || std::abs(out.truth[j].depth - out.truth[i].depth) > kJump;
  };
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x) {
      const size_t i = y * width + x;
      if (out.where[i] == TrueSurface::Where::Nowhere) continue;
      if ((x >= band && edge(i, i - band)) || (x + band < width && edge(i, i + band)) || (y >= band && edge(i, i - band * width)) ||
          (y + band < height && edge(i, i + band * width)))
        out.where[i] = TrueSurface::Where::Edge;
    }
  return out;
}

Errors surfaceErrors(const TrueSurface& surface, const Drawn& drawn) {
  using enum TrueSurface::Where;
  std::vector<double> inside;
  double sum = 0, square = 0, edgeSum = 0, edges = 0, both = 0, either = 0;
  for (size_t i = 0; i < drawn.depth.size(); ++i) {
    const bool there = std::isfinite(drawn.depth[i]), hit = surface.where[i] != Nowhere;
    both += there && hit;
    either += there || hit;
    if (!there || !hit) continue;
    const double off = angle(drawn.normal[i].data(), surface.truth[i].normal);
    if (surface.where[i] == Edge) {
      edgeSum += off;
      ++edges;
      continue;
    }
    inside.push_back(off);
    sum += off;
    square += std::pow(drawn.depth[i] - surface.truth[i].depth, 2);
  }
  Errors e;
  const double count = double(inside.size());
  e.mean = over(sum, count);
  e.depth = std::sqrt(over(square, count));
  e.edge = over(edgeSum, edges);
  e.overlap = over(both, either);
  if (!inside.empty()) {
    const auto place = inside.begin() + static_cast<std::ptrdiff_t>(0.95 * (count - 1));
    std::nth_element(inside.begin(), place, inside.end());
    e.p95 = *place;
  }
  return e;
}

double normalChange(const Drawn& before, const Drawn& after, double nearby) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < before.depth.size(); ++i) {
    if (!std::isfinite(before.depth[i]) || !(std::abs(before.depth[i] - after.depth[i]) <= nearby)) continue;
    sum += angle(before.normal[i].data(), after.normal[i].data());
    ++count;
  }
  return over(sum, count);
}

double errorChange(const TrueSurface& trueBefore, const Drawn& before, const TrueSurface& trueAfter, const Drawn& after) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < before.depth.size(); ++i) {
    if (trueBefore.where[i] != TrueSurface::Where::Inside || trueAfter.where[i] != TrueSurface::Where::Inside) continue;
    if (!std::isfinite(before.depth[i]) || !std::isfinite(after.depth[i])) continue;
    const auto a = turned(before.normal[i], trueBefore.truth[i].normal), b = turned(after.normal[i], trueAfter.truth[i].normal);
    sum += angle(a.data(), b.data());
    ++count;
  }
  return over(sum, count);
}

}  // namespace rill::bench
