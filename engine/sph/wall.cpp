#include "sph/wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/fluid_records.h"

namespace rill {
namespace {

constexpr int kStepsPerSpacing = 16, kCornerStepsPerSpacing = 8;

/// Coordinates x_j - x_i along one axis.
using Offsets = std::vector<double>;

Offsets aligned(const SmoothingKernel& kernel) {
  const int reach = static_cast<int>(std::ceil(kernel.h() / kernel.spacing()));
  Offsets offsets;
  for (int i = -reach; i <= reach; ++i) offsets.push_back(i * kernel.spacing());
  return offsets;
}

void addGhosts(const SmoothingKernel& kernel, double s, double side, Offsets& offsets) {
  for (double at = std::max(s, 0.0) + kernel.spacing() / 2; at < kernel.h(); at += kernel.spacing()) offsets.push_back(side * at);
}

/// S over the product of three sets of coordinates. Only axes in `ghost` have a gradient; the others cancel by symmetry.
WallSample sumOver(const SmoothingKernel& kernel, const std::array<const Offsets*, 3>& axes, const std::array<bool, 3>& ghost) {
  WallSample sum;
  const double hh = kernel.h() * kernel.h();
  for (const double x : *axes[0]) {
    for (const double y : *axes[1]) {
      const double xy = x * x + y * y;
      if (xy >= hh) continue;
      for (const double z : *axes[2]) {
        if (xy + z * z >= hh) continue;
        const double r = std::sqrt(xy + z * z);
        const double g = kernel.gradientOverR(r);
        sum.value += kernel.value(r);
        if (ghost[0]) sum.gradient[0] -= g * x;
        if (ghost[1]) sum.gradient[1] -= g * y;
        if (ghost[2]) sum.gradient[2] -= g * z;
      }
    }
  }
  return sum;
}

/// S with the first `walls` axes behind a low wall at s[axis].
LineSample lowWalls(const SmoothingKernel& kernel, const Offsets& line, int walls, const Double3& s) {
  std::array<Offsets, 3> ghosts;
  std::array<const Offsets*, 3> axes = {&line, &line, &line};
  std::array<bool, 3> ghost = {};
  for (size_t a = 0; a < static_cast<size_t>(walls); ++a) {
    addGhosts(kernel, s[a], -1, ghosts[a]);
    axes[a] = &ghosts[a];
    ghost[a] = true;
  }
  const WallSample sum = sumOver(kernel, axes, ghost);
  return {sum.value, sum.gradient[0]};
}

/// Interpolation at a distance: nodes i and i + 1, weight t of the latter. `inside` is false beyond the table.
struct Interpolation {
  size_t i = 0;
  double t = 0;
  bool inside = false;
};

Interpolation interpolationAt(double s, double step, uint32_t nodes) {
  const double at = std::max(s, 0.0) / step;
  if (!(at < nodes - 1)) return {};
  const double node = std::floor(at);
  return {static_cast<size_t>(node), at - node, true};
}

LineSample sampleLine(const std::vector<float>& table, const Interpolation& p) {
  if (!p.inside) return {};
  const auto at = [&](size_t part) {
    const float* n = &table[2 * p.i + part];
    return n[0] * (1 - p.t) + n[2] * p.t;
  };
  return {at(0), at(1)};
}

}  // namespace

void WallSample::cover(double displaced, const Double3& direction) {
  double square = 0;
  for (int a = 0; a < 3; ++a) square += direction[a] * direction[a];
  if (square <= 0) return;
  for (int a = 0; a < 3; ++a) {
    wallCoverage[a] += displaced * (1 - direction[a] * direction[a] / square);
    wallCoverageMixed[a] -= displaced * direction[(a + 1) % 3] * direction[(a + 2) % 3] / square;
  }
}

WallScale wallScale(const WallSample& sample) {
  const Double3 &d = sample.wallCoverage, &m = sample.wallCoverageMixed;
  WallScale scale;
  if (m[0] == 0 && m[1] == 0 && m[2] == 0) {
    for (int a = 0; a < 3; ++a) scale.diagonal[a] = 1 / (1 - std::min<double>(d[a], kMaxWallCoverage));
    return scale;
  }
  // Largest eigenvalue of the coverage (Smith 1961).
  const double mean = (d[0] + d[1] + d[2]) / 3;
  double squares = 0;
  for (int a = 0; a < 3; ++a) squares += (d[a] - mean) * (d[a] - mean) + 2 * m[a] * m[a];
  const double size = std::sqrt(squares / 6), x = d[0] - mean, y = d[1] - mean, z = d[2] - mean;
  const double determinant = x * (y * z - m[0] * m[0]) - m[2] * (m[2] * z - m[0] * m[1]) + m[1] * (m[2] * m[0] - y * m[1]);
  const double largest =
      size > 0 ? mean + 2 * size * std::cos(std::acos(std::clamp(0.5 * determinant / (size * size * size), -1.0, 1.0)) / 3) : mean;
  const double bound = std::min(1.0, kMaxWallCoverage / largest);
  // The inverse of 1 - bound * coverage, by cofactors.
  Double3 p, q;
  for (int a = 0; a < 3; ++a) {
    p[a] = 1 - bound * d[a];
    q[a] = -bound * m[a];
  }
  const double whole = p[0] * (p[1] * p[2] - q[0] * q[0]) - q[2] * (q[2] * p[2] - q[0] * q[1]) + q[1] * (q[2] * q[0] - p[1] * q[1]);
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    scale.diagonal[a] = (p[b] * p[c] - q[a] * q[a]) / whole;
    scale.mixed[a] = (q[b] * q[c] - p[a] * q[a]) / whole;
  }
  return scale;
}

