// Stress: every case asserts what must hold of any run, and its own.
#include <algorithm>
#include <cmath>

#include "bench/stability/stress_case.hpp"
#include "bench/suites/suites.hpp"

namespace rill::bench {
namespace {

constexpr uint64_t kQuickRandom = 6, kRandom = 200;

/// What did not hold of a run that was not refused; empty: all did.
std::string judged(const StressCase& c, const StressOutcome& o, uint64_t particles) {
  const RunFigures& run = o.run;
  for (const apps::Instant& instant : run.instants) {
    const offline::Stats& s = instant.stats;
    const std::string at = " at " + number(instant.time_s) + " s";
    if (s.particles != particles) return std::to_string(s.particles) + " particles of " + std::to_string(particles) + at;
    if (s.non_finite != c.parked) return std::to_string(s.non_finite) + " parked, " + std::to_string(c.parked) + " expected" + at;
    if (!std::isfinite(s.kinetic_J) || !std::isfinite(s.potential_J) || !std::isfinite(s.density_error_max))
      return "a figure is no number" + at;
    // Frame 0 is the start as it was placed.
    if (instant.time_s > 0 && s.outside > c.parked) return std::to_string(s.outside) + " outside" + at;
    if (!(s.max_speed <= c.maxSpeed)) return number(s.max_speed) + " m/s" + at + ", at most " + number(c.maxSpeed) + " expected";
  }
  for (size_t k = 0; k < o.particles.positions.size(); ++k) {
    const Float3 &p = o.particles.positions[k], &v = o.particles.velocities[k];
    if (!std::isfinite(p.x + p.y + p.z + v.x + v.y + v.z)) return "particle " + std::to_string(k) + " is no number";
  }
  if (!c.worked && !(run.energy.ratio <= c.maxEnergy) && std::isfinite(c.maxEnergy))
    return "energy rose to " + number(run.energy.ratio, 5) + " of the start's, " + number(c.maxEnergy, 4) + " expected";
  if (!run.messages.empty()) return "validation: " + run.messages.front();
  return c.own ? c.own(o) : std::string();
}

class Stability {
 public:
  explicit Stability(Bench& bench) : bench_(bench) {}

  Expected<Report> run() {
    std::vector<StressCase> cases;
    const auto add = [&](std::vector<StressCase> more) {
      for (StressCase& c : more)
        if (bench_.wanted(c.name) && (!c.full || !bench_.quick() || c.name == bench_.options().only)) cases.push_back(std::move(c));
    };
    add(startCases());
    add(forceCases());
    add(sizeCases());
    add(parameterCases());
    // One that is named is run, quick or not.
    add(randomCases(0, bench_.quick() && bench_.options().only.empty() ? kQuickRandom : kRandom));
    bench_.plan(cases.size());
    table_.title = "Stress";
    table_.columns = {"case", "particles", "substeps", "mean error", "max speed", "energy", "result"};
    table_.note =
        "Asserted of each: finite, count kept, inside the walls, speed bounded, energy at most 1.02 of the start's (not where solids or "
        "gravity do work, nor where the start overlaps), "
        "no validation message; and its own, in the JSON. A refusal in words passes where it is allowed.";
    for (const StressCase& c : cases) {
      if (bench_.stopped()) break;
      bench_.step(c.name);
      if (auto ran = runCase(c); !ran) return ran.error();
    }
    if (bench_.options().only.empty() && refused_ > cases.size() / 5)  // one alone may be one that is refused
      report_.failures.push_back(std::to_string(refused_) + " of " + std::to_string(cases.size()) +
                                 " cases were refused: that tries nothing");
    report_.tables.push_back(std::move(table_));
    return std::move(report_);
  }

