#pragma once
#include "bench/bench.hpp"

namespace rill::bench {

Expected<Report> runDevice(Bench& bench);
Expected<Report> runAccuracy(Bench& bench);
Expected<Report> runStability(Bench& bench);
Expected<Report> runSort(Bench& bench);
Expected<Report> runGraph(Bench& bench);
Expected<Report> runSpeed(Bench& bench);
Expected<Report> runTraffic(Bench& bench);
Expected<Report> runFeatures(Bench& bench);
Expected<Report> runRender(Bench& bench);
Expected<Report> runValidation(Bench& bench);
Expected<Report> runEmbed(Bench& bench);
Expected<Report> runWaves(Bench& bench);

}  // namespace rill::bench
