// Stress tests: common checks of every run, and checks specific to a case.
#include <algorithm>
#include <cmath>

#include "bench/stability/stress_case.hpp"
#include "bench/suites/suites.hpp"

namespace rill::bench {
namespace {

constexpr uint64_t kQuickRandom = 2, kRandom = 200;

/// Returns the first failed check of a run; empty if all passed.
std::string firstFailure(const StressCase& c, const StressOutcome& o, uint64_t particles) {
  const RunFigures& run = o.run;
  for (const apps::Instant& instant : run.instants) {
    const offline::Stats& s = instant.stats;
    const std::string at = " at " + number(instant.time_s) + " s";
    const FluidLedger& l = s.ledger;
    const bool flows = hasEmitters(c.scene) || !c.scene.drains.empty() || hasRemovingSides(c.scene);
    const uint64_t expected = flows ? particles + l.emitted - l.drained - l.left - l.inactive : particles;
    if (s.particles != expected)
      return "particles" + at + ": found " + std::to_string(s.particles) + ", expected " + std::to_string(expected);
    if (s.nonFinite != c.inactive)
      return "inactive particles" + at + ": found " + std::to_string(s.nonFinite) + ", expected " + std::to_string(c.inactive);
    if (!std::isfinite(s.kinetic_J) || !std::isfinite(s.potential_J) || !std::isfinite(s.densityErrorMax))
      return "energy or density error is not finite" + at;
    // Frame 0 is the unmodified initial state.
    if (instant.time_s > 0 && s.outside > c.inactive)
      return "particles outside the walls" + at + ": found " + std::to_string(s.outside) + ", expected at most " +
             std::to_string(c.inactive);
    if (!(s.maxSpeed <= c.maxSpeed))
      return "speed" + at + ": found " + number(s.maxSpeed) + " m/s, expected at most " + number(c.maxSpeed) + " m/s";
  }
  for (size_t k = 0; k < o.particles.positions.size(); ++k) {
    const Float3 &p = o.particles.positions[k], &v = o.particles.velocities[k];
    if (!std::isfinite(p.x + p.y + p.z + v.x + v.y + v.z)) return "particle " + std::to_string(k) + " is not finite";
  }
  if (!c.externalWork && !(run.energy.ratio <= c.maxEnergy) && std::isfinite(c.maxEnergy))
    return "energy / initial energy: found " + number(run.energy.ratio, 5) + ", expected at most " + number(c.maxEnergy, 4);
  if (!run.messages.empty()) return "validation layer: " + run.messages.front();
  return c.check ? c.check(o) : std::string();
}

class Stability {
 public:
  explicit Stability(Bench& bench) : bench_(bench) {}

  Expected<Report> run() {
    std::vector<StressCase> cases;
    const auto add = [&](std::vector<StressCase> more) {
      for (StressCase& c : more)
        if (bench_.selected(c.name) && (!c.fullOnly || !bench_.quick() || c.name == bench_.options().only)) cases.push_back(std::move(c));
    };
    add(startCases());
    add(forceCases());
    add(bodyCases());
    add(flowCases());
    add(sizeCases());
    add(parameterCases());
    // --only runs any random case, with --quick too.
    add(randomCases(0, bench_.quick() && bench_.options().only.empty() ? kQuickRandom : kRandom));
    bench_.plan(cases.size());
    table_.title = "Stress tests";
    table_.columns = {"case", "particles", "substeps", "mean error", "max speed", "energy", "result"};
    table_.note =
        "Checks of every case: values finite, no particle lost or outside the walls, speed bounded, energy no validation\n"
        "messages, energy at most 1.02 of the initial energy (not checked where solids or gravity do work; higher limits where the "
        "initial\n"
        "state overlaps). The JSON lists checks of single cases. rejected: the scene was rejected with an error message, which is a valid "
        "result of the case.";
    for (const StressCase& c : cases) {
      if (bench_.stopped()) break;
      bench_.step(c.name);
      if (auto done = runCase(c); !done) return done.error();
    }
    if (bench_.options().only.empty() && rejected_ > cases.size() / 5)  // a single selected case may be a rejected one
      report_.failures.push_back("rejected cases: found " + std::to_string(rejected_) + " of " + std::to_string(cases.size()) +
                                 ", expected at most a fifth");
    report_.tables.push_back(std::move(table_));
    return std::move(report_);
  }

