#include "bench/suites/suites.hpp"

namespace rill::bench {
namespace {

constexpr Suite kSuites[] = {
    {"accuracy", "run time against error: density and trajectory, the Pareto front, a peer's points", runAccuracy},
    {"validation", "published experiments and exact solutions, with an aim and a pass band for each figure", runValidation},
};

}  // namespace

std::span<const Suite> suites() { return kSuites; }

}  // namespace rill::bench