double wallReach(const SmoothingKernel& kernel) { return kernel.h() - kernel.spacing() / 2; }

WallSample exactWall(const SmoothingKernel& kernel, const Double3& lo, const Double3& hi) {
  std::array<Offsets, 3> ghosts;
  for (size_t a = 0; a < 3; ++a) {
    addGhosts(kernel, lo[a], -1, ghosts[a]);
    addGhosts(kernel, hi[a], +1, ghosts[a]);
  }
  WallSample sum;
  if (ghosts[0].empty() && ghosts[1].empty() && ghosts[2].empty()) return sum;
  const Offsets line = aligned(kernel);
  for (unsigned set = 1; set < 8; ++set) {
    std::array<const Offsets*, 3> axes;
    std::array<bool, 3> ghost;
    unsigned walls = 0;
    for (unsigned a = 0; a < 3; ++a) {
      ghost[a] = (set >> a) & 1u;
      axes[a] = ghost[a] ? &ghosts[a] : &line;
      walls += ghost[a];
    }
    const double sign = walls == 2 ? -1 : 1;
    const WallSample term = sumOver(kernel, axes, ghost);
    sum.value += sign * term.value;
    for (size_t a = 0; a < 3; ++a) {
      sum.gradient[a] += sign * term.gradient[a];
      if (!ghost[a]) sum.wallCoverage[a] += sign * term.value;
    }
  }
  return sum;
}

LineSample exactPlane(const SmoothingKernel& kernel, double s) {
  if (s >= wallReach(kernel)) return {};
  return lowWalls(kernel, aligned(kernel), 1, {s, 0, 0});
}

LineSample halfSpace(const SmoothingKernel& kernel, double s) {
  const double distance = std::abs(s), near = 1 - 2 * distance / kernel.spacing();
  LineSample f = exactPlane(kernel, distance);
  if (near > 0) {
    const double gap = 0.5 - exactPlane(kernel, 0).value;
    f.value += gap * near * near;
    f.slope -= gap * 4 * near / kernel.spacing();
  }
  if (s < 0) f.value = 1 - f.value;
  return f;
}

WallTables makeWallTables(const SmoothingKernel& kernel) {
  WallTables t;
  const double d = kernel.spacing();
  // Nodes up to the first at or beyond h - d/2, and a guard node.
  const auto count = [&](double step) { return static_cast<uint32_t>(std::ceil(wallReach(kernel) / step - 1e-9)) + 2; };
  t.step = d / kStepsPerSpacing;
  t.cornerStep = d / kCornerStepsPerSpacing;
  t.nodes = count(t.step);
  t.cornerNodes = count(t.cornerStep);
  const Offsets line = aligned(kernel);
  const auto push = [&](std::vector<float>& table, int walls, Double3 s) {
    const double reach = wallReach(kernel) * (1 - 1e-9);
    const bool beyond = s[0] >= reach || (walls > 1 && s[1] >= reach) || (walls > 2 && s[2] >= reach);
    const LineSample sum = beyond ? LineSample{} : lowWalls(kernel, line, walls, s);
    table.push_back(static_cast<float>(sum.value));
    table.push_back(static_cast<float>(sum.slope));
  };
  for (uint32_t i = 0; i < t.nodes; ++i) push(t.plane, 1, {i * t.step, 0, 0});
  for (uint32_t i = 0; i < t.nodes; ++i) {
    const LineSample f = i * t.step >= wallReach(kernel) * (1 - 1e-9) ? LineSample{} : halfSpace(kernel, i * t.step);
    t.face.push_back(static_cast<float>(f.value));
    t.face.push_back(static_cast<float>(f.slope));
  }
  for (uint32_t j = 0; j < t.nodes; ++j)
    for (uint32_t i = 0; i < t.nodes; ++i) push(t.edge, 2, {i * t.step, j * t.step, 0});
  for (uint32_t k = 0; k < t.cornerNodes; ++k)
    for (uint32_t j = 0; j < t.cornerNodes; ++j)
      for (uint32_t i = 0; i < t.cornerNodes; ++i) push(t.corner, 3, {i * t.cornerStep, j * t.cornerStep, k * t.cornerStep});
  return t;
}