 private:
  Expected<void> runCase(const StressCase& c) {
    StressOutcome outcome;
    const auto last = static_cast<uint64_t>(c.duration_s / c.frame_s + 1e-6);
    uint64_t frame = 0, particles = c.start ? c.start->positions.size() : 0;
    Expected<void> read;
    SceneRun run{.scene = c.scene, .start = c.start, .duration_s = c.duration_s, .frame_s = c.frame_s};
    run.validation = validation_;
    run.onFrame = [&](offline::Simulation& simulation, double) {
      if (!c.start) particles = simulation.start().positions.size();
      if (frame++ < last) return;
      auto state = simulation.particles();
      if (state)
        outcome.particles = std::move(*state);
      else
        read = state.error();
    };
    auto ran = runScene(bench_, run);
    if (!ran && validation_ && ran.error().kind == ErrorKind::NoDevice) {
      validation_ = false;
      table_.note += "\nThe validation layer is not installed; its messages were not checked.";
      return runCase(c);
    }
    if (bench_.stopped()) return {};  // incomplete runs are not results
    Json json{{"case", c.name}, {"asserts", c.asserts}};
    std::string failure;
    if (!ran || !read) {
      const Error& error = !ran ? ran.error() : read.error();
      const bool rejected = error.kind == ErrorKind::BadInput || error.kind == ErrorKind::TooLarge;
      if (!rejected && error.kind != ErrorKind::OutOfMemory) return error;
      json["refused"] = error.message;
      ++rejected_;
      if (!(rejected && c.mayBeRejected)) failure = "rejected: " + error.message;
      table_.rows.push_back({c.name, "-", "-", "-", "-", "-", failure.empty() ? "rejected" : "FAILED"});
    } else {
      outcome.run = std::move(*ran);
      failure = firstFailure(c, outcome, particles);
      if (failure.empty() && c.checksRepeat) failure = checkRepeat(c, outcome);
      if (failure.empty() && c.reference) failure = compareWithReference(*c.reference, c, outcome);
      json.update(runJson(outcome.run));
      double fastest = 0;
      for (const apps::Instant& instant : outcome.run.instants) fastest = std::max(fastest, instant.stats.maxSpeed);
      table_.rows.push_back({c.name, std::to_string(particles), std::to_string(outcome.run.substeps), percent(outcome.run.density.mean, 2),
                             number(fastest), number(outcome.run.energy.ratio, 5), failure.empty() ? "passed" : "FAILED"});
    }
    json["holds"] = failure.empty();
    if (!failure.empty()) {
      json["found"] = failure;
      report_.failures.push_back(c.name + ": " + failure + " (to reproduce: rill-bench stability --only " + c.name + ")");
    }
    report_.results.push_back(std::move(json));
    return {};
  }

  /// Checks that a second run gives the same bits, and that the mean energy does not rise from the third to the last quarter.
  std::string checkRepeat(const StressCase& c, const StressOutcome& first) {
    auto second = runScene(bench_, {.scene = c.scene, .start = c.start, .duration_s = c.duration_s, .frame_s = c.frame_s});
    if (!second) return second.error().message;
    if (bench_.stopped()) return {};
    if (second->instants.back().stats.stateHash != first.run.instants.back().stats.stateHash) return "state hash: two runs differ";
    const auto& all = first.run.instants;
    const auto energy = [](const apps::Instant& i) { return i.stats.kinetic_J + i.stats.potential_J; };
    const size_t quarter = all.size() / 4;
    double early = 0, late = 0;
    for (size_t k = 0; k < quarter; ++k) {
      early += energy(all[all.size() - 2 * quarter + k]) / double(quarter);
      late += energy(all[all.size() - quarter + k]) / double(quarter);
    }
    return !(late <= 1.001 * early) ? "mean energy of the last quarter: found " + number(late, 6) +
                                          " J, expected at most that of the third, " + number(early, 6) + " J"
                                    : std::string();
  }

  std::string compareWithReference(Scene reference, const StressCase& c, const StressOutcome& outcome) {
    // Steps are limited to a frame of 1/60 s, which is relatively shorter for large scenes; scale the limit equally.
    constexpr double kDuration = 0.5;
    reference.solver.time_step = 1.0 / 60 * std::min(1.0, kDuration / c.duration_s);
    auto other = runScene(bench_, {.scene = reference, .duration_s = kDuration});
    if (!other) return other.error().message;
    if (bench_.stopped()) return {};
    // Rounding alone: spacings of 49, 50 and 51 m have errors of 1.01, 1.10 and 1.01 times the reference's.
    constexpr double kErrorScatter = 1.25, kEnergyScatter = 0.02;
    if (!(outcome.run.density.mean <= kErrorScatter * other->density.mean))
      return "mean error: found " + percent(outcome.run.density.mean) + ", expected at most " + number(kErrorScatter) +
             " times that of the reference scene, " + percent(other->density.mean);
    if (!(std::abs(outcome.run.energy.end_ratio - other->energy.end_ratio) <= kEnergyScatter))
      return "final energy / initial energy: found " + number(outcome.run.energy.end_ratio, 4) + ", expected within " +
             number(kEnergyScatter) + " of the reference scene, " + number(other->energy.end_ratio, 4);
    return {};
  }

  Bench& bench_;
  Report report_;
  Table table_;
  bool validation_ = true;
  size_t rejected_ = 0;
};

}  // namespace

Expected<Report> runStability(Bench& bench) { return Stability(bench).run(); }

}  // namespace rill::bench
