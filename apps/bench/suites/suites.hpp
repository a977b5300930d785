#pragma once
#include "bench/bench.hpp"

namespace rill::bench {

Expected<Report> runAccuracy(Bench& bench);
Expected<Report> runValidation(Bench& bench);

}  // namespace rill::bench