 private:
  Expected<void> runCase(const StressCase& c) {
    StressOutcome outcome;
    const auto last = static_cast<uint64_t>(c.duration_s / c.frame_s + 1e-6);
    uint64_t seen = 0, particles = c.start ? c.start->positions.size() : 0;
    Expected<void> read;
    SceneRun run{.scene = c.scene, .start = c.start, .duration_s = c.duration_s, .frame_s = c.frame_s};
    run.validation = validation_;
    run.look = [&](offline::Simulation& simulation, double) {
      if (!c.start) particles = simulation.start().positions.size();
      if (seen++ < last) return;
      auto got = simulation.particles();
      if (got)
        outcome.particles = std::move(*got);
      else
        read = got.error();
    };
    auto ran = runScene(bench_, run);
    if (!ran && validation_ && ran.error().kind == ErrorKind::NoDevice) {
      validation_ = false;
      table_.note += "\nThe validation layer is not installed: not asserted.";
      return runCase(c);
    }
    if (bench_.stopped()) return {};  // a run that was cut short is no result
    Json json{{"case", c.name}, {"asserts", c.asserts}};
    std::string wrong;
    if (!ran || !read) {
      const Error& error = !ran ? ran.error() : read.error();
      const bool refused = error.kind == ErrorKind::BadInput || error.kind == ErrorKind::TooLarge;
      if (!refused && error.kind != ErrorKind::OutOfMemory) return error;
      json["refused"] = error.message;
      ++refused_;
      if (!(refused && c.mayRefuse)) wrong = "refused: " + error.message;
      table_.rows.push_back({c.name, "-", "-", "-", "-", "-", wrong.empty() ? "refused" : "FAILED"});
    } else {
      outcome.run = std::move(*ran);
      wrong = judged(c, outcome, particles);
      if (wrong.empty() && c.twice) wrong = again(c, outcome);
      if (wrong.empty() && c.like) wrong = alike(*c.like, c, outcome);
      json.update(runJson(outcome.run));
      double fastest = 0;
      for (const apps::Instant& instant : outcome.run.instants) fastest = std::max(fastest, instant.stats.max_speed);
      table_.rows.push_back({c.name, std::to_string(particles), std::to_string(outcome.run.substeps), percent(outcome.run.density.mean, 2),
                             number(fastest), number(outcome.run.energy.ratio, 5), wrong.empty() ? "holds" : "FAILED"});
    }
    json["holds"] = wrong.empty();
    if (!wrong.empty()) {
      json["found"] = wrong;
      report_.failures.push_back(c.name + ": " + wrong + " (alone: rill-bench stability --only " + c.name + ")");
    }
    report_.results.push_back(std::move(json));
    return {};
  }

  /// A second run gives the same bits, and the mean energy of the last quarter lies no higher than that of the third.
  std::string again(const StressCase& c, const StressOutcome& first) {
    auto second = runScene(bench_, {.scene = c.scene, .start = c.start, .duration_s = c.duration_s, .frame_s = c.frame_s});
    if (!second) return second.error().message;
    if (bench_.stopped()) return {};
    if (second->instants.back().stats.state_hash != first.run.instants.back().stats.state_hash) return "a second run gave other bits";
    const auto& all = first.run.instants;
    const auto energy = [](const apps::Instant& i) { return i.stats.kinetic_J + i.stats.potential_J; };
    const size_t quarter = all.size() / 4;
    double early = 0, late = 0;
    for (size_t k = 0; k < quarter; ++k) {
      early += energy(all[all.size() - 2 * quarter + k]) / double(quarter);
      late += energy(all[all.size() - quarter + k]) / double(quarter);
    }
    return !(late <= 1.001 * early) ? "energy rose from " + number(early, 6) + " to " + number(late, 6) + " J" : std::string();
  }

  std::string alike(Scene usual, const StressCase& c, const StressOutcome& outcome) {
    // A step is at most a frame of 1/60 s, which is short for what is large: as short here.
    constexpr double kDuration = 0.5;
    usual.solver.time_step = 1.0 / 60 * std::min(1.0, kDuration / c.duration_s);
    auto other = runScene(bench_, {.scene = usual, .duration_s = kDuration});
    if (!other) return other.error().message;
    if (bench_.stopped()) return {};
    if (!(outcome.run.density.mean <= 1.1 * other->density.mean))
      return "mean error " + percent(outcome.run.density.mean) + ", " + percent(other->density.mean) + " in the scene that it is like";
    if (!(std::abs(outcome.run.energy.end_ratio - other->energy.end_ratio) <= 0.02))
      return "energy at the end " + number(outcome.run.energy.end_ratio, 4) + " of the start's, " + number(other->energy.end_ratio, 4) +
             " in the scene that it is like";
    return {};
  }

  Bench& bench_;
  Report report_;
  Table table_;
  bool validation_ = true;
  size_t refused_ = 0;
};

}  // namespace

Expected<Report> runStability(Bench& bench) { return Stability(bench).run(); }

}  // namespace rill::bench