LineSample WallTables::samplePlane(double s) const { return sampleLine(plane, interpolationAt(s, step, nodes)); }

LineSample WallTables::sampleFace(double s) const {
  LineSample f = sampleLine(face, interpolationAt(std::abs(s), step, nodes));
  if (s < 0) f.value = 1 - f.value;
  return f;
}

LineSample WallTables::sampleEdge(double s1, double s2) const {
  const Interpolation p = interpolationAt(s1, step, nodes), q = interpolationAt(s2, step, nodes);
  if (!p.inside || !q.inside) return {};
  const auto row = [&](size_t j, size_t part) {
    const float* n = &edge[2 * (j * nodes + p.i) + part];
    return n[0] * (1 - p.t) + n[2] * p.t;
  };
  const auto at = [&](size_t part) { return row(q.i, part) * (1 - q.t) + row(q.i + 1, part) * q.t; };
  return {at(0), at(1)};
}

LineSample WallTables::sampleCorner(double s1, double s2, double s3) const {
  const Interpolation p = interpolationAt(s1, cornerStep, cornerNodes), q = interpolationAt(s2, cornerStep, cornerNodes),
                      o = interpolationAt(s3, cornerStep, cornerNodes);
  if (!p.inside || !q.inside || !o.inside) return {};
  const auto row = [&](size_t k, size_t j, size_t part) {
    const float* n = &corner[2 * ((k * cornerNodes + j) * cornerNodes + p.i) + part];
    return n[0] * (1 - p.t) + n[2] * p.t;
  };
  const auto layer = [&](size_t k, size_t part) { return row(k, q.i, part) * (1 - q.t) + row(k, q.i + 1, part) * q.t; };
  const auto at = [&](size_t part) { return layer(o.i, part) * (1 - o.t) + layer(o.i + 1, part) * o.t; };
  return {at(0), at(1)};
}

WallSample WallTables::sample(const Double3& lo, const Double3& hi) const {
  struct Wall {
    double s, side;  // side: d s / d x
  };
  std::array<std::vector<Wall>, 3> walls;
  const double reach = step * (nodes - 1);
  for (size_t a = 0; a < 3; ++a) {
    if (lo[a] < reach) walls[a].push_back({lo[a], 1});
    if (hi[a] < reach) walls[a].push_back({hi[a], -1});
  }
  WallSample sum;
  for (size_t a = 0; a < 3; ++a) {
    const size_t b = (a + 1) % 3, c = (a + 2) % 3;
    for (const Wall& w : walls[a]) {
      const LineSample one = samplePlane(w.s);
      sum.value += one.value;
      sum.gradient[a] += w.side * one.slope;
      sum.wallCoverage[b] += one.value;
      sum.wallCoverage[c] += one.value;
      for (const Wall& v : walls[b]) {
        const LineSample byFirst = sampleEdge(w.s, v.s);
        sum.value -= byFirst.value;
        sum.wallCoverage[c] -= byFirst.value;
        sum.gradient[a] -= w.side * byFirst.slope;
        sum.gradient[b] -= v.side * sampleEdge(v.s, w.s).slope;
        for (const Wall& u : walls[c]) {
          // Each triple occurs once per axis: every occurrence adds the slope of its axis, the first also the value.
          const LineSample three = sampleCorner(w.s, v.s, u.s);
          if (a == 0) sum.value += three.value;
          sum.gradient[a] += w.side * three.slope;
        }
      }
    }
  }
  return sum;
}

}  // namespace rill
