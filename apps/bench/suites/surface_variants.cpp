#include "bench/suites/surface_variants.hpp"

#include "bench/report.hpp"

namespace rill::bench {
namespace {

/// Adds a variant of `from` for each value of one setting.
void vary(std::vector<SurfaceVariant>& all, const SurfaceVariant& from, const std::string& what, double SurfaceSettings::*member,
          std::initializer_list<double> values) {
  for (const double value : values) {
    SurfaceVariant variant = from;
    variant.setting = what + " " + number(value);
    variant.settings.*member = value;
    all.push_back(std::move(variant));
  }
}

}  // namespace

std::vector<SurfaceVariant> surfaceVariants(const Bilateral& bilateral, bool quick) {
  // Setting names: n: minimum samples per spacing; reach, sigma, range: spacings; time: spacings squared.
  const SurfaceVariant planes{"planes", "", SurfaceMethod::Planes}, flow{"curvature flow", "", SurfaceMethod::CurvatureFlow},
      narrow{"narrow range", "", SurfaceMethod::NarrowRange};
  const auto filtered = [&](std::string setting, const BilateralSettings& settings, double samples = SurfaceSettings{}.samples) {
    return SurfaceVariant{"bilateral", std::move(setting), SurfaceMethod::Auto, {.samples = samples, .filter = bilateral.filter(settings)}};
  };
  std::vector<SurfaceVariant> all{planes, flow, narrow, filtered("", {})};
  constexpr auto samples = &SurfaceSettings::samples, reach = &SurfaceSettings::fit_reach, time = &SurfaceSettings::flow_time,
                 sigma = &SurfaceSettings::narrow_sigma;
  vary(all, planes, "n", samples, {1.5, 6});
  vary(all, planes, "reach", reach, {1.8, 3.5});
  vary(all, flow, "n", samples, {1.5});
  vary(all, flow, "time", time, {0.5, 1.8});
  all.push_back(flow);
  all.back().setting = "no pyramid";
  all.back().settings.flow_levels = 0;
  vary(all, narrow, "n", samples, {6});
  vary(all, narrow, "sigma", sigma, {0.5, 1.3});
  all.push_back(filtered("sigma 2.2", {.sigma = 2.2}));
  all.push_back(filtered("full 2D", {.separable = false}));
  if (quick) return all;
  vary(all, narrow, "n", samples, {12});  // every pixel at a sphere radius of 10 pixels
  vary(all, planes, "reach", reach, {2.1, 3});
  vary(all, flow, "time", time, {0.3, 0.7, 1.3, 3});
  vary(all, narrow, "sigma", sigma, {1, 2.2});
  all.push_back(filtered("n 6", {}, 6));
  all.push_back(filtered("sigma 0.8", {.sigma = 0.8}));
  all.push_back(filtered("range 0.5", {.range = 0.5}));
  all.push_back(filtered("range 2", {.range = 2}));
  all.push_back(filtered("full 2D, sigma 2.2", {.sigma = 2.2, .separable = false}));
  return all;
}

}  // namespace rill::bench
