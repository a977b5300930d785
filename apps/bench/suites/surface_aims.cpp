#include "bench/suites/surface_aims.hpp"

#include <limits>

namespace rill::bench {
namespace {

constexpr const char* kPicture = "1024x768 r 10";
constexpr double kNoBand = std::numeric_limits<double>::infinity();

struct Aim {
  const char *method, *shape, *what;
  double SurfaceFigures::*figure;
  double aim, band;      ///< band: limit of a passing run; times have none
  bool atLeast = false;  ///< lower limits instead of upper ones
};

constexpr Aim kAims[] = {
    {"planes", "plane", "mean, degrees", &SurfaceFigures::mean, 1.1, 1.1},
    {"planes", "waves 18", "mean, degrees", &SurfaceFigures::mean, 2.4, 2.4},
    {"planes", "waves 50", "mean, degrees", &SurfaceFigures::mean, 1.2, 1.2},
    {"planes", "balls", "mean, degrees", &SurfaceFigures::mean, 2.8, 2.8},
    {"planes", "balls", "p95, degrees", &SurfaceFigures::p95, 7, 7},
    {"planes", "balls", "edge band, degrees", &SurfaceFigures::edge, 8, 8},
    {"planes", "balls", "silhouettes, IoU", &SurfaceFigures::iou, 0.98, 0.98, true},
    {"planes", "corner", "p95, degrees", &SurfaceFigures::p95, 20, 24},  // rounding decides the face of particles on an edge
    {"planes", kMovingWave, "flicker, degrees", &SurfaceFigures::flicker, 2.4, 2.4},
    {"planes", "plane", "smoothing with normals, ms", &SurfaceFigures::smoothing_ms, 34, kNoBand},
    {"planes", "waves 18", "smoothing with normals, ms", &SurfaceFigures::smoothing_ms, 34, kNoBand},
    {"planes", "plane", "chain, ms", &SurfaceFigures::ms, 57, kNoBand},
    {"planes", "waves 18", "chain, ms", &SurfaceFigures::ms, 57, kNoBand},
    {"planes", "sheet", "chain, ms", &SurfaceFigures::ms, 20, kNoBand},
    {"planes", "torn sheet", "mean, degrees", &SurfaceFigures::mean, 2.5, 2.5},
    {"planes", "torn sheet", "edge band, degrees", &SurfaceFigures::edge, 10, 14},  // planes are flat up to a rim, which is round
    {"planes", "torn sheet", "silhouettes, IoU", &SurfaceFigures::iou, 0.975, 0.975, true},
    {"curvature flow", "waves 18", "mean, degrees", &SurfaceFigures::mean, 3, 3},
    {"curvature flow", "waves 50", "mean, degrees", &SurfaceFigures::mean, 3, 3},
    {"curvature flow", kMovingWave, "flicker, degrees", &SurfaceFigures::flicker, 2.4, 2.4},
    {"curvature flow", "balls", "edge band, degrees", &SurfaceFigures::edge, 12, 12},
    {"curvature flow", "waves 18", "chain, ms", &SurfaceFigures::ms, 60, kNoBand},
};

}  // namespace

Table surfaceAimTable(std::span<const SurfaceFigures> all, bool complete, std::vector<std::string>& failures) {
  Table table{std::string("Aims at ") + kPicture, {"method", "shape", "figure", "measured", "aim", "reached"}, {}, ""};
  for (const Aim& aim : kAims) {
    bool measured = false;
    for (const SurfaceFigures& found : all) {
      if (found.method != aim.method || found.shape != aim.shape) continue;
      if (found.picture != kPicture && found.shape != kMovingWave) continue;
      measured = true;
      const double value = found.*aim.figure, sign = aim.atLeast ? -1 : 1;
      const bool reached = sign * value <= sign * aim.aim;
      table.rows.push_back({aim.method, aim.shape, aim.what, number(value), number(aim.aim), reached ? "yes" : "no"});
      if (aim.band < kNoBand && !(sign * value <= sign * aim.band))
        failures.push_back(std::string(aim.method) + ", " + aim.shape + ": " + aim.what + ": found " + number(value) +
                           (aim.atLeast ? ", expected at least " : ", expected at most ") + number(aim.band));
    }
    if (complete && !measured) failures.push_back(std::string(aim.method) + ", " + aim.shape + ": " + aim.what + ": not measured");
  }
  return table;
}

}  // namespace rill::bench
