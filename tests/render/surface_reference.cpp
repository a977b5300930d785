#include "render/surface_reference.hpp"

#include <algorithm>
#include <cmath>

namespace rill::test {

Samples::Samples(const surface::SurfacePush& camera)
    : push(camera),
      columns(int((push.width + push.step - 1) / push.step + 2 * push.margin)),
      rows(int((push.height + push.step - 1) / push.step + 2 * push.margin)) {}

Vector Samples::seen(const Float4& p) const {
  double v[3];
  for (int r = 0; r < 3; ++r) {
    const float* row = push.rows + 4 * r;
    v[r] = double{row[0]} * double{p.x} + double{row[1]} * double{p.y} + double{row[2]} * double{p.z} + double{row[3]};
  }
  return {v[0], v[1], v[2]};
}

Samples::Ray Samples::ray(double x, double y) const {
  const auto axis = [&](double at, uint32_t pixels, int a) {
    return (at / pixels * 2 - 1 - double{push.shift[a]}) * double{push.scale[a]};
  };
  const Vector across{axis(x, push.width, 0), axis(y, push.height, 1), 0};
  if (push.perspective > 0) return {{0, 0, 0}, across + Vector{0, 0, 1}};
  return {across, {0, 0, 1}};
}

double Samples::side(double depth) const {
  return std::abs(double{push.scale[1]}) * 2 / push.height * push.step * (push.perspective > 0 ? depth : 1);
}

double Samples::nearest() const { return double{push.near_depth} * 1.000001 + 1e-6 * double{push.spacing}; }

SurfaceReference::SurfaceReference(const surface::SurfacePush& push, const std::vector<Float4>& positions, By by)
    : samples_(push), by_(by) {
  std::vector<Vector> centers;
  for (const Float4& p : positions) {
    const Vector center = samples_.seen(p);
    if (center.z + hardRadius(center.z) > double{push.near_depth}) centers.push_back(center);
  }
  hard_.assign(size_t(samples_.columns) * size_t(samples_.rows), kNone);
  for (int y = 0; y < samples_.rows; ++y)
    for (int x = 0; x < samples_.columns; ++x)
      for (const Vector& center : centers) {
        const double t = sphere(center, hardRadius(center.z), samples_.ray(x, y));
        if (t >= 0) hard_[samples_.index(x, y)] = std::min(hard_[samples_.index(x, y)], t);
      }
  centers_ = picked(centers);
  if (by == By::Planes)
    for (const Vector& own : centers_) planes_.push_back(plane(centers_, own));
  smooth_.resize(hard_.size());
  for (int y = 0; y < samples_.rows; ++y)
    for (int x = 0; x < samples_.columns; ++x) {
      const double hard = hard_[samples_.index(x, y)];
      if (hard == kNone) continue;
      if (by == By::Depth) {
        if (cover(samples_.ray(x, y), hard) >= 0.5 || closed(x, y)) smooth_[samples_.index(x, y)] = sampleOfDepth(x, y);
        continue;
      }
      const Evaluation found = evaluate(samples_.ray(x, y), hard);
      if (found.coverage >= 0.5 || closed(x, y)) smooth_[samples_.index(x, y)] = {found.depth, found.normal};
    }
}

double SurfaceReference::spacingAt(double z) const { return std::max(double{samples_.push.spacing}, 1.2 * samples_.side(z)); }
double SurfaceReference::hardRadius(double z) const { return std::max(double{samples_.push.radius}, 0.71 * samples_.side(z)); }

double SurfaceReference::sphere(const Vector& center, double radius, const Samples::Ray& ray) const {
  const Vector to = center - ray.from;
  const double a = dot(ray.along, ray.along), b = dot(to, ray.along), c = dot(to, to) - radius * radius;
  if (b * b - a * c <= 0) return -1;
  const double half = std::sqrt(b * b - a * c) / a;
  return b / a + half > samples_.nearest() ? std::max(b / a - half, samples_.nearest()) : -1;
}

/// Particles visible in at least 3 % of the samples that they cover.
std::vector<Vector> SurfaceReference::picked(const std::vector<Vector>& centers) const {
  std::vector<Vector> out;
  for (const Vector& center : centers) {
    int inside = 0, owned = 0;
    for (int y = 0; y < samples_.rows; ++y)
      for (int x = 0; x < samples_.columns; ++x) {
        const double t = sphere(center, hardRadius(center.z), samples_.ray(x, y));
        if (t < 0) continue;
        ++inside;
        owned += t <= hard_[samples_.index(x, y)] + 1e-3 * double{samples_.push.spacing};
      }
    if (owned > 0 && owned >= 0.03 * inside) out.push_back(center);
  }
  return out;
}

bool SurfaceReference::closed(int x, int y) const {
  for (int v = y - 2; v <= y + 2; ++v)
    for (int u = x - 2; u <= x + 2; ++u)
      if (samples_.has(u, v) && hard_[samples_.index(u, v)] == kNone) return false;
  return true;
}

/// Share of the square of 2.5 samples to each side that spheres cover.
double SurfaceReference::share(double x, double y) const {
  const int left = int(std::floor(x)), top = int(std::floor(y));
  if (!samples_.has(left - 2, top - 2) || !samples_.has(left + 3, top + 3)) return 0;
  double covered = 0;
  for (int v = top - 2; v <= top + 3; ++v)
    for (int u = left - 2; u <= left + 3; ++u) {
      const double wx = std::min(1.0, 3 - std::abs(u - x)), wy = std::min(1.0, 3 - std::abs(v - y));
      if (hard_[samples_.index(u, v)] != kNone) covered += wx * wy;
    }
  return covered / 25;
}

/// A pixel's coverage from the centers that lie up to 1.6 spacings nearer or farther.
double SurfaceReference::cover(const Samples::Ray& ray, double depth) const {
  const double spacing = spacingAt(depth);
  double sum = 0;
  for (const Vector& center : centers_) {
    if (std::abs(center.z - depth) > 1.6 * spacing) continue;
    const Vector to = center - ray.from, miss = to - ray.along * (dot(to, ray.along) / dot(ray.along, ray.along));
    sum += std::pow(std::max(1 - dot(miss, miss) / std::pow(1.2 * spacing, 2), 0.0), 2);
  }
  return std::clamp(0.5 + (sum - 0.7) * spacing / (1.25 * samples_.side(depth) / samples_.push.step), 0.0, 1.0);
}

/// From a sample to the next in a direction: over both of its neighbors where they bend by less than half a spacing, else to the one
/// nearer in depth.
Vector SurfaceReference::difference(int x, int y, int dx, int dy) const {
  const auto depth = [&](int u, int v) { return samples_.has(u, v) ? hard_[samples_.index(u, v)] : kNone; };
  const auto point = [&](int u, int v) { return samples_.ray(u, v).at(depth(u, v)); };
  const bool before = depth(x - dx, y - dy) != kNone, after = depth(x + dx, y + dy) != kNone;
  const Vector own = point(x, y), back = before ? own - point(x - dx, y - dy) : Vector{},
               on = after ? point(x + dx, y + dy) - own : Vector{};
  if (before && after) {
    if (std::abs(back.z - on.z) < 0.5 * double{samples_.push.spacing}) return back + on;
    return std::abs(back.z) < std::abs(on.z) ? back : on;
  }
  if (before) return back;
  if (after) return on;
  return Vector{double(dx), double(dy), 0} * samples_.side(own.z);
}

SurfaceReference::Place SurfaceReference::sampleOfDepth(int x, int y) const {
  const Vector a = difference(x, y, 1, 0), b = difference(x, y, 0, 1);
  const Samples::Ray ray = samples_.ray(x, y);
  const double depth = hard_[samples_.index(x, y)];
  if (depth <= samples_.nearest()) return {depth, unit(ray.along) * -1};  // section with the near plane
  const Vector towards = samples_.push.perspective > 0 ? ray.at(depth) : Vector{0, 0, 1};
  Vector normal{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  normal = dot(normal, normal) > 0 ? unit(normal) : unit(towards) * -1;
  if (dot(normal, towards) > 0) normal = normal * -1;
  // The spheres lie three tenths of a spacing above the surface, along its normal.
  const double inset = std::min(0.3 / std::max(-dot(ray.along, normal), 0.1), 0.9) * double{samples_.push.spacing};
  return {std::max(depth + inset, samples_.nearest()), normal};
}

SurfaceReference::Evaluation SurfaceReference::evaluateByPlanes(const Samples::Ray& ray, double nearest, double farthest, double own,
                                                                double filled) const {
  Evaluation found = evaluate(ray, nearest);
  double coverage = found.coverage;
  if (coverage < 1 && farthest > nearest + 0.5 * double{samples_.push.spacing}) {
    const Evaluation behind = evaluate(ray, farthest);
    if (coverage < 0.5) found = behind;
    coverage = std::max(coverage, behind.coverage) >= 0.5 ? 1 : behind.coverage;
  }
  if (coverage < 0.5 && filled > coverage) found = evaluate(ray, std::isfinite(own) ? own : nearest);
  found.coverage = std::max(coverage, filled);
  return found;
}

/// On the plane of the nearest of the four samples; a spacing of depth counts as two samples.
SurfaceReference::Evaluation SurfaceReference::evaluateByDepth(const Samples::Ray& ray, double nearest, double farthest,
                                                               const Corner (&corners)[4], double filled) const {
  const double spacing = double{samples_.push.spacing};
  Evaluation found;
  double hard = nearest, best = kNone;
  found.coverage = cover(ray, nearest);
  if (found.coverage < 1 && farthest > nearest + 0.5 * spacing) {
    const double behind = cover(ray, farthest);
    if (found.coverage < 0.5) hard = farthest;
    found.coverage = std::max(found.coverage, behind) >= 0.5 ? 1 : behind;
  }
  found.coverage = std::max(found.coverage, filled);
  for (const Corner& corner : corners) {
    const double badness = corner.square + 4 * std::abs(corner.place.depth - hard) / spacing;
    if (corner.place.depth == kNone || badness >= best) continue;
    best = badness;
    found.normal = corner.place.normal;
    const double slope = dot(ray.along, found.normal), height = dot(corner.point - ray.from, found.normal), depth = corner.place.depth;
    found.depth =
        slope < -0.05 * std::sqrt(dot(ray.along, ray.along)) ? std::clamp(height / slope, depth - spacing, depth + spacing) : depth;
  }
  return found;
}

SurfaceReference::Pixel SurfaceReference::pixel(uint32_t x, uint32_t y) const {
  const surface::SurfacePush& push = samples_.push;
  const double spacing = double{push.spacing}, atX = (x + 0.5) / push.step - 0.5 + push.margin,
               atY = (y + 0.5) / push.step - 0.5 + push.margin;
  const int left = int(std::floor(atX)), top = int(std::floor(atY));
  Corner corners[4];
  bool agree = true;
  for (int k = 0; k < 4; ++k) {
    const int u = std::clamp(left + (k & 1), 0, samples_.columns - 1), v = std::clamp(top + (k >> 1), 0, samples_.rows - 1);
    const double offX = std::abs(atX - left - (k & 1)), offY = std::abs(atY - top - (k >> 1));
    const Place place = smooth_[samples_.index(u, v)];
    const bool there = place.depth != kNone;
    agree = agree && there;
    corners[k] = {place, there ? samples_.ray(u, v).at(place.depth) : Vector{}, (1 - offX) * (1 - offY), offX * offX + offY * offY};
  }
  for (int k = 1; k < 4 && agree; ++k) {
    const Vector d = corners[k].point - corners[0].point;
    agree = std::abs(dot(d, corners[0].place.normal)) < 0.35 * spacing && std::abs(dot(d, corners[k].place.normal)) < 0.35 * spacing;
  }
  if (agree) {
    double sum = 0;
    Vector normal;
    for (const Corner& corner : corners) {
      sum += corner.weight * (push.perspective > 0 ? 1 / corner.place.depth : corner.place.depth);
      normal = normal + corner.place.normal * corner.weight;
    }
    return {{push.perspective > 0 ? 1 / sum : sum, unit(normal)}, 1};
  }
  const int ownX = int(x / push.step + push.margin), ownY = int(y / push.step + push.margin);
  double nearest = kNone, farthest = 0;
  for (int v = ownY - 1; v <= ownY + 1; ++v)
    for (int u = ownX - 1; u <= ownX + 1; ++u) {
      const double hard = samples_.has(u, v) ? hard_[samples_.index(u, v)] : kNone;
      if (hard == kNone) continue;
      nearest = std::min(nearest, hard);
      farthest = std::max(farthest, hard);
    }
  if (nearest == kNone) return {};
  const Samples::Ray ray = samples_.ray(x + 0.5, y + 0.5);
  const double filled = std::clamp(0.5 + (share(atX, atY) - 0.9683) * std::max(5.0 * push.step, 0.5 / (1 - 0.9683)), 0.0, 1.0);
  const Evaluation found = by_ == By::Planes ? evaluateByPlanes(ray, nearest, farthest, hard_[samples_.index(ownX, ownY)], filled)
                                             : evaluateByDepth(ray, nearest, farthest, corners, filled);
  if (found.depth == kNone) return {};
  return {{std::max(found.depth, samples_.nearest()), found.normal}, found.coverage};
}

}  // namespace rill::test
