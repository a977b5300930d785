#pragma once
// Curves over time and what is fitted to them.
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "rill/expected.hpp"

namespace rill::bench {

using Curve = std::vector<std::pair<double, double>>;  ///< rising in the first

/// Linear between samples; before the first and after the last their values hold.
double at(const Curve& curve, double x);

/// Distance of a curve from published points, as the root mean square of relative differences.
struct ShiftFit {
  double shift = 0;      ///< how much later the points are than the curve; the one that makes `shifted` least, within +-1
  double unshifted = 0;  ///< error without it
  double shifted = 0;    ///< error with it
};
ShiftFit fitShift(const Curve& curve, const Curve& points);

/// An oscillation about zero, from its zero crossings (linear between samples) and the extremes between them (a parabola through three).
struct Oscillation {
  double period = 0;     ///< NaN with fewer than three crossings
  double decrement = 0;  ///< logarithmic, a period: least squares over the extremes; NaN with fewer than two
  Curve peaks;           ///< time and size of each extreme between crossings
};
/// Crossings before `from` are left out, and all after an extreme of less than `least` of the first: there noise crosses zero too.
Oscillation oscillation(const Curve& curve, double from, double least = 0.05);

/// Two columns of a CSV file with one header line. Io or BadInput, naming the file and line.
Expected<Curve> readCurve(const std::filesystem::path& file);
/// One of assets/validation, which lies beside the scenes ("martin_moyce_n2_1_front").
Expected<Curve> publishedCurve(const char* name);

}  // namespace rill::bench
