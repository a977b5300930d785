#include "bench/experiments/curves.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "shared/scene_folders.hpp"

namespace rill::bench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double rmsDistance(const Curve& curve, const Curve& points, double shift) {
  double sum = 0;
  for (const auto& [x, y] : points) {
    const double relative = at(curve, x - shift) / y - 1;
    sum += relative * relative;
  }
  return std::sqrt(sum / double(points.size()));
}

/// Time and magnitude of the maximum of |y| in samples first .. last, refined by a parabola.
std::pair<double, double> extreme(const Curve& curve, size_t first, size_t last) {
  size_t best = first;
  for (size_t k = first; k <= last; ++k)
    if (std::abs(curve[k].second) > std::abs(curve[best].second)) best = k;
  const auto size = [&](size_t k) { return std::abs(curve[k].second); };
  if (best == 0 || best + 1 >= curve.size()) return {curve[best].first, size(best)};
  const double before = size(best - 1), here = size(best), after = size(best + 1), bend = before - 2 * here + after;
  if (bend >= 0) return {curve[best].first, here};
  const double offset = 0.5 * (before - after) / bend;
  return {curve[best].first + offset * (curve[best + 1].first - curve[best].first), here - 0.25 * (before - after) * offset};
}

}  // namespace

double at(const Curve& curve, double x) {
  const auto after = std::ranges::upper_bound(curve, x, {}, &Curve::value_type::first);
  if (after == curve.begin()) return curve.empty() ? kNaN : curve.front().second;
  if (after == curve.end()) return curve.back().second;
  const auto before = after - 1;
  return before->second + (after->second - before->second) * (x - before->first) / (after->first - before->first);
}

double slope(const Curve& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [px, py] : points) {
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
  }
  const double n = double(points.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

ShiftFit fitShift(const Curve& curve, const Curve& points) {
  ShiftFit fit;
  if (curve.empty() || points.empty()) return {kNaN, kNaN, kNaN};
  fit.unshifted = rmsDistance(curve, points, 0);
  // A scan finds the global minimum, then ternary search refines it.
  constexpr double kStep = 0.01;
  double best = 0;
  for (int k = -100; k <= 100; ++k)
    if (rmsDistance(curve, points, k * kStep) < rmsDistance(curve, points, best)) best = k * kStep;
  double low = best - kStep, high = best + kStep;
  for (int k = 0; k < 60; ++k) {
    const double third = (high - low) / 3;
    if (rmsDistance(curve, points, low + third) < rmsDistance(curve, points, high - third))
      high -= third;
    else
      low += third;
  }
  fit.shift = (low + high) / 2;
  fit.shifted = rmsDistance(curve, points, fit.shift);
  return fit;
}

std::vector<double> zeroCrossings(const Curve& curve, double zero, double from) {
  std::vector<double> crossings;
  for (size_t k = 1; k < curve.size(); ++k) {
    const double t0 = curve[k - 1].first, y0 = curve[k - 1].second - zero, t1 = curve[k].first, y1 = curve[k].second - zero;
    if ((y0 < 0) != (y1 < 0) && t0 >= from) crossings.push_back(t0 + (t1 - t0) * y0 / (y0 - y1));
  }
  return crossings;
}

Oscillation oscillation(const Curve& curve, double from, double minRelativePeak) {
  Oscillation found;
  const std::vector<double> crossings = zeroCrossings(curve, 0, from);
  const auto sampleAfter = [&](double time) {
    return size_t(std::ranges::lower_bound(curve, time, {}, &Curve::value_type::first) - curve.begin());
  };
  size_t n = std::min<size_t>(1, crossings.size());  // crossings before noise dominates
  for (; n > 0 && n < crossings.size(); ++n) {
    const auto peak = extreme(curve, sampleAfter(crossings[n - 1]), sampleAfter(crossings[n]) - 1);
    if (!found.peaks.empty() && peak.second < minRelativePeak * found.peaks.front().second) break;
    found.peaks.push_back(peak);
  }
  found.period = n < 3 ? kNaN : 2 * (crossings[n - 1] - crossings.front()) / double(n - 1);
  Curve logarithms;
  for (const auto& [time, size] : found.peaks) logarithms.emplace_back(time, std::log(size));
  found.decrement = logarithms.size() < 2 ? kNaN : -slope(logarithms) * found.period;
  return found;
}

Expected<Curve> readCurve(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return Error{ErrorKind::Io, file.string() + ": cannot be read"};
  Curve curve;
  std::string line;
  std::getline(in, line);
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.empty() || line == "\r") continue;
    std::istringstream cells(line);
    double x = 0, y = 0;
    char comma = 0;
    if (!(cells >> x >> comma >> y) || comma != ',')
      return Error{ErrorKind::BadInput, file.string() + ":" + std::to_string(number) + ": found \"" + line + "\", expected two numbers"};
    curve.emplace_back(x, y);
  }
  return curve;
}

Expected<Curve> publishedCurve(const char* name) {
  const auto scene = apps::SceneFolders::standard().find("validation/martin-moyce-1");
  if (!scene) return scene.error();
  return readCurve(scene->parent_path().parent_path().parent_path() / "validation" / (std::string(name) + ".csv"));
}

}  // namespace rill::bench
