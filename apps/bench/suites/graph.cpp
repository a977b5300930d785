// CPU cost of the render graph: frames of copy passes by their number, and a simulated and rendered frame.
#include <algorithm>
#include <array>
#include <optional>

#include "bench/suites/suites.hpp"
#include "bench/workbench.hpp"
#include "offline/painter.hpp"
#include "rill/fluid.hpp"

namespace rill::bench {
namespace graph_suite {
namespace {

constexpr double kMaxCompile_us = 50;  ///< limit of compiling up to 40 passes with a cached plan
constexpr double kMaxFrame_us = 100;   ///< limit of compiling, preparing and recording up to 20 passes
constexpr uint32_t kPasses[] = {5, 10, 20, 40};
constexpr uint32_t kSubsteps = 18;

/// A chain of passes that copy from the previous and the fourth previous pass, so that lifetimes are short and memory can be aliased.
void declareCopies(Graph& graph, uint32_t passes) {
  constexpr uint64_t kBytes = 4096;
  std::array<BufferRef, 64> made;
  for (uint32_t i = 0; i < passes; ++i)
    graph.pass("copy", [&](Pass& pass) {
      made[i] = pass.write(graph.create("copied", {2 * kBytes}), Use::CopyTarget);
      if (i + 1 == passes) pass.sideEffect();
      const BufferRef to = made[i], near = i >= 1 ? made[i - 1] : BufferRef{}, far = i >= 4 ? made[i - 4] : BufferRef{};
      for (const BufferRef& from : {near, far})
        if (from != BufferRef{}) pass.read(from, Use::CopySource);
      return [=](Commands& commands) {
        if (near == BufferRef{}) commands.fill(to, 1);
        if (near != BufferRef{}) commands.copy(near, to, kBytes);
        if (far != BufferRef{}) commands.copy(far, to, kBytes, 0, kBytes);
      };
    });
}

/// A pass with a transient buffer. A size that changes each frame invalidates the cached plan.
void declareMarker(Graph& graph, uint64_t bytes) {
  BufferRef marker = graph.create("bench marker", {bytes});
  graph.pass("bench marker", [&](Pass& pass) {
    marker = pass.write(marker, Use::CopyTarget);
    pass.sideEffect();
    return [marker](Commands& commands) { commands.fill(marker, 0); };
  });
}

struct Samples {
  std::vector<double> declare_us, compile_us, prepare_us, record_us;
  size_t declare_allocations = 0, graph_allocations = 0;  ///< of the last frame
};

Expected<Samples> timed(Workbench& workbench, uint32_t count, bool planCached, const std::function<void(Graph&)>& declare) {
  constexpr uint32_t kWarmUp = 20;  // unread read-backs are kept for 16 frames
  Samples samples;
  for (uint32_t k = 0; k < kWarmUp + count; ++k) {
    const auto time = workbench.run([&](Graph& graph) {
      declareMarker(graph, planCached || k % 2 == 0 ? 256 : 512);
      declare(graph);
    });
    if (!time) return time.error();
    if (k < kWarmUp) continue;
    const GraphTime::Host& host = time->host;
    samples.declare_us.push_back(host.declare_us);
    samples.compile_us.push_back(host.compile_us);
    samples.prepare_us.push_back(host.prepare_us);
    samples.record_us.push_back(host.record_us);
    samples.declare_allocations = host.declare_allocations;
    samples.graph_allocations = host.graph_allocations;
  }
  return samples;
}

/// A dam break with few particles: the number of passes does not depend on their number.
struct DamBreak {
  static Expected<std::unique_ptr<DamBreak>> open(Workbench& workbench) {
    auto scene = namedScene("dam-break", {{"fluid.particles", "3000"}});
    if (!scene) return scene.error();
    auto made = std::make_unique<DamBreak>();
    made->scene = std::move(*scene);
    auto start = makeParticles(made->scene);
    if (!start) return start.error();
    made->start = std::move(*start);
    made->scene.fluid.spacing = made->start.spacing;
    auto fluid = Fluid::create(workbench.device(), {.scene = &made->scene, .particles = &made->start});
    if (!fluid) return fluid.error();
    made->fluid = std::move(*fluid);
    if (auto ready = made->painter.prepare(workbench.device(), "final", kWidth, kHeight); !ready) return ready.error();
    return made;
  }
  void declare(Graph& graph, bool advances, bool draws) {
    const FluidState state = fluid->addTo(graph, {.advance_s = advances ? 1.0 / 60 : 0.0, .substeps = advances ? kSubsteps : 0});
    if (draws) (void)painter.declare(graph, state, "final", kWidth, kHeight, 0);
  }

