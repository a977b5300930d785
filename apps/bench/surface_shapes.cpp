#include "bench/surface_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace rill::bench {
namespace {

constexpr int kLayers = 3;           // of particles, as many as a renderer can see
constexpr double kSteepness = 0.05;  // amplitude of a wave / wavelength
constexpr double kTilt = 1.2;        // slope of a surface seen at 50 degrees

/// A surface whose depth depends on x only: a tilted plane or waves. Particles of a traveling wave oscillate, they do not drift.
class HeightField : public Shape {
 public:
  HeightField(std::string name, double distance, double tanHalfFovX, double tanHalfFovY, double slope, double amplitude, double length,
              double traveled = 0)
      : name_(std::move(name)),
        distance_(distance),
        tanHalfFovX_(tanHalfFovX),
        tanHalfFovY_(tanHalfFovY),
        slope_(slope),
        amplitude_(amplitude),
        wave_(2 * std::numbers::pi / length),
        traveled_(traveled) {}

  std::string name() const override { return name_; }

  bool intersect(double x, double /*y*/, ReferencePoint& reference) const override {
    double t = distance_;
    for (int k = 0; k < 40; ++k) {
      const double step = (t - depth(t * x)) / std::max(1 - slopeAt(t * x) * x, 0.2);
      t -= step;
      if (std::abs(step) < 1e-12 * distance_) break;
    }
    const double r = slopeAt(t * x), size = std::sqrt(1 + r * r);
    reference = {t, {r / size, 0, -1 / size}};
    return true;
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> tangential(-jitter.tangential, jitter.tangential), normal(-jitter.normal, jitter.normal);
    std::vector<Float3> out;
    const double farthest = 1.3 * distance_ / std::max(1 - std::abs(slope_) * tanHalfFovX_, 0.3);
    const double width = farthest * tanHalfFovX_ + 4, height = farthest * tanHalfFovY_ + 4;
    for (int layer = 0; layer < kLayers; ++layer)
      for (double x = -width; x < width;) {
        const double r = slopeAtRest(x), size = std::sqrt(1 + r * r);  // of the wave at rest: every displacement has the same particles
        for (double y = -height; y < height; y += 1) {
          const double u = tangential(random), h = layer + 0.5 + normal(random);
          const double at = x + u / size;
          const double ra = slopeAt(at), sa = std::sqrt(1 + ra * ra);
          out.push_back({float(at - h * ra / sa), float(y + tangential(random)), float(depth(at) + h / sa)});
        }
        x += 1 / size;
      }
    return out;
  }

 private:
  double depth(double x) const { return distance_ + slope_ * x + amplitude_ * std::sin(wave_ * (x - traveled_)); }
  double slopeAt(double x) const { return slopeAtRest(x - traveled_); }
  double slopeAtRest(double x) const { return slope_ + amplitude_ * wave_ * std::cos(wave_ * x); }

  std::string name_;
  double distance_, tanHalfFovX_, tanHalfFovY_, slope_, amplitude_, wave_, traveled_;
};

class Balls : public Shape {
 public:
  struct Ball {
    double x, y, z, radius;
  };
  explicit Balls(std::vector<Ball> balls) : balls_(std::move(balls)) {}

  std::string name() const override { return "balls"; }

  bool intersect(double x, double y, ReferencePoint& reference) const override {
    bool any = false;
    for (const Ball& ball : balls_) {
      const double a = x * x + y * y + 1, b = ball.x * x + ball.y * y + ball.z;
      const double c = ball.x * ball.x + ball.y * ball.y + ball.z * ball.z - ball.radius * ball.radius, under = b * b - a * c;
      if (under <= 0) continue;
      const double t = (b - std::sqrt(under)) / a;
      if (any && t >= reference.depth) continue;
      any = true;
      reference = {t, {(t * x - ball.x) / ball.radius, (t * y - ball.y) / ball.radius, (t - ball.z) / ball.radius}};
    }
    return any;
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> tangential(-jitter.tangential, jitter.tangential), normal(-jitter.normal, jitter.normal);
    std::vector<Float3> out;
    for (const Ball& ball : balls_)
      for (int layer = 0; layer < kLayers; ++layer) {
        const double r = ball.radius - layer - 0.5;
        const int count = std::max(1, static_cast<int>(4 * std::numbers::pi * r * r));
        for (int k = 0; k < count; ++k) {  // Fibonacci sphere: points of equal area
          const double up = 1 - (2 * k + 1.0) / count, s = std::sqrt(1 - up * up), angle = 2.399963229728653 * k;
          const double n[3] = {s * std::cos(angle), s * std::sin(angle), up};
          const double h = r + normal(random), u = tangential(random), v = tangential(random);
          const double a[3] = {-n[1] / s, n[0] / s, 0}, b[3] = {-n[2] * a[1], n[2] * a[0], n[0] * a[1] - n[1] * a[0]};
          out.push_back({float(ball.x + h * n[0] + u * a[0] + v * b[0]), float(ball.y + h * n[1] + u * a[1] + v * b[1]),
                         float(ball.z + h * n[2] + u * a[2] + v * b[2])});
        }
      }
    return out;
  }

