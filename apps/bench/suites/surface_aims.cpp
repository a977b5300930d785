#include "bench/suites/surface_aims.hpp"

#include <limits>

namespace rill::bench {
namespace {

constexpr const char* kPicture = "1024x768 r 10";
constexpr double kNone = std::numeric_limits<double>::infinity();

struct Aim {
  const char *method, *shape, *what;
  double SurfaceFigures::*figure;
  double aim, band;      ///< band: what it must keep; none of a time
  bool atLeast = false;  ///< in place of at most
};

constexpr Aim kAims[] = {
    {"planes", "plane", "mean, degrees", &SurfaceFigures::mean, 1.1, 1.1},
    {"planes", "waves 18", "mean, degrees", &SurfaceFigures::mean, 2.4, 2.4},
    {"planes", "waves 50", "mean, degrees", &SurfaceFigures::mean, 1.2, 1.2},
    {"planes", "balls", "mean, degrees", &SurfaceFigures::mean, 2.8, 2.8},
    {"planes", "balls", "p95, degrees", &SurfaceFigures::p95, 7, 7},
    {"planes", "balls", "edge band, degrees", &SurfaceFigures::edge, 8, 8},
    {"planes", "balls", "silhouettes, IoU", &SurfaceFigures::overlap, 0.98, 0.98, true},
    {"planes", "corner", "p95, degrees", &SurfaceFigures::p95, 20, 24},  // which face a rim's particle is of is decided by roundings
    {"planes", kMovingWave, "flicker, degrees", &SurfaceFigures::flicker, 2.4, 2.4},
    {"planes", "plane", "smoothing with normals, ms", &SurfaceFigures::smoothing_ms, 34, kNone},
    {"planes", "waves 18", "smoothing with normals, ms", &SurfaceFigures::smoothing_ms, 34, kNone},
    {"planes", "plane", "chain, ms", &SurfaceFigures::ms, 57, kNone},
    {"planes", "waves 18", "chain, ms", &SurfaceFigures::ms, 57, kNone},
    {"planes", "sheet", "chain, ms", &SurfaceFigures::ms, 20, kNone},
    {"curvature flow", "waves 18", "mean, degrees", &SurfaceFigures::mean, 3, 3},
    {"curvature flow", "waves 50", "mean, degrees", &SurfaceFigures::mean, 3, 3},
    {"curvature flow", kMovingWave, "flicker, degrees", &SurfaceFigures::flicker, 2.4, 2.4},
    {"curvature flow", "balls", "edge band, degrees", &SurfaceFigures::edge, 12, 12},
    {"curvature flow", "waves 18", "chain, ms", &SurfaceFigures::ms, 60, kNone},
};

}  // namespace

Table judgedSurfaces(std::span<const SurfaceFigures> all, bool whole, std::vector<std::string>& failures) {
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
      if (aim.band < kNone && !(sign * value <= sign * aim.band))
        failures.push_back(std::string(aim.method) + ", " + aim.shape + ": " + aim.what + " " + number(value) + ", band " +
                           number(aim.band));
    }
    if (whole && !measured) failures.push_back(std::string(aim.method) + ", " + aim.shape + ": " + aim.what + " was not measured");
  }
  return table;
}

}  // namespace rill::bench
