#pragma once
// Curves over time, and fits.
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "rill/expected.hpp"

namespace rill::bench {

using Curve = std::vector<std::pair<double, double>>;  ///< increasing in the first

/// Linear interpolation; constant outside the samples.
double at(const Curve& curve, double x);

/// Slope of the least-squares line.
double slope(const Curve& points);

/// Root mean square of the relative differences between a curve and published points.
struct ShiftFit {
  double shift = 0;      ///< time by which the points lag the curve; minimizes `shifted` within [-1, 1]
  double unshifted = 0;  ///< error without the shift
  double shifted = 0;    ///< error with the shift
};
ShiftFit fitShift(const Curve& curve, const Curve& points);

/// Interpolated x at which the curve crosses `zero`, between samples from `from` on.
std::vector<double> zeroCrossings(const Curve& curve, double zero, double from);

/// An oscillation about zero, from interpolated zero crossings and the extremes between them (parabola through three samples).
struct Oscillation {
  double period = 0;     ///< NaN with fewer than three crossings
  double decrement = 0;  ///< logarithmic decrement per period, least squares over the extremes; NaN with fewer than two
  Curve peaks;           ///< time and magnitude of each extreme between crossings
};
/// Ignores crossings before `from` and after the first extreme below `minRelativePeak` times the first one, where noise dominates.
Oscillation oscillation(const Curve& curve, double from, double minRelativePeak = 0.05);

/// Two columns of a CSV file with one header line. Io or BadInput, naming the file and line.
Expected<Curve> readCurve(const std::filesystem::path& file);
/// Reads a curve of assets/validation, for example "martin_moyce_n2_1_front".
Expected<Curve> publishedCurve(const char* name);

}  // namespace rill::bench
