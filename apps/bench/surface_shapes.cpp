#include "bench/surface_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace rill::bench {
namespace {

constexpr int kLayers = 3;           // that a renderer can see
constexpr double kSteepness = 0.05;  // amplitude of a wave over its length
constexpr double kTilt = 1.2;        // slope of what is seen at 50 degrees

/// A surface whose depth is a function of x alone: a tilted plane, waves. They may have traveled: then particles ride on them, and do not
/// travel.
class Relief : public Shape {
 public:
  Relief(std::string name, double distance, double tangentX, double tangentY, double slope, double amplitude, double length,
         double traveled = 0)
      : name_(std::move(name)),
        distance_(distance),
        tangentX_(tangentX),
        tangentY_(tangentY),
        slope_(slope),
        amplitude_(amplitude),
        wave_(2 * std::numbers::pi / length),
        traveled_(traveled) {}

  std::string name() const override { return name_; }

  bool hit(double x, double /*y*/, Truth& truth) const override {
    double t = distance_;
    for (int k = 0; k < 40; ++k) {
      const double step = (t - depth(t * x)) / std::max(1 - rise(t * x) * x, 0.2);
      t -= step;
      if (std::abs(step) < 1e-12 * distance_) break;
    }
    const double r = rise(t * x), size = std::sqrt(1 + r * r);
    truth = {t, {r / size, 0, -1 / size}};
    return true;
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(-jitter.along, jitter.along), across(-jitter.across, jitter.across);
    std::vector<Float3> out;
    const double farthest = 1.3 * distance_ / std::max(1 - std::abs(slope_) * tangentX_, 0.3);
    const double width = farthest * tangentX_ + 4, height = farthest * tangentY_ + 4;
    for (int layer = 0; layer < kLayers; ++layer)
      for (double x = -width; x < width;) {
        const double r = riseOf(x), size = std::sqrt(1 + r * r);  // before it traveled: particles stay the same ones
        for (double y = -height; y < height; y += 1) {
          const double u = along(random), h = layer + 0.5 + across(random);
          const double at = x + u / size;
          const double ra = rise(at), sa = std::sqrt(1 + ra * ra);
          out.push_back({float(at - h * ra / sa), float(y + along(random)), float(depth(at) + h / sa)});
        }
        x += 1 / size;
      }
    return out;
  }

 private:
  double depth(double x) const { return distance_ + slope_ * x + amplitude_ * std::sin(wave_ * (x - traveled_)); }
  double rise(double x) const { return riseOf(x - traveled_); }
  double riseOf(double x) const { return slope_ + amplitude_ * wave_ * std::cos(wave_ * x); }

  std::string name_;
  double distance_, tangentX_, tangentY_, slope_, amplitude_, wave_, traveled_;
};

class Balls : public Shape {
 public:
  struct Ball {
    double x, y, z, radius;
  };
  explicit Balls(std::vector<Ball> balls) : balls_(std::move(balls)) {}

  std::string name() const override { return "balls"; }

