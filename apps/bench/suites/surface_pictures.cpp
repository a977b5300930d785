#include "bench/suites/surface_pictures.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace rill::bench {
namespace {

constexpr double kRadius = 0.75;  // sphere radius in spacings, for the pixel radius in picture names

}  // namespace

Picture picture(uint32_t width, uint32_t height, double radius) {
  const double tanHalfFovY = std::tan(0.5 * kFov * std::numbers::pi / 180);
  char name[64];
  std::snprintf(name, sizeof name, "%ux%u r %g", width, height, radius);
  return {name, {width, height, tanHalfFovY * width / height, tanHalfFovY, kRadius * height / (2 * tanHalfFovY * radius)}};
}

std::vector<Picture> pictures(bool quick) {
  Picture main = picture(1024, 768, 10);
  if (quick) {
    main.settings = false;
    return {main, picture(640, 360, 10)};
  }
  std::vector<Picture> all{main};
  for (const double radius : {4.0, 25.0}) all.push_back(picture(1024, 768, radius));
  Picture noisy = main, tilted = main;
  noisy.name += " noisy";
  noisy.jitter = {0.35, 0.2};
  tilted.name += " tilted";
  tilted.tilted = true;
  all.push_back(std::move(noisy));
  all.push_back(std::move(tilted));
  for (const auto& [w, h] : {std::pair{640u, 360u}, std::pair{1280u, 720u}, std::pair{1920u, 1080u}}) all.push_back(picture(w, h, 10));
  for (const double radius : {3.0, 30.0}) {
    all.push_back(picture(1024, 768, radius));
    all.back().settings = false;
  }
  return all;
}

std::vector<std::unique_ptr<Shape>> shapesOf(const Picture& picture, bool quick) {
  const Eye& eye = picture.eye;
  if (picture.tilted) return tiltedShapes(eye.distance, eye.tanHalfFovX, eye.tanHalfFovY);
  auto all = shapes(eye.distance, eye.tanHalfFovX, eye.tanHalfFovY);
  if (quick) std::erase_if(all, [](const auto& shape) { return shape->name() == "waves 30" || shape->name() == "waves 60"; });
  return all;
}

bool smooth(const Shape& shape) { return shape.name() != "corner" && !shape.name().ends_with("sheet"); }

}  // namespace rill::bench
