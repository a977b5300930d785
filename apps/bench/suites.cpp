#include "bench/suites/suites.hpp"

namespace rill::bench {
namespace {

constexpr Suite kSuites[] = {
    {"device", "one report of a device: checks, variants, times by number of particles beside a prediction", runDevice},
    {"accuracy", "run time against density and trajectory error, with Pareto fronts and points of SPlisHSPlasH", runAccuracy},
    {"stability", "stress tests: degenerate starts, extreme forces, sizes and parameters, random scenes", runStability},
    {"sort", "counting and radix sort against std::sort, by number, range and order of the keys", runSort},
    {"graph", "CPU time to declare, compile, prepare and record a frame graph, with and without a cached plan", runGraph},
    {"speed", "time and memory per particle for 1,000 to 1,000,000 particles, per pass, with two baselines", runSpeed},
    {"traffic", "bytes, dispatches and barriers of a substep, counted, and the time that they take on a few cards", runTraffic},
    {"features", "cost of each feature when enabled and when disabled, passes that each scene runs", runFeatures},
    {"render", "surface reconstruction: time against error of normals on analytic surfaces", runRender},
    {"embed", "startup time of a host with and without a pipeline cache, device memory", runEmbed},
    {"validation", "published experiments and exact solutions, with an aim and a pass band per figure", runValidation},
    {"waves", "standing, solitary and leveling waves against theory; error against run time for a few settings", runWaves},
};

}  // namespace

std::span<const Suite> suites() { return kSuites; }

}  // namespace rill::bench
