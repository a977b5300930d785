// Cameras and color maps: no device needed.
#include "views/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "views/color_map.hpp"
#include "views/particle_scene.hpp"
#include "views/particle_view.hpp"

namespace rill {
namespace {

double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Where a point appears, in half heights of the picture.
void project(const CameraView& camera, const Double3& point, double& x, double& y, double& depth) {
  const CameraBasis basis = cameraBasis(camera);
  const Double3 d = {point[0] - camera.eye[0], point[1] - camera.eye[1], point[2] - camera.eye[2]};
  depth = dot(d, basis.forward);
  const double tangent = std::tan(camera.fov_y_deg * std::numbers::pi / 360);
  x = dot(d, basis.right) / depth / tangent;
  y = dot(d, basis.up) / depth / tangent;
}

TEST(Camera, FramesBoxesOfAnyShape) {
  const double boxes[][6] = {
      {0, 0, 0, 5, 4, 1}, {0, 0, 0, 1.6, 0.8, 0.15}, {-3, 0, -40, 3, 2, 40}, {1e6, 0, 0, 1e6 + 1, 1, 1}, {0, 0, 0, 0.01, 8, 0.01}};
  for (const auto& box : boxes) {
    for (const double aspect : {16.0 / 9, 1.0, 0.4}) {
      const CameraView camera = frameCamera({box[0], box[1], box[2]}, {box[3], box[4], box[5]}, aspect);
      double widest = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const Double3 at = {box[corner & 1 ? 3 : 0], box[corner & 2 ? 4 : 1], box[corner & 4 ? 5 : 2]};
        double x = 0, y = 0, depth = 0;
        project(camera, at, x, y, depth);
        EXPECT_GT(depth, 0);
        EXPECT_LE(std::abs(x), aspect * 1.001);
        EXPECT_LE(std::abs(y), 1.001);
        widest = std::max({widest, std::abs(x) / aspect, std::abs(y)});
      }
      EXPECT_GT(widest, 0.85) << "the box could be larger in the picture";
    }
  }
}

TEST(Camera, BasisIsOrthonormalEvenStraightDown) {
  CameraView camera;
  camera.eye[0] = camera.target[0] = 2;
  camera.eye[1] = 5, camera.target[1] = -1;
  camera.eye[2] = camera.target[2] = 3;
  const CameraBasis basis = cameraBasis(camera);
  EXPECT_NEAR(dot(basis.right, basis.right), 1, 1e-12);
  EXPECT_NEAR(dot(basis.up, basis.up), 1, 1e-12);
  EXPECT_NEAR(dot(basis.up, basis.forward), 0, 1e-12);
  EXPECT_NEAR(dot(basis.right, basis.up), 0, 1e-12);
  EXPECT_NEAR(basis.up[2], -1, 1e-12);
}

TEST(Camera, DefaultFramesTheDomainOrTheFluid) {
  Scene scene;
  scene.fluid.spacing = 0.1;
  ParticleSet particles;
  particles.origin[0] = 100;
  particles.positions = {{0, 0, 0}, {1, 1, 1}};
  EXPECT_NEAR(sceneCamera(scene, particles, 1).target[0], 100.5, 0.3);
  scene.domain = Domain{{0, 0, 0}, {4, 1, 1}, 0};
  EXPECT_NEAR(sceneCamera(scene, particles, 1).target[0], 2, 0.5);
  scene.camera = Camera{{1, 2, 3}, {0, 0, 0}, 50};
  EXPECT_EQ(sceneCamera(scene, particles, 1).fov_y_deg, 50);
  scene = {};
  EXPECT_TRUE(std::isfinite(sceneCamera(scene, {}, 1).eye[0]));
}

TEST(ColorMap, LightnessIsMonotonicAndInGamut) {
  for (const ParticleColor color : {ParticleColor::Speed, ParticleColor::Compression}) {
    double before = -1;
    for (int k = 0; k <= 100; ++k) {
      const Float3 c = mapColor(color, k / 100.0);
      const double luminance = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
      if (k > 0) { EXPECT_GT((luminance - before) * (color == ParticleColor::Speed ? 1 : -1), 0) << k; }
      before = luminance;
    }
  }
  EXPECT_EQ(srgbByte(0), 0);
  EXPECT_EQ(srgbByte(1), 255);
  EXPECT_EQ(srgbByte(0.2140411), 127);
  EXPECT_EQ(srgbByte(-1), 0);
}

TEST(ParticleScene, ScalesAreFixedByTheScene) {
  Scene scene;
  scene.fluid.spacing = 0.1;
  scene.domain = Domain{{0, 0, 0}, {4, 4, 1}, 0};
  ParticleSet particles;
  for (int k = 0; k < 10; ++k) particles.positions.push_back({0.5f, 0.05f + 0.1f * static_cast<float>(k), 0.5f});
  EXPECT_DOUBLE_EQ(particleScene(scene, particles).speed_max, 4);  // sqrt(2 9.81 1) = 4.43
  scene.gravity[1] = 0;
  EXPECT_DOUBLE_EQ(particleScene(scene, particles).speed_max, 1);
  particles.velocities.assign(10, {0, 3, 4});
  EXPECT_DOUBLE_EQ(particleScene(scene, particles).speed_max, 5);
  EXPECT_DOUBLE_EQ(particleScene(scene, particles).compression_max, 0.01);
}

TEST(ParticleScene, OnlyFluidsThatMaySleepHaveItsColor) {
  Scene scene;
  scene.fluid.spacing = 0.1;
  const ParticleSet particles{.positions = {{0, 0, 0}}, .velocities = {{0, 0, 0}}};
  EXPECT_EQ(particleScene(scene, particles).scene.asleep.w, 0);
  scene.solver.sleep = true;
  EXPECT_EQ(particleScene(scene, particles).scene.asleep.w, 1);
  scene.fluids = {{.name = "water"}, {.name = "oil"}};
  EXPECT_EQ(particleScene(scene, particles).scene.asleep.w, 0);
  scene.fluids.clear();
  scene.gravity = {0, 0, 0};
  EXPECT_EQ(particleScene(scene, particles).scene.asleep.w, 0);
  scene.gravity_changes = {{.at = 1, .value = {0, -9.81, 0}}};
  EXPECT_EQ(particleScene(scene, particles).scene.asleep.w, 1);
}

TEST(ParticleView, RejectsEmptyAndTooLargePictures) {
  EXPECT_TRUE(ParticleView::check({1, 1}));
  EXPECT_TRUE(ParticleView::check({7680, 4320}));
  for (const ParticleViewDesc& desc :
       {ParticleViewDesc{0, 10}, ParticleViewDesc{10, 0}, ParticleViewDesc{8193, 1}, ParticleViewDesc{8192, 8192}}) {
    const auto ok = ParticleView::check(desc);
    ASSERT_FALSE(ok);
    EXPECT_EQ(ok.error().kind, ErrorKind::BadInput);
    EXPECT_NE(ok.error().message.find(std::to_string(desc.width) + "x" + std::to_string(desc.height)), std::string::npos);
    EXPECT_NE(ok.error().message.find("8192"), std::string::npos);
  }
}

}  // namespace
}  // namespace rill
