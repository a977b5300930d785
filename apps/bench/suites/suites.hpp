#pragma once
#include "bench/bench.hpp"

namespace rill::bench {

Expected<Report> runAccuracy(Bench& bench);
Expected<Report> runStability(Bench& bench);

}  // namespace rill::bench
