#include "bench/suites/wave_groups.hpp"

#include <cmath>
#include <limits>

#include "bench/experiments/energy_budget.hpp"

namespace rill::bench {
namespace {

std::vector<std::string> standingRow(const WaveResult& r, const std::vector<WaveResult>&) {
  const Figure& period = r.figure("period");
  return {number(period.expected, 4),
          number(period.measured, 4),
          percent(period.error, 2),
          percent(-r.outcome.curves["second_order"].get<double>(), 2),
          percent(r.figure("loss a period").measured, 2),
          percent(r.residual(), 2)};
}

std::vector<std::string> viscousRow(const WaveResult& r, const std::vector<WaveResult>& group) {
  const Figure& decay = r.figure("decay");
  // Without viscosity, whatever the wave loses is the solver's.
  const auto base = std::ranges::find_if(group, [](const WaveResult& other) { return other.figure("decay").expected == 0; });
  const double excess = base == group.end() ? std::numeric_limits<double>::quiet_NaN() : decay.measured - base->figure("decay").measured;
  return {percent(r.figure("period").error, 2), percent(r.figure("loss a period").measured, 2), number(decay.measured), number(excess),
          number(decay.expected)};
}

std::vector<std::string> solitaryRow(const WaveResult& r, const std::vector<WaveResult>&) {
  const Figure &speed = r.figure("speed"), &height = r.figure("height kept");
  return {number(speed.expected, 4), number(speed.measured, 4), percent(speed.error, 2), percent(r.figure("speed at its height").error, 2),
          percent(height.measured / height.expected)};
}

std::vector<std::string> levelRow(const WaveResult& r, const std::vector<WaveResult>&) {
  const Figure& shift = r.figure("shift");
  return {number(1e3 * shift.expected), number(1e3 * shift.measured), number(shift.measured / shift.expected)};
}

std::vector<std::string> energyColumns() {
  std::vector<std::string> columns{"wave", "noise", "other potential"};
  columns.insert(columns.end(), std::begin(kTermNames), std::end(kTermNames));
  return columns;
}

std::vector<std::string> energyRow(const WaveResult& r, const std::vector<WaveResult>&) {
  std::vector<std::string> cells;
  for (const char* kind : {"wave", "noise", "other_potential"}) cells.push_back(percent(r.outcome.curves["energy"][kind].get<double>(), 2));
  for (const char* term : kTermNames) cells.push_back(percent(r.outcome.curves["work"][term].get<double>(), 2));
  return cells;
}

}  // namespace

std::vector<WaveGroup> waveGroups() {
  return {
      {"Standing waves, default settings",
       standingWaveExperiments(),
       {"theory s", "period s", "error", "2nd order", "loss a period", "residual"},
       standingRow,
       "theory: omega^2 = g k tanh(k h). 2nd order: error that the theory itself has at this amplitude (Tadjbakhsh and Keller 1960).\n"
       "Loss: share of the amplitude, from a damped cosine fitted to the projection of all particles on cos(k x). Residual: what the\n"
       "fit leaves, rms over rms."},
      {"Decay with viscosity, deep tank of 0.1 m, mode 1",
       viscousWaveExperiments(),
       {"period error", "loss a period", "decay 1/s", "excess 1/s", "theory 1/s"},
       viscousRow,
       "decay: of the amplitude. Excess: over the case without viscosity, whose decay is the solver's own. Theory: 2 nu k^2 for\n"
       "frictionless walls (Lamb, Hydrodynamics, section 348) and the next order. Viscosity also damps the noise that takes the solver's\n"
       "own share, so the two do not simply add: a right viscosity has its theory between excess and decay. An excess below the scatter\n"
       "of the solver's own decay says nothing."},
      {"Solitary wave, 0.3 depths high, over 20 depths",
       solitaryWaveExperiments(),
       {"theory m/s", "speed m/s", "error", "at its height", "height kept"},
       solitaryRow,
       "theory: sqrt(g (h + a)); measured over the last 18 depths. At its height: error against the theory's speed at the heights that\n"
       "the wave had. Height: of the surface in a Hann window two depths wide, mean over the last two depths against the start. The\n"
       "crest is followed from frame to frame."},
      {"Leveling of a tilted tank",
       levelExperiments(),
       {"hydrostatic mm", "shift mm", "share"},
       levelRow,
       "Shift of the center of mass, mean over two periods of the slosh around 8 s (Hann window)."},
      {"Energy of a slosh after a period, in shares of its start: what is left, and the work of each term", energyBudgetExperiments(),
       energyColumns(), energyRow,
       "Reference solver (one core), deep tank, mode 1, from the rest lattice with the wave's speeds. wave: in the particles' velocities\n"
       "and the surface, projected on the wave. noise: other kinetic energy. wave + noise + other potential energy = 100 % + the work\n"
       "of all terms."},
      {"Settings of the solver, deep tank, mode 1", waveSettingExperiments(), {}, {}, ""}};
}

}  // namespace rill::bench
