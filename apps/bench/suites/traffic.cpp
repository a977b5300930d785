// What a substep makes a GPU read, write, dispatch and wait for, and how long a frame takes by that on a few cards. Counted on any device.
#include <cmath>

#include "bench/suites/suites.hpp"
#include "bench/traffic/fluid_traffic.hpp"
#include "core/words.hpp"

namespace rill::bench {
namespace traffic_suite {
namespace {

constexpr double kFrame_s = 1.0 / 60;
constexpr int kFramesBefore = 12;  // fluid in motion, with lists that were rebuilt
constexpr int kFrames = 4;         // counted, as one advance
constexpr double kCounts[] = {50e3, 200e3, 1e6, 4e6};

struct Case {
  const char *name, *scene;
  std::vector<Override> changes;
};

std::vector<Case> cases() {
  return {{"dam50k", "dam50k", {}},
          {"box-and-sphere", "box-and-sphere", {}},
          {"dam-break", "dam-break", {{"fluid.viscosity", "0.5"}}},
          {"all passes", "box-and-sphere", allPasses()}};
}

Expected<FluidTraffic> measure(Bench& bench, const Scene& scene) {
  auto workbench = Workbench::open(bench);
  if (!workbench) return workbench.error();
  const auto start = makeParticles(scene);
  if (!start) return start.error();
  auto fluid = Fluid::create(workbench->device(), {.scene = &scene, .particles = &*start, .mergePasses = true});  // as on a GPU
  if (!fluid) return fluid.error();
  for (int frame = 0; frame < kFramesBefore && !bench.stopped(); ++frame)
    if (auto advanced = advanceFluid(*workbench, *fluid, kFrame_s); !advanced) return advanced.error();
  // As many substeps at once as the frame before took: what a host records that knows its scene.
  return measureTraffic(*workbench, *fluid, kFrames * kFrame_s, fluid->progress().substeps);
}

std::string perSubstep(double total, double substeps) { return number(total / substeps); }

Table passTable(const std::string& name, const FluidTraffic& t) {
  Table table{name + ": passes of four frames, per substep",
              {"pass", "part", "recorded", "with effect", "barriers", "read, B", "written, B", "gathered, B", "serial"},
              {},
              "recorded: dispatches, fills and copies per recorded substep; with effect: those with workgroups, per executed substep.\n"
              "read, written, gathered: bytes per particle and executed substep; gathered: through the neighbor list, mostly from caches.\n"
              "serial: dispatch commands that one invocation writes."};
  const auto row = [&](const std::string& label, const PassTraffic& pass) {
    const double each = double(t.particles) * t.substeps;
    table.rows.push_back({label, std::string(sectionName(pass.section)), perSubstep(double(pass.recorded), t.recordedSubsteps),
                          perSubstep(double(pass.executed), t.substeps), perSubstep(double(pass.barriers), t.recordedSubsteps),
                          number(pass.readBytes / each), number(pass.writtenBytes / each), number(pass.gatheredBytes / each),
                          pass.serialCommands ? std::to_string(pass.serialCommands) : "-"});
  };
  for (const Section section : {Section::Start, Section::Rebuild, Section::Substep}) {
    for (const PassTraffic& pass : t.passes)
      if (pass.section == section) row(pass.name, pass);
    row("total", t.total(section));
  }
  return table;
}

/// A frame of the same scene with another number of particles: substeps grow with its cube root.
double predictedFrame_ms(const Card& card, const FluidTraffic& t, double particles) {
  const double substeps = t.substeps / kFrames * std::cbrt(particles / double(t.particles));
  return 1e3 * predictedSeconds(card, frameWork(t, particles, substeps));
}

Table cardTable(const std::string& name, const FluidTraffic& t) {
  Table table{
      name + ": predicted ms per frame of 1/60 s",
      {"card", "GB/s"},
      {},
      "From the bandwidth of the memory and the latency of dispatches and barriers alone, see docs/notes/traffic.md. Other numbers of\n"
      "particles: the same scene; substeps grow with the cube root."};
  for (const double count : kCounts) table.columns.push_back(grouped(static_cast<uint64_t>(count)));
  for (const Card& card : cards()) {
    std::vector<std::string> row{std::string(card.name), number(card.bandwidth_GBps)};
    for (const double count : kCounts) row.push_back(number(predictedFrame_ms(card, t, count)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Json json(const std::string& name, const FluidTraffic& t) {
  Json json{{"case", name},       {"particles", t.particles},     {"substeps", t.substeps}, {"recorded_substeps", t.recordedSubsteps},
            {"builds", t.builds}, {"list_entries", t.listEntries}};
  const double each = double(t.particles) * t.substeps;
  for (const Section section : {Section::Start, Section::Rebuild, Section::Substep}) {
    const PassTraffic sum = t.total(section);
    json["parts"][std::string(sectionName(section))] = {{"dispatches_recorded", sum.recorded},
                                                        {"dispatches_executed", sum.executed},
                                                        {"barriers", sum.barriers},
                                                        {"bytes_per_particle_substep", sum.bytes() / each}};
  }
  for (const PassTraffic& pass : t.passes)
    json["passes"].push_back({{"name", pass.name},
                              {"part", sectionName(pass.section)},
                              {"dispatches_recorded", pass.recorded},
                              {"dispatches_executed", pass.executed},
                              {"barriers", pass.barriers},
                              {"read_bytes", pass.readBytes},
                              {"written_bytes", pass.writtenBytes},
                              {"gathered_bytes", pass.gatheredBytes},
                              {"serial_commands", pass.serialCommands}});
  for (const Card& card : cards())
    for (const double count : kCounts)
      json["predicted_ms"][std::string(card.name)][std::to_string(static_cast<uint64_t>(count))] = predictedFrame_ms(card, t, count);
  return json;
}

Expected<Report> runAll(Bench& bench) {
  std::vector<Case> chosen;
  for (const Case& c : cases())
    if (bench.selected(c.name)) chosen.push_back(c);
  bench.plan(chosen.size());
  Report report;
  Table summary{
      "A substep, its share of the rebuilds apart",
      {"scene", "particles", "bytes", "rebuild, B", "dispatches", "with effect", "barriers", "entries", "substeps", "recorded", "builds"},
      {},
      "bytes: read and written per particle and substep. dispatches, barriers: per recorded substep. entries: of the neighbor list per\n"
      "particle. substeps, recorded, builds: of four frames of 1/60 s."};
  std::vector<Table> details;
  for (const Case& c : chosen) {
    if (bench.stopped()) break;
    bench.step(c.name);
    std::vector<Override> changes = c.changes;
    if (bench.quick()) changes.push_back({"fluid.particles", "3000"});
    const auto scene = namedScene(c.scene, changes);
    if (!scene) return scene.error();
    const auto traffic = measure(bench, *scene);
    if (!traffic) return traffic.error();
    if (bench.stopped()) break;
    const PassTraffic substep = traffic->total(Section::Substep);
    summary.rows.push_back(
        {c.name, grouped(traffic->particles), number(traffic->bytesPerParticleSubstep(Section::Substep)),
         number(traffic->bytesPerParticleSubstep(Section::Rebuild)), perSubstep(double(substep.recorded), traffic->recordedSubsteps),
         perSubstep(double(substep.executed), traffic->substeps), perSubstep(double(substep.barriers), traffic->recordedSubsteps),
         number(traffic->listEntries), number(traffic->substeps), number(traffic->recordedSubsteps), number(traffic->builds)});
    details.push_back(passTable(c.name, *traffic));
    details.push_back(cardTable(c.name, *traffic));
    report.results.push_back(json(c.name, *traffic));
  }
  if (!summary.rows.empty()) report.tables.push_back(std::move(summary));
  for (Table& table : details) report.tables.push_back(std::move(table));
  return report;
}

}  // namespace
}  // namespace traffic_suite

Expected<Report> runTraffic(Bench& bench) { return traffic_suite::runAll(bench); }

}  // namespace rill::bench
