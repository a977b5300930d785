#pragma once
// Pictures of a few particles, with a camera whose rays are simple.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "support/gpu_test.hpp"
#include "views/particle_view.hpp"

namespace rill::test {
namespace particle_view_test {

struct Particle {
  float x, y, z;
  float vx = 0, vy = 0, vz = 0, density = 1;
  float fluid = 0;
};

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint32_t> pixels;
  uint32_t at(uint32_t x, uint32_t y) const { return pixels[size_t{y} * width + x]; }
};

inline constexpr double kTangent = 0.5;  // of half the vertical field of view
inline const double kFov = 2 * std::atan(kTangent) * 180 / std::numbers::pi;

class ParticleViewOnGpu : public GpuTest {
 protected:
  /// Looks along -z from the origin; nothing but particles, unless the scene says otherwise.
  ParticleViewOnGpu() {
    scene_.fluid.spacing = 1;
    scene_.gravity[1] = 0;
    camera_.eye[0] = camera_.eye[1] = camera_.eye[2] = 0;
    camera_.target[2] = -10;
    camera_.fov_y_deg = kFov;
  }

  /// The picture, taken twice in one command buffer, where synchronization validation sees both: they must be the same.
  Picture take(const std::vector<Particle>& particles, uint32_t width, uint32_t height, double time = 0,
               ParticleColor color = ParticleColor::Speed, bool unlit = false) {
    ParticleSet start;
    start.origin = origin_;
    std::vector<Float4> positions, velocities;
    for (const Particle& p : particles) {
      positions.push_back({p.x, p.y, p.z, p.fluid});
      velocities.push_back({p.vx, p.vy, p.vz, p.density});
      start.positions.push_back({p.x, p.y, p.z});
    }
    if (start_) start.positions = {*start_};
    auto view = ParticleView::create(device(), scene_, start);
    EXPECT_TRUE(view) << view.error().message;
    if (!view) return {};
    Buffer position, velocity;
    if (!particles.empty()) {
      position = upload("position", positions);
      velocity = upload("velocity", velocities);
    }
    Picture picture{width, height, {}};
    Graph graph;
    FluidState state;
    state.capacity = static_cast<uint32_t>(particles.size());
    state.spacing = static_cast<float>(scene_.fluid.spacing);
    state.origin = origin_;
    if (!particles.empty()) {
      state.position = graph.import("position", importOf(position));
      state.velocity = graph.import("velocity", importOf(velocity));
    }
    Ticket tickets[2];
    for (Ticket& ticket : tickets) ticket = graph.readback((*view)->addTo(graph, state, camera_, {width, height, color, unlit}, time));
    run(graph);
    picture.pixels = read<uint32_t>(graph, tickets[0]);
    EXPECT_EQ(picture.pixels.size(), size_t{width} * height);
    EXPECT_TRUE(read<uint32_t>(graph, tickets[1]) == picture.pixels) << "two runs differ";
    return picture;
  }

  /// Pixels that differ between two pictures of one size.
  static size_t difference(const Picture& a, const Picture& b) {
    size_t count = 0;
    for (size_t k = 0; k < a.pixels.size(); ++k) count += a.pixels[k] != b.pixels[k] ? 1 : 0;
    return count;
  }

  /// How far inside a sphere's outline the ray of a pixel runs, as a fraction of its radius: 1 through the center, negative outside.
  static double inside(const Particle& p, double radius, double x, double y, uint32_t width, uint32_t height) {
    const double focal = 0.5 * height / kTangent;
    const Double3 d = {(x - 0.5 * width) / focal, (0.5 * height - y) / focal, -1};
    const double t = (p.x * d[0] + p.y * d[1] + p.z * d[2]) / (d[0] * d[0] + d[1] * d[1] + 1);
    return 1 - std::hypot(p.x - t * d[0], p.y - t * d[1], p.z - t * d[2]) / radius;
  }

  Scene scene_;
  CameraView camera_;
  Double3 origin_ = {0, 0, 0};
  std::optional<Float3> start_;  ///< in place of the particles, where the light's frame must not follow them
};

}  // namespace particle_view_test
}  // namespace rill::test
