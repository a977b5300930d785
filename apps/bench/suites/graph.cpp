// What the render graph costs the CPU: frames of plain copies by their number of passes, and a real frame with its picture.
#include <algorithm>
#include <array>

#include "bench/suites/suites.hpp"
#include "bench/workbench.hpp"
#include "offline/painter.hpp"
#include "rill/fluid.hpp"

namespace rill::bench {
namespace graph_suite {
namespace {

constexpr double kMaxCompile_us = 50;  ///< that the 40 passes may take to compile once their plan is known
constexpr double kMaxFrame_us = 100;   ///< that 20 passes may take the host: compiled, prepared and recorded
constexpr uint32_t kPasses[] = {5, 10, 20, 40};
constexpr uint32_t kSubsteps = 18;

/// A chain in which each pass copies from the one before and from four before: what was read last is soon free to be aliased.
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

/// A pass with a transient that is as large as before, or of another size each frame: then no plan is like the one before.
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

Expected<Samples> timed(Workbench& workbench, uint32_t count, bool plansKnown, const std::function<void(Graph&)>& declare) {
  constexpr uint32_t kWarmUp = 20;  // read-backs that nobody asks for are kept for 16 frames
  Samples samples;
  for (uint32_t k = 0; k < kWarmUp + count; ++k) {
    const auto time = workbench.run([&](Graph& graph) {
      declareMarker(graph, plansKnown || k % 2 == 0 ? 256 : 512);
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

/// A dam break, few particles of it: its passes are as many as those of a large one.
struct DamBreak {
  static Expected<std::unique_ptr<DamBreak>> open(Workbench& workbench) {
    auto scene = namedScene("dam-break", {{"fluid.particles", "3000"}});
    if (!scene) return scene.error();
    auto made = std::make_unique<DamBreak>();
    made->scene = std::move(*scene);
    auto start = makeParticles(made->scene);
    if (!start) return start.error();
    made->start = std::move(*start);
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
  std::unique_ptr<Fluid> fluid;
  offline::Painter painter{scene, start, 0};
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
  std::erase_if(cases, [&](const Case& c) { return !bench.wanted(c.name); });
  bench.plan(cases.size());

  Report report;
  Table table;
  table.title = "CPU time of a frame's graph, us (medians)";
  table.columns = {"case",    "passes", "declare",  "compile",     "plan new",    "new over known",
                   "prepare", "record", "together", "allocations", "of declaring"};
  table.note =
      "compile: the plan is that of the frame before; together: with it, compiled, prepared and recorded. plan new: the same where the "
      "frame before was another one.\n"
      "allocations: operator new in compiling, preparing and recording, the plan known; of declaring: of the modules whose passes they "
      "are.\n"
      "copies-N: N passes, each of which copies from two before it.\n"
      "advance: " +
      std::to_string(kSubsteps) + " substeps of dam-break; picture: its view final. Both in one graph in the last line";
  for (const Case& c : cases) {
    if (bench.stopped()) break;
    bench.step(c.name);
    const auto fresh = timed(*workbench, c.samples, false, c.declare);
    if (!fresh) return fresh.error();
    const auto known = timed(*workbench, c.samples, true, c.declare);
    if (!known) return known.error();
    uint32_t passes = 0;
    for (const PassReport& pass : workbench->passReport()) passes += pass.runs;
    const double compile = median(known->compile_us), planned = median(fresh->compile_us);
    const double together = compile + median(known->prepare_us) + median(known->record_us);
    table.rows.push_back({c.name, std::to_string(passes), number(median(known->declare_us)), number(compile), number(planned),
                          number(planned / compile), number(median(known->prepare_us)), number(median(known->record_us)), number(together),
                          std::to_string(known->graph_allocations), std::to_string(known->declare_allocations)});
    report.results.push_back({{"case", c.name},
                              {"passes", passes},
                              {"declare_us", sampled(known->declare_us)},
                              {"compile_us", sampled(known->compile_us)},
                              {"compile_new_us", sampled(fresh->compile_us)},
                              {"prepare_us", sampled(known->prepare_us)},
                              {"record_us", sampled(known->record_us)},
                              {"allocations", known->graph_allocations},
                              {"declare_allocations", known->declare_allocations}});
    if (passes <= kPasses[std::size(kPasses) - 1] && compile > kMaxCompile_us)
      report.failures.push_back(c.name + ": " + number(compile) + " us to compile a frame whose plan is known, above " +
                                number(kMaxCompile_us));
    if (passes <= 20 && together > kMaxFrame_us)
      report.failures.push_back(c.name + ": " + number(together) + " us to compile, prepare and record a frame of " +
                                std::to_string(passes) + " passes, above " + number(kMaxFrame_us));
    if (known->graph_allocations > 0)
      report.failures.push_back(c.name + ": the graph allocated " + std::to_string(known->graph_allocations) + " times in a frame");
  }
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace
}  // namespace graph_suite

Expected<Report> runGraph(Bench& bench) { return graph_suite::runAll(bench); }

}  // namespace rill::bench
