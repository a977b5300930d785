#include "bench/suites/suites.hpp"

namespace rill::bench {
namespace {

constexpr Suite kSuites[] = {
    {"accuracy", "run time against error: density and trajectory, the Pareto front, a peer's points", runAccuracy},
    {"stability", "stress: odd starts, forces, sizes and parameters, random scenes; each asserted", runStability},
    {"sort", "the engine's two sorts against the standard library's, by count, by distinct keys, by order", runSort},
    {"graph", "CPU time that a frame takes to declare, compile, prepare and record, with its plan known and without", runGraph},
    {"speed", "what a particle costs, 1,000 to a million of them: in total, in each pass, in bytes; two baselines", runSpeed},
    {"features", "what each feature costs when it is on, that it costs nothing when off, which passes a scene runs", runFeatures},
    {"render", "surfaces from particles against analytic ones: ms against degrees", runRender},
    {"embed", "what a host pays: its start with and without a pipeline cache of its own, memory", runEmbed},
    {"validation", "published experiments and exact solutions, with an aim and a pass band for each figure", runValidation},
};

}  // namespace

std::span<const Suite> suites() { return kSuites; }

}  // namespace rill::bench
