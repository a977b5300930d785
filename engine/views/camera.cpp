#include "views/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "views/bounds.hpp"

namespace rill {
namespace {

glm::dvec3 vec(const Double3& v) { return {v[0], v[1], v[2]}; }

void store(const glm::dvec3& v, Double3& out) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

}  // namespace

CameraBasis cameraBasis(const CameraView& camera) {
  glm::dvec3 forward = vec(camera.target) - vec(camera.eye);
  const double distance = glm::length(forward);
  forward = distance > 0 ? forward / distance : glm::dvec3(0, 0, -1);
  glm::dvec3 right = glm::cross(forward, glm::dvec3(0, 1, 0));
  if (glm::length(right) < 1e-6) right = glm::dvec3(1, 0, 0);
  right = glm::normalize(right);
  CameraBasis basis;
  store(right, basis.right);
  store(glm::cross(right, forward), basis.up);
  store(forward, basis.forward);
  return basis;
}

CameraView frameCamera(const Double3& min, const Double3& max, double aspect) {
  constexpr double kMargin = 1.07, kFov = 32;
  glm::dvec3 low = vec(min), high = vec(max);
  glm::dvec3 size = high - low;
  if (!(glm::length(size) > 0)) {
    low -= 0.5;
    high += 0.5;
    size = high - low;
  }
  const bool alongZ = size.z > 1.25 * size.x;
  const glm::dvec3 away = glm::normalize(alongZ ? glm::dvec3(1, 0.46, -0.42) : glm::dvec3(0.42, 0.46, 1));

  const double tanY = std::tan(glm::radians(0.5 * kFov)) / kMargin, tanX = tanY * std::max(aspect, 1e-3);
  glm::dvec3 target = 0.5 * (low + high);
  CameraView camera;
  camera.fov_y_deg = kFov;
  store(target + away, camera.eye);
  store(target, camera.target);
  const CameraBasis basis = cameraBasis(camera);
  const glm::dvec3 right = vec(basis.right), up = vec(basis.up);
  double distance = 0;
  // Alternates the nearest distance that shows every corner and centering the target; converges in a few rounds.
  for (int round = 0; round < 8; ++round) {
    distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 d = glm::dvec3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z) - target;
      distance = std::max(distance, glm::dot(d, away) + std::max(std::abs(glm::dot(d, right)) / tanX, std::abs(glm::dot(d, up)) / tanY));
    }
    double left = 0, rightmost = 0, bottom = 0, top = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 d = glm::dvec3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z) - target;
      const double depth = distance - glm::dot(d, away);
      left = std::min(left, glm::dot(d, right) / depth);
      rightmost = std::max(rightmost, glm::dot(d, right) / depth);
      bottom = std::min(bottom, glm::dot(d, up) / depth);
      top = std::max(top, glm::dot(d, up) / depth);
    }
    if (round < 7) target += 0.5 * distance * ((left + rightmost) * right + (bottom + top) * up);
  }
  store(target + distance * away, camera.eye);
  store(target, camera.target);
  return camera;
}

CameraView sceneCamera(const Scene& scene, const ParticleSet& particles, double aspect) {
  if (scene.camera) {
    CameraView camera;
    camera.eye = scene.camera->eye;
    camera.target = scene.camera->target;
    camera.fov_y_deg = scene.camera->fov_y_deg;
    return camera;
  }
  if (scene.domain) return frameCamera(scene.domain->min, scene.domain->max, aspect);
  Bounds bounds = fluidBounds(scene, particles);
  addSolids(bounds, scene);
  const Double3 zero = {0, 0, 0};
  return bounds.empty() ? frameCamera(zero, zero, aspect) : frameCamera(bounds.min, bounds.max, aspect);
}

FluidView fluidView(const CameraView& camera, uint32_t width, uint32_t height, double spacing, const CameraOffset& offset) {
  const CameraBasis basis = cameraBasis(camera);
  FluidView view;
  double distance = 0;
  const auto set = [](Float4& column, double x, double y, double z) {
    column = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0};
  };
  for (int a = 0; a < 3; ++a) {
    view.origin[a] = camera.eye[a] + offset.right_m * basis.right[a] + offset.up_m * basis.up[a];
    distance = std::hypot(distance, camera.target[a] - camera.eye[a]);
    set(view.view.column[a], basis.right[a], basis.up[a], -basis.forward[a]);
  }
  const double focal = 1 / std::tan(0.5 * camera.fov_y_deg * std::numbers::pi / 180);
  const double near = std::max({0.1 * spacing, 1e-4 * distance, 1e-6});
  view.projection.column[0] = {static_cast<float>(focal * height / width), 0, 0, 0};
  view.projection.column[1] = {0, static_cast<float>(-focal), 0, 0};
  const double x = 2 * offset.x_px / width - focal * height / width * offset.right_m / offset.focus_m;
  const double y = 2 * offset.y_px / height + focal * offset.up_m / offset.focus_m;
  view.projection.column[2] = {static_cast<float>(x), static_cast<float>(y), 0, -1};
  view.projection.column[3] = {0, 0, static_cast<float>(near), 0};
  view.width = width;
  view.height = height;
  view.focus_m = distance;
  return view;
}

}  // namespace rill