  bool hit(double x, double y, Truth& truth) const override {
    bool any = false;
    for (const Ball& ball : balls_) {
      const double a = x * x + y * y + 1, b = ball.x * x + ball.y * y + ball.z;
      const double c = ball.x * ball.x + ball.y * ball.y + ball.z * ball.z - ball.radius * ball.radius, under = b * b - a * c;
      if (under <= 0) continue;
      const double t = (b - std::sqrt(under)) / a;
      if (any && t >= truth.depth) continue;
      any = true;
      truth = {t, {(t * x - ball.x) / ball.radius, (t * y - ball.y) / ball.radius, (t - ball.z) / ball.radius}};
    }
    return any;
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(-jitter.along, jitter.along), across(-jitter.across, jitter.across);
    std::vector<Float3> out;
    for (const Ball& ball : balls_)
      for (int layer = 0; layer < kLayers; ++layer) {
        const double r = ball.radius - layer - 0.5;
        const int count = std::max(1, static_cast<int>(4 * std::numbers::pi * r * r));
        for (int k = 0; k < count; ++k) {  // a spiral of equal areas
          const double up = 1 - (2 * k + 1.0) / count, s = std::sqrt(1 - up * up), angle = 2.399963229728653 * k;
          const double n[3] = {s * std::cos(angle), s * std::sin(angle), up};
          const double h = r + across(random), u = along(random), v = along(random);
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

/// The corner of a box that points at the eye: three planes at right angles, as far as `reach` from their edges.
class Corner : public Shape {
 public:
  Corner(double distance, double reach) : tip_(distance), reach_(reach) {}

  std::string name() const override { return "corner"; }

  bool hit(double x, double y, Truth& truth) const override {
    truth.depth = 0;
    for (const auto& n : kNormals) {  // inside is behind all three
      const double t = n[2] * tip_ / (n[0] * x + n[1] * y + n[2]);
      if (t > truth.depth) truth = {t, {n[0], n[1], n[2]}};
    }
    const double t = truth.depth;
    return t > 0 &&
           std::ranges::all_of(kNormals, [&](const double* n) { return -n[0] * t * x - n[1] * t * y - n[2] * (t - tip_) < reach_; });
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(-jitter.along, jitter.along), across(-jitter.across, jitter.across);
    std::vector<Float3> out;
    for (int face = 0; face < 3; ++face) {
      const int next = (face + 1) % 3, last = (face + 2) % 3;
      const double *n = kNormals[face], *u = kNormals[next], *v = kNormals[last];  // at right angles: each other's axes
      for (int layer = 0; layer < kLayers; ++layer)
        for (double a = layer + (next < face ? 1.5 : 0.5); a < reach_; ++a)  // an edge belongs to the lower one of its faces
          for (double b = layer + (last < face ? 1.5 : 0.5); b < reach_; ++b) {
            const double p = a + along(random), q = b + along(random), h = layer + 0.5 + across(random);
            out.push_back({float(-h * n[0] - p * u[0] - q * v[0]), float(-h * n[1] - p * u[1] - q * v[1]),
                           float(tip_ - h * n[2] - p * u[2] - q * v[2])});
          }
    }
    return out;
  }

 private:
  // 1 / sqrt(3) towards the eye each.
  static constexpr double kNormals[3][3] = {{0.816496580927726, 0, -0.5773502691896258},
                                            {-0.408248290463863, 0.7071067811865476, -0.5773502691896258},
                                            {-0.408248290463863, -0.7071067811865476, -0.5773502691896258}};
  double tip_, reach_;
};

/// A round sheet of one layer, face on.
class Sheet : public Shape {
 public:
  Sheet(double distance, double radius) : distance_(distance), radius_(radius) {}

  std::string name() const override { return "sheet"; }

  bool hit(double x, double y, Truth& truth) const override {
    truth = {distance_, {0, 0, -1}};
    return std::hypot(x, y) * distance_ < radius_;
  }

  std::vector<Float3> particles(const Jitter& jitter, uint32_t seed) const override {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(-jitter.along, jitter.along), across(-jitter.across, jitter.across);
    std::vector<Float3> out;
    for (double ring = radius_ - 0.5; ring > 0; --ring) {  // the outermost half a spacing inside the rim
      const int count = std::max(1, static_cast<int>(2 * std::numbers::pi * ring));
      for (int k = 0; k < count; ++k) {
        const double angle = 2 * std::numbers::pi * k / count;
        out.push_back({float(ring * std::cos(angle) + along(random)), float(ring * std::sin(angle) + along(random)),
                       float(distance_ + 0.5 + across(random))});
      }
    }
    return out;
  }

 private:
  double distance_, radius_;
};

}  // namespace

std::vector<std::unique_ptr<Shape>> shapes(double distance, double tangentX, double tangentY) {
  std::vector<std::unique_ptr<Shape>> all;
  all.push_back(std::make_unique<Relief>("plane", distance, tangentX, tangentY, 0.6, 0, 1));
  for (const int length : {8, 18, 30, 50, 60})
    all.push_back(
        std::make_unique<Relief>("waves " + std::to_string(length), distance, tangentX, tangentY, 0, kSteepness * length, length));
  const double r = 0.55 * distance * tangentY;
  all.push_back(std::make_unique<Balls>(
      std::vector<Balls::Ball>{{-0.6 * r, -0.1 * r, distance, r}, {0.9 * r, 0.4 * r, distance + 0.6 * r, 0.6 * r}}));
  all.push_back(std::make_unique<Corner>(0.7 * distance, 3 * distance * std::max(tangentX, tangentY) + 8));
  // A fifth of the picture.
  all.push_back(std::make_unique<Sheet>(distance, distance * std::sqrt(0.2 * 4 * tangentX * tangentY / std::numbers::pi)));
  return all;
}

std::vector<std::unique_ptr<Shape>> tiltedShapes(double distance, double tangentX, double tangentY) {
  std::vector<std::unique_ptr<Shape>> all;
  all.push_back(std::make_unique<Relief>("plane at 50 deg", distance, tangentX, tangentY, kTilt, 0, 1));
  for (const int length : {18, 50})
    all.push_back(std::make_unique<Relief>("waves " + std::to_string(length) + " at 50 deg", distance, tangentX, tangentY, kTilt,
                                           kSteepness * length, length));
  return all;
}

std::unique_ptr<Shape> traveledWave(double distance, double tangentX, double tangentY, double length, double traveled) {
  return std::make_unique<Relief>("moving wave", distance, tangentX, tangentY, 0, kSteepness * length, length, traveled);
}

}  // namespace rill::bench
