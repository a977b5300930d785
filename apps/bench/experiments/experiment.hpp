#pragma once
// What an experiment is to the suite `validation`: a scene at one resolution, and figures beside what they should be.
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/experiments/measures.hpp"
#include "bench/scenes.hpp"

namespace rill::bench {

/// One figure of one run. Its aim and pass band lie in bands.cpp, under the experiment's family and this name.
struct Figure {
  std::string name;
  double measured = 0;
  double expected = std::numeric_limits<double>::quiet_NaN();  ///< NaN where only the error means something
  double error = 0;                                            ///< in one number: a fraction, or in the unit that bands.cpp names
};
Figure relativeFigure(std::string name, double measured, double expected);  ///< error: measured over expected, less 1
Figure plainFigure(std::string name, double error);                         ///< measured is the error

/// A curve for one of the suite's diagrams.
struct Overlay {
  std::string plot;  ///< key of validation.cpp
  Series series;
};

struct Outcome {
  std::vector<Figure> figures;
  Json curves = Json::object();  ///< whole, for whoever wants to draw them anew
  RunFigures run;
  std::vector<Overlay> overlays;
};

constexpr unsigned kLevels = 3;  ///< coarse, middle, fine

struct Experiment {
  std::string family;  ///< "slosh-0.5"
  unsigned level = 0;  ///< 0 .. kLevels - 1
  bool quick = false;  ///< part of --quick
  double spacing_m = 0;
  std::function<Expected<Outcome>(const Bench&)> run;
  std::string name() const;  ///< "slosh-0.5@0.05"
};

std::vector<Experiment> columnExperiments();  ///< Martin and Moyce: front, height
std::vector<Experiment> tankExperiments();    ///< a still tank; the bulk of a dam break
std::vector<Experiment> sloshExperiments();
std::vector<Experiment> ellipticExperiments();
std::vector<Experiment> freeExperiments();  ///< free fall; a drop's momentum
std::vector<Experiment> jetExperiments();

/// Runs a scene and calls `look` with the particles at the multiples of `frame_s` that `wanted` names.
Expected<RunFigures> watch(const Bench& bench, const Scene& scene, double duration_s, double frame_s,
                           const std::function<bool(double time_s)>& wanted, const std::function<void(const Cloud&, double time_s)>& look);

/// Points as [[x, y], ...].
Json curveJson(const std::vector<std::pair<double, double>>& curve);

}  // namespace rill::bench
