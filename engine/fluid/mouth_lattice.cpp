// The particles of a layer that leaves a mouth.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/overloaded.hpp"
#include "core/vector_math.hpp"
#include "fill/mesh_mouth.hpp"
#include "fill/mouth.hpp"
#include "fluid/flows.hpp"
#include "fluid/numbers.hpp"

namespace rill {
namespace {

/// Points of a square lattice of pitch 1 inside a circle; `first`: of a point.
std::vector<std::array<double, 2>> pointsInCircle(double radius, const std::array<double, 2>& first) {
  std::vector<std::array<double, 2>> points;
  const double steps = std::ceil(radius) + 1;
  for (double j = -steps; j <= steps; ++j)
    for (double i = -steps; i <= steps; ++i)
      if (std::hypot(i + first[0], j + first[1]) < radius) points.push_back({i + first[0], j + first[1]});
  return points;
}

// Of three ways to center the lattice, the one whose number of points is nearest to the area's. Its pitch is then scaled so that it is the
// area's.
void fill(const DiscMouth& disc, double spacing, MouthLattice& lattice) {
  lattice.normal = normalized(disc.normal);
  lattice.across = unitAcross(lattice.normal);
  lattice.half = {disc.radius, disc.radius};
  const double wanted = lattice.area / (spacing * spacing);
  std::vector<std::array<double, 2>> best = {{0, 0}};
  for (const std::array<double, 2>& first : {std::array{0.0, 0.0}, {0.5, 0.5}, {0.5, 0.0}}) {
    std::vector<std::array<double, 2>> points = pointsInCircle(disc.radius / spacing, first);
    const auto off = [&](const auto& some) { return std::abs(static_cast<double>(some.size()) - wanted); };
    if (!points.empty() && off(points) < off(best)) best = std::move(points);
  }
  const double pitch = std::sqrt(lattice.area / static_cast<double>(best.size()));
  for (const auto& [x, y] : best) lattice.points.push_back({f(pitch * x), f(pitch * y)});
}

void fill(const RectMouth& rect, double spacing, MouthLattice& lattice) {
  lattice.normal = normalized(rect.normal);
  lattice.across = normalized(cross(lattice.normal, normalized(rect.up)));
  const auto& size = rect.size;
  lattice.half = {size.first / 2, size.second / 2};
  const double columns = std::max(1.0, std::round(size.first / spacing)), rows = std::max(1.0, std::round(size.second / spacing));
  for (double j = 0; j < rows; ++j)
    for (double i = 0; i < columns; ++i)
      lattice.points.push_back({f(size.first * ((i + 0.5) / columns - 0.5)), f(size.second * ((j + 0.5) / rows - 0.5))});
}

/// The lattice whose number of points in the mouth takes its area: the pitch is sqrt(area / number). Of several, the one of the number that
/// is nearest to the spacing's, then the one whose points are balanced about the centroid. If none fits, what is off by the least.
MouthGrid gridFor(const FlatMouth& flat, double spacing) {
  constexpr double kMaxOff = 0.15;  // of the number of points
  constexpr int kTries = 65, kShifts = 64;
  const double wanted = flat.area / (spacing * spacing), nearest = std::max(1.0, std::round(wanted));
  const MouthPoint middle = {(flat.low[0] + flat.high[0]) / 2, (flat.low[1] + flat.high[1]) / 2};
  MouthGrid best;
  std::pair least{std::numeric_limits<double>::infinity(),
                  0.0};  // share of the number that is off; m, from the centroid to that of the points
  for (int attempt = 0; attempt < kTries && least.first > 0; ++attempt) {
    const int away = (attempt + 1) / 2;
    const double number = nearest + ((attempt % 2 == 1) == (nearest < wanted) ? away : -away);
    if (attempt > 0 && !(number >= 1 && std::abs(number - wanted) <= kMaxOff * wanted)) continue;
    const double pitch = std::sqrt(flat.area / number);
    for (int shift = 0; shift < kShifts; ++shift) {
      const auto share = [&](int axis) {  // of the pitch, in eighths
        return (shift >> axis & 1) * 0.5 + (shift >> (axis + 2) & 1) * 0.25 + (shift >> (axis + 4) & 1) * 0.125;
      };
      const MouthGrid grid{{pitch, pitch}, {middle[0] + share(0) * pitch, middle[1] + share(1) * pitch}};
      const MouthSum sum = sumIn(flat, grid);
      if (sum.count == 0) continue;
      const std::pair off{std::abs(sum.count / number - 1), std::hypot(sum.moment[0], sum.moment[1]) / std::max(sum.count, 1.0)};
      if (off < least) least = off, best = grid;
    }
  }
  return best;
}

void fill(const MeshMouth& mesh, double spacing, MouthLattice& lattice) {
  const FlatMouth flat = flatMouth(mesh);
  lattice.normal = flat.normal, lattice.across = flat.across;
  lattice.half = {std::max(-flat.low[0], flat.high[0]), std::max(-flat.low[1], flat.high[1])};
  lattice.arm = minus(flat.center, mesh.translation);
  if (flat.area > spacing * spacing)  // else it is of one particle
    for (const auto& [x, y] : pointsIn(flat, gridFor(flat, spacing), &lattice.shared)) lattice.points.push_back({f(x), f(y)});
  if (!lattice.points.empty()) return;
  const auto [x, y] = middleOf(flat);
  lattice.points.push_back({f(x), f(y)});
}

}  // namespace

MouthLattice mouthLattice(const Mouth& mouth, double spacing) {
  MouthLattice lattice{.center = centerOf(mouth), .area = areaOf(mouth)};
  std::visit([&](const auto& shape) { fill(shape, spacing, lattice); }, mouth);
  lattice.up = cross(lattice.across, lattice.normal);
  lattice.thickness = static_cast<double>(lattice.points.size()) * spacing * spacing * spacing / lattice.area;
  return lattice;
}

}  // namespace rill