 private:
  std::vector<Ball> balls_;
};

/// The corner of a box that points at the eye: three orthogonal faces that extend `reach` from the corner.
class Corner : public Shape {
 public:
  Corner(double distance, double reach) : tip_(distance), reach_(reach) {}

  std::string name() const override { return "corner"; }

  bool intersect(double x, double y, ReferencePoint& reference) const override {
    reference.depth = 0;
    for (const auto& n : kNormals) {  // the inside is behind all three faces
      const double t = n[2] * tip_ / (n[0] * x + n[1] * y + n[2]);
      if (t > reference.depth) reference = {t, {n[0], n[1], n[2]}};
    }
    const double t = reference.depth;
    return t > 0 &&
           std::ranges::all_of(kNormals, [&](const double* n) { return -n[0] * t * x - n[1] * t * y - n[2] * (t - tip_) < reach_; });
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> tangential(-jitter.tangential, jitter.tangential), normal(-jitter.normal, jitter.normal);
    std::vector<Float3> out;
    for (int face = 0; face < 3; ++face) {
      const int next = (face + 1) % 3, last = (face + 2) % 3;
      const double *n = kNormals[face], *u = kNormals[next], *v = kNormals[last];  // orthogonal: the other normals span the face
      for (int layer = 0; layer < kLayers; ++layer)
        for (double a = layer + (next < face ? 1.5 : 0.5); a < reach_; ++a)  // particles of an edge belong to the face of lower index
          for (double b = layer + (last < face ? 1.5 : 0.5); b < reach_; ++b) {
            const double p = a + tangential(random), q = b + tangential(random), h = layer + 0.5 + normal(random);
            out.push_back({float(-h * n[0] - p * u[0] - q * v[0]), float(-h * n[1] - p * u[1] - q * v[1]),
                           float(tip_ - h * n[2] - p * u[2] - q * v[2])});
          }
    }
    return out;
  }

 private:
  // Unit normals, each with z = -1 / sqrt(3).
  static constexpr double kNormals[3][3] = {{0.816496580927726, 0, -0.5773502691896258},
                                            {-0.408248290463863, 0.7071067811865476, -0.5773502691896258},
                                            {-0.408248290463863, -0.7071067811865476, -0.5773502691896258}};
  double tip_, reach_;
};

/// A disk of one layer, facing the eye.
class Sheet : public Shape {
 public:
  Sheet(double distance, double radius) : distance_(distance), radius_(radius) {}

  std::string name() const override { return "sheet"; }

  bool intersect(double x, double y, ReferencePoint& reference) const override {
    reference = {distance_, {0, 0, -1}};
    return std::hypot(x, y) * distance_ < radius_;
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> tangential(-jitter.tangential, jitter.tangential), normal(-jitter.normal, jitter.normal);
    std::vector<Float3> out;
    for (double ring = radius_ - 0.5; ring > 0; --ring) {  // the outermost ring is half a spacing inside the rim
      const int count = std::max(1, static_cast<int>(2 * std::numbers::pi * ring));
      for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * k / count;
        out.push_back({float(ring * std::cos(angle) + tangential(random)), float(ring * std::sin(angle) + tangential(random)),
                       float(distance_ + 0.5 + normal(random))});
      }
    }
    return out;
  }

 private:
  double distance_, radius_;
};

/// A bent disk of one layer with a hole and round rims, seen at 40 degrees: what a splash tears.
class TornSheet : public Shape {
 public:
  TornSheet(double distance, double radius) : distance_(distance), inner_(0.35 * radius + 0.5), outer_(radius - 0.5) {}

  std::string name() const override { return "torn sheet"; }