  static constexpr uint32_t kWidth = 320, kHeight = 180;
  Scene scene;
  ParticleSet start;
  std::optional<Fluid> fluid;
  offline::Painter painter{scene, start};
};

Expected<Report> runAll(Bench& bench) {
  auto workbench = Workbench::open(bench);
  if (!workbench) return workbench.error();
  auto damBreak = DamBreak::open(*workbench);
  if (!damBreak) return damBreak.error();

  struct Case {
    std::string name;
    uint32_t samples;
    std::function<void(Graph&)> declare;
  };
  const uint32_t few = bench.quick() ? 5 : 15, many = bench.quick() ? 201 : 1001;
  std::vector<Case> cases;
  for (const uint32_t passes : kPasses)
    cases.push_back({"copies-" + std::to_string(passes), many, [passes](Graph& graph) { declareCopies(graph, passes - 1); }});
  const auto add = [&](std::string name, bool advances, bool draws) {
    cases.push_back({std::move(name), few, [&, advances, draws](Graph& graph) { (*damBreak)->declare(graph, advances, draws); }});
  };
  add("picture", false, true);
  add("advance", true, false);
  add("advance-and-picture", true, true);
  std::erase_if(cases, [&](const Case& c) { return !bench.selected(c.name); });
  bench.plan(cases.size());

  Report report;
  Table table;
  table.title = "CPU time of a frame graph, us (medians)";
  table.columns = {"case",    "passes", "declare", "compile",     "uncached",  "uncached / cached",
                   "prepare", "record", "total",   "allocations", "in declare"};
  table.note =
      "compile: with the cached plan of the previous frame. uncached: compile after a different frame.\n"
      "total: compile, prepare and record with a cached plan. allocations: calls of operator new in these; in declare: in the modules\n"
      "that declare the passes.\n"
      "copies-N: N passes that copy from two previous passes each. advance: " +
      std::to_string(kSubsteps) + " substeps of dam-break. picture: its view final.";
  for (const Case& c : cases) {
    if (bench.stopped()) break;
    bench.step(c.name);
    const auto uncached = timed(*workbench, c.samples, false, c.declare);
    if (!uncached) return uncached.error();
    const auto cached = timed(*workbench, c.samples, true, c.declare);
    if (!cached) return cached.error();
    uint32_t passes = 0;
    for (const PassReport& pass : workbench->passReport()) passes += pass.runs;
    const double compile = median(cached->compile_us), planned = median(uncached->compile_us);
    const double total = compile + median(cached->prepare_us) + median(cached->record_us);
    table.rows.push_back({c.name, std::to_string(passes), number(median(cached->declare_us)), number(compile), number(planned),
                          number(planned / compile), number(median(cached->prepare_us)), number(median(cached->record_us)), number(total),
                          std::to_string(cached->graph_allocations), std::to_string(cached->declare_allocations)});
    report.results.push_back({{"case", c.name},
                              {"passes", passes},
                              {"declare_us", sampleStatistics(cached->declare_us)},
                              {"compile_us", sampleStatistics(cached->compile_us)},
                              {"compile_new_us", sampleStatistics(uncached->compile_us)},
                              {"prepare_us", sampleStatistics(cached->prepare_us)},
                              {"record_us", sampleStatistics(cached->record_us)},
                              {"allocations", cached->graph_allocations},
                              {"declare_allocations", cached->declare_allocations}});
    if (passes <= kPasses[std::size(kPasses) - 1] && compile > kMaxCompile_us)
      report.failures.push_back(c.name + ": compile with a cached plan: found " + number(compile) + " us, expected at most " +
                                number(kMaxCompile_us));
    if (passes <= 20 && total > kMaxFrame_us)
      report.failures.push_back(c.name + ": compile, prepare and record " + std::to_string(passes) + " passes: found " + number(total) +
                                " us, expected at most " + number(kMaxFrame_us));
    if (cached->graph_allocations > 0)
      report.failures.push_back(c.name + ": found " + std::to_string(cached->graph_allocations) +
                                " allocations of the graph in a frame, expected none");
  }
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace
}  // namespace graph_suite

Expected<Report> runGraph(Bench& bench) { return graph_suite::runAll(bench); }

}  // namespace rill::bench
