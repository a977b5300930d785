#include "bench/suites/suites.hpp"

namespace rill::bench {
namespace {

constexpr Suite kSuites[] = {
    {"accuracy", "run time against error: density and trajectory, the Pareto front, a peer's points", runAccuracy},
    {"stability", "stress: odd starts, forces, sizes and parameters, random scenes; each asserted", runStability},
};

}  // namespace

std::span<const Suite> suites() { return kSuites; }

}  // namespace rill::bench