  bool intersect(double x, double y, ReferencePoint& reference) const override {
    const double size = std::hypot(x, y, 1.0);
    double t = (distance_ - 1.5 * outer_) * size;
    for (int k = 0; k < 200 && t < (distance_ + 1.5 * outer_) * size; ++k) {
      const Double3 p{t * x / size, t * y / size, t / size};
      const double away = distanceTo(p);
      if (away < 1e-7) {
        reference = {p[2], gradientAt(p)};
        return true;
      }
      t += 0.9 * away;  // distances to a bent sheet are upper bounds
    }
    return false;
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> tangential(-jitter.tangential, jitter.tangential), normal(-jitter.normal, jitter.normal);
    std::vector<Float3> out;
    for (double ring = outer_; ring > inner_ - 0.1; --ring) {
      const int count = static_cast<int>(2 * std::numbers::pi * ring);
      for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * k / count;
        const double u = ring * std::cos(angle) + tangential(random), v = ring * std::sin(angle) + tangential(random);
        const double h = bend(u) + normal(random);
        out.push_back({float(u * kAcross[0] + h * kNormal[0]), float(v), float(distance_ + u * kAcross[2] + h * kNormal[2])});
      }
    }
    return out;
  }

 private:
  // Axes of the disk: across, up (y) and towards the eye.
  static constexpr double kCos = 0.766044443118978, kSin = 0.642787609686539;
  static constexpr Double3 kAcross{kCos, 0, kSin}, kNormal{kSin, 0, -kCos};
  static constexpr double kLength = 18;  // spacings: of the bend

  static double bend(double u) { return kSteepness * kLength * std::sin(2 * std::numbers::pi / kLength * u); }
  static double slope(double u) { return kSteepness * 2 * std::numbers::pi * std::cos(2 * std::numbers::pi / kLength * u); }

  /// To the surface half a spacing around the sheet of centers, by its distance at the same place of the disk.
  double distanceTo(const Double3& p) const {
    const double u = p[0] * kAcross[0] + (p[2] - distance_) * kAcross[2], h = p[0] * kNormal[0] + (p[2] - distance_) * kNormal[2];
    const double from = std::hypot(u, p[1]);
    return std::hypot(from - std::clamp(from, inner_, outer_), (h - bend(u)) / std::hypot(1.0, slope(u))) - 0.5;
  }
  Double3 gradientAt(const Double3& p) const {
    constexpr double kStep = 1e-4;
    Double3 out{};
    double square = 0;
    for (size_t k = 0; k < 3; ++k) {
      Double3 low = p, high = p;
      low[k] -= kStep;
      high[k] += kStep;
      out[k] = distanceTo(high) - distanceTo(low);
      square += out[k] * out[k];
    }
    for (double& value : out) value /= std::sqrt(square);
    return out;
  }

  double distance_, inner_, outer_;  // spacings; of the sheet of centers
};

}  // namespace

std::vector<std::unique_ptr<Shape>> shapes(double distance, double tanHalfFovX, double tanHalfFovY) {
  std::vector<std::unique_ptr<Shape>> all;
  all.push_back(std::make_unique<HeightField>("plane", distance, tanHalfFovX, tanHalfFovY, 0.6, 0, 1));
  for (const int length : {8, 18, 30, 50, 60})
    all.push_back(std::make_unique<HeightField>("waves " + std::to_string(length), distance, tanHalfFovX, tanHalfFovY, 0,
                                                kSteepness * length, length));
  const double r = 0.55 * distance * tanHalfFovY;
  all.push_back(std::make_unique<Balls>(
      std::vector<Balls::Ball>{{-0.6 * r, -0.1 * r, distance, r}, {0.9 * r, 0.4 * r, distance + 0.6 * r, 0.6 * r}}));
  all.push_back(std::make_unique<Corner>(0.7 * distance, 3 * distance * std::max(tanHalfFovX, tanHalfFovY) + 8));
  // Covers a fifth of the picture.
  all.push_back(std::make_unique<Sheet>(distance, distance * std::sqrt(0.2 * 4 * tanHalfFovX * tanHalfFovY / std::numbers::pi)));
  all.push_back(std::make_unique<TornSheet>(distance, 0.8 * distance * tanHalfFovY));
  return all;
}

std::vector<std::unique_ptr<Shape>> tiltedShapes(double distance, double tanHalfFovX, double tanHalfFovY) {
  std::vector<std::unique_ptr<Shape>> all;
  all.push_back(std::make_unique<HeightField>("plane at 50 deg", distance, tanHalfFovX, tanHalfFovY, kTilt, 0, 1));
  for (const int length : {18, 50})
    all.push_back(std::make_unique<HeightField>("waves " + std::to_string(length) + " at 50 deg", distance, tanHalfFovX, tanHalfFovY, kTilt,
                                                kSteepness * length, length));
  return all;
}

std::unique_ptr<Shape> travelingWave(double distance, double tanHalfFovX, double tanHalfFovY, double length, double traveled) {
  return std::make_unique<HeightField>("moving wave", distance, tanHalfFovX, tanHalfFovY, 0, kSteepness * length, length, traveled);
}

}  // namespace rill::bench
