// The planes through the particles of a surface: their fits, and where rays meet them.
#include <algorithm>

#include "render/surface_reference.hpp"

namespace rill::test {
namespace {

/// Eigenvalues of a symmetric matrix, rising, and the direction of the least: by Jacobi rotations.
void eigen(double m[3][3], double values[3], Vector& least) {
  double turned[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 50; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(m[p][q]) < 1e-300) continue;
        const double theta = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]), c = std::cos(theta), s = std::sin(theta);
        for (int k = 0; k < 3; ++k) {
          const double a = m[k][p], b = m[k][q];
          m[k][p] = c * a - s * b;
          m[k][q] = s * a + c * b;
        }
        for (int k = 0; k < 3; ++k) {
          const double a = m[p][k], b = m[q][k];
          m[p][k] = c * a - s * b;
          m[q][k] = s * a + c * b;
        }
        for (auto& row : turned) {
          const double a = row[p], b = row[q];
          row[p] = c * a - s * b;
          row[q] = s * a + c * b;
        }
      }
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int a, int b) { return m[a][a] < m[b][b]; });
  for (int k = 0; k < 3; ++k) values[k] = m[order[k]][order[k]];
  least = {turned[0][order[0]], turned[1][order[0]], turned[2][order[0]]};
}

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

/// Principal directions of what lies within reach, weighted by (1 - distance^2)^2; `across`: a normal, from whose plane others count to 0.9
/// spacings.
SurfaceReference::Fit SurfaceReference::fit(const std::vector<Vector>& centers, const Vector& own, double reach,
                                            const Vector* across) const {
  Fit out;
  double square[3][3] = {};
  for (const Vector& other : centers) {
    const Vector q = (other - own) * (1 / reach);
    double w = std::pow(std::max(1 - dot(q, q), 0.0), 2);
    if (across) w *= std::pow(std::max(1 - std::pow(dot(q, *across) * double{samples_.push.smoothing} / 0.9, 2), 0.0), 2);
    out.sum += w;
    out.mean = out.mean + q * w;
    const double v[3] = {q.x, q.y, q.z};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) square[i][j] += w * v[i] * v[j];
  }
  out.mean = out.mean * (1 / out.sum);
  const double m[3] = {out.mean.x, out.mean.y, out.mean.z};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) square[i][j] = square[i][j] / out.sum - m[i] * m[j];
  eigen(square, out.values, out.least);
  return out;
}

SurfaceReference::Plane SurfaceReference::plane(const std::vector<Vector>& centers, const Vector& own) const {
  const double reach = double{samples_.push.smoothing} * spacingAt(own.z);
  const Vector towards = samples_.push.perspective > 0 ? unit(own) : Vector{0, 0, 1};
  if (own.z - 0.5 * double{samples_.push.spacing} <= double{samples_.push.near_depth}) return {own, own, {}, true};
  Fit found = fit(centers, own, reach, nullptr);
  Vector normal = found.least;
  if (dot(normal, towards) > 0) normal = normal * -1;
  if (found.values[0] > 0.04 * found.values[1]) {
    normal = unit(normal - towards * 0.4);
    for (int turn = 0; turn < 2; ++turn) {
      found = fit(centers, own, reach, &normal);
      normal = found.least;
    }
  }
  if (dot(normal, towards) > 0) normal = normal * -1;
  if (found.sum - 1 < 1.5 || found.values[0] > 0.6 * found.values[1]) return {own, own, {}, true};
  return {own, own + normal * (dot(found.mean, normal) * reach + 0.5 * double{samples_.push.spacing}), normal, false};
}

SurfaceReference::Evaluation SurfaceReference::evaluateStep(const Samples::Ray& ray, double depth) const {
  const double spacing = spacingAt(depth), range = 1.2 * spacing;
  const Vector x = ray.at(depth), sight = unit(ray.along);
  double height = 0, slope = 0, cover = 0, sum = 0, planeWeight = 0;
  Vector normal;
  for (const Plane& plane : planes_) {
    Vector d = x - plane.anchor, n = plane.normal;
    if (plane.ball) {
      n = d * (1 / std::max(std::sqrt(dot(d, d)), 1e-3 * spacing));
      d = d - n * (0.5 * spacing);
    }
    const double h = dot(d, n), across = std::max(1 - (dot(d, d) - h * h) / std::pow(1.8 * spacing, 2), 0.0);
    const double within = std::max(1 - h * h / (range * range), 0.0), w = std::pow(across, 3) * within * within;
    sum += w;
    planeWeight += plane.ball ? -w : w;
    height += w * h;
    slope += w * dot(ray.along, n);
    normal = normal + n * w;
    if (within <= 0) continue;
    const Vector to = plane.center - ray.from, miss = to - ray.along * (dot(to, ray.along) / dot(ray.along, ray.along));
    const double beside = std::max(1 - dot(miss, miss) / std::pow(1.2 * spacing, 2), 0.0);
    cover += beside * beside * std::max(std::abs(dot(n, sight)), 0.35);
  }
  Evaluation out;
  const double threshold = 0.6 + (0.4 - 0.6) * smoothstep(1.5, 2.8, sum), pixel = samples_.side(depth) / samples_.push.step;
  out.coverage = std::clamp(0.5 + (cover - threshold) * spacing / (1.25 * pixel), 0.0, 1.0);
  out.planeWeight = planeWeight;
  out.depth = depth + (slope < -1e-6 ? std::clamp(-height / slope, -range, range) : 0);
  const double size = std::sqrt(dot(normal, normal));
  out.normal = size > 1e-6 ? normal * (1 / size) : sight * -1;
  return out;
}

/// Refined at most twice, while planes outweigh balls and the depth moves by more than a quarter of a spacing.
SurfaceReference::Evaluation SurfaceReference::evaluate(const Samples::Ray& ray, double depth) const {
  const double still = 0.25 * spacingAt(depth);
  Evaluation out = evaluateStep(ray, depth);
  if (depth <= samples_.nearest()) {  // section with the near plane
    out.depth = depth;
    out.normal = unit(ray.along) * -1;
    return out;
  }
  for (int turn = 0; turn < 2 && out.planeWeight > 0.5 && std::abs(out.depth - depth) > still; ++turn) {
    const Evaluation next = evaluateStep(ray, out.depth);
    if (next.planeWeight <= 0.5) break;
    depth = out.depth;
    out.depth = next.depth;
    out.normal = next.normal;
  }
  out.depth = std::max(out.depth, samples_.nearest());
  return out;
}

}  // namespace rill::test
