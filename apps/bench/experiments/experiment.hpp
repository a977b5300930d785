#pragma once
// An experiment of the suite `validation`: a scene at one resolution, and measured figures with expected values.
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/experiments/measures.hpp"
#include "bench/scenes.hpp"

namespace rill::bench {

/// A measured figure. bands.cpp has its aim and pass band, by family and name.
struct Figure {
  std::string name;
  double measured = 0;
  double expected = std::numeric_limits<double>::quiet_NaN();  ///< NaN if only the error is meaningful
  double error = 0;                                            ///< a fraction, or in the unit given in bands.cpp
};
Figure relativeFigure(std::string name, double measured, double expected);  ///< error = measured / expected - 1
Figure plainFigure(std::string name, double error);                         ///< error = measured

/// A curve for one of the suite's diagrams.
struct Overlay {
  std::string plot;  ///< key of a diagram in validation.cpp
  Series series;
};

struct Outcome {
  std::vector<Figure> figures;
  Json curves = Json::object();  ///< complete curves for the JSON report
  RunFigures run;
  std::vector<Overlay> overlays;
};

constexpr unsigned kLevels = 3;  ///< coarse, medium, fine

struct Experiment {
  std::string family;  ///< "slosh-0.5"
  unsigned level = 0;  ///< 0 .. kLevels - 1
  bool quick = false;  ///< part of --quick
  double spacing_m = 0;
  std::function<Expected<Outcome>(const Bench&)> run;
  std::string name() const;  ///< "slosh-0.5@0.05"
};

std::vector<Experiment> columnExperiments();  ///< Martin and Moyce: front, height
std::vector<Experiment> tankExperiments();    ///< still tank; interior of a dam break
std::vector<Experiment> sloshExperiments();
std::vector<Experiment> ellipticExperiments();
std::vector<Experiment> freeExperiments();  ///< free fall; momentum of a drop
std::vector<Experiment> jetExperiments();
std::vector<Experiment> liftExperiments();        ///< lift of held solids
std::vector<Experiment> bodyExperiments();        ///< rigid bodies in water
std::vector<Experiment> sinkingExperiments();     ///< balls that sink and rise
std::vector<Experiment> slipExperiments();        ///< viscous fluid that sticks to walls, solids and bodies
std::vector<Experiment> shearExperiments();       ///< viscosity that depends on shear: plates, slumps
std::vector<Experiment> waterEntryExperiments();  ///< force on a wedge
std::vector<Experiment> tapExperiments();         ///< level of a tank that a tap fills
std::vector<Experiment> channelExperiments();     ///< laminar flow from an emitter to an open side
std::vector<Experiment> orificeExperiments();     ///< jet from a tank that is kept full
std::vector<Experiment> weirExperiments();        ///< discharge over a weir
std::vector<Experiment> lakeExperiments();        ///< a tank with regions that sleep, and without
std::vector<Experiment> jumpExperiments();        ///< depths of a hydraulic jump
std::vector<Experiment> mixtureExperiments();     ///< several fluids: layers, Rayleigh-Taylor, lock exchange, diffusion
std::vector<Experiment> oilDropExperiments();     ///< tension between liquids
std::vector<Experiment> bubbleExperiments();      ///< bubbles that rise in a thick liquid
std::vector<Experiment> crownExperiments();       ///< fingers of a crown
std::vector<Experiment> dropExperiments();        ///< surface tension: drops, rise between plates, threads
std::vector<Experiment> dropMotionExperiments();  ///< surface tension: spin, energy, mode 3 and waves
std::vector<Experiment> wettingExperiments();     ///< surface tension on plates and bodies
std::vector<Experiment> obstacleExperiments();    ///< dam breaks over meshes and over the exact shapes

/// Runs a scene and calls `onSample` with the particles at multiples of `frame_s` for which `sampledAt` returns true.
Expected<RunFigures> runSampled(const Bench& bench, const Scene& scene, double duration_s, double frame_s,
                                const std::function<bool(double time_s)>& sampledAt,
                                const std::function<void(const Cloud&, double time_s)>& onSample);

/// The figures of a scene that has run for some time, and its particles then.
struct Settled {
  RunFigures run;
  Cloud cloud;  ///< empty if the bench was stopped
};
Expected<Settled> settle(const Bench& bench, const Scene& scene, double duration_s, double frame_s);

/// Points as [[x, y], ...].
Json curveJson(const std::vector<std::pair<double, double>>& curve);

}  // namespace rill::bench
