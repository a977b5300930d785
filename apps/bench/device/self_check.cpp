#include "bench/device/self_check.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "bench/workbench.hpp"
#include "core/words.hpp"
#include "fluid/settings.hpp"
#include "fluid/snapshot_words.hpp"
#include "reference/solver.hpp"
#include "sort/key_sort.hpp"

namespace rill::bench {
namespace {

constexpr uint32_t kCheckParticles = 3000, kCheckKeys = 100'000;
constexpr double kCheckFrame_s = 1.0 / 60;
constexpr int kCheckFrames = 10;
constexpr double kDensityTolerance = 1e-4;  // of the rest density: single against double precision

Expected<Scene> checkScene() { return namedScene("dam-break", {{"fluid.particles", std::to_string(kCheckParticles)}}); }

Expected<offline::Simulation> checkedRun(const Bench& bench, int frames, uint32_t substepsPerSubmit = 0) {
  auto scene = checkScene();
  if (!scene) return scene.error();
  offline::Options options = simulationOptions(bench);
  options.substepsPerSubmit = substepsPerSubmit;
  auto simulation = offline::Simulation::open(std::move(*scene), options);
  if (!simulation) return simulation.error();
  for (int k = 0; k < frames; ++k)
    if (auto advanced = simulation->advance(kCheckFrame_s); !advanced) return advanced.error();
  return simulation;
}

Expected<CheckResult> sortsLikeHost(const Bench& bench, SortMethod method) {
  auto workbench = Workbench::open(bench);
  if (!workbench) return workbench.error();
  std::mt19937 random(7);
  std::vector<uint32_t> keys(kCheckKeys), expected(kCheckKeys);
  for (uint32_t& key : keys) key = uint32_t(random()) % (kCheckKeys / 4);
  std::iota(expected.begin(), expected.end(), 0u);
  std::ranges::stable_sort(expected, {}, [&](uint32_t k) { return keys[k]; });
  const auto uploaded = workbench->upload("bench keys", std::span<const uint32_t>(keys));
  if (!uploaded) return uploaded.error();
  const auto order = workbench->make("bench order", kCheckKeys * sizeof(uint32_t));
  if (!order) return order.error();
  auto sort = KeySort::create(workbench->device(), {.count = kCheckKeys, .keyRange = kCheckKeys / 4, .method = method});
  if (!sort) return sort.error();
  const auto ran = workbench->run([&](Graph& graph) {
    (void)sort->addTo(graph, importWhole(graph, "bench keys", *uploaded),
                      {.order = importWhole(graph, "bench order", *order), .start = {}, .keys = {}});
  });
  if (!ran) return ran.error();
  const auto found = workbench->download<uint32_t>(*order);
  if (!found) return found.error();
  size_t wrong = 0;
  for (uint32_t k = 0; k < kCheckKeys; ++k) wrong += (*found)[k] != expected[k];
  return CheckResult{"", wrong == 0, grouped(wrong) + " of " + grouped(kCheckKeys) + " places differ from std::stable_sort", "0"};
}

Expected<CheckResult> countingSort(const Bench& bench) { return sortsLikeHost(bench, SortMethod::Counting); }
Expected<CheckResult> radixSort(const Bench& bench) { return sortsLikeHost(bench, SortMethod::Radix); }

/// Of particles and their images, from the device's positions, in double precision.
Expected<CheckResult> densityMatches(const Bench& bench) {
  auto simulation = checkedRun(bench, kCheckFrames);
  if (!simulation) return simulation.error();
  const auto stats = simulation->stats();
  if (!stats) return stats.error();
  const auto particles = simulation->particles();
  if (!particles) return particles.error();
  const Scene& scene = simulation->scene();
  reference::ReferenceSettings settings;
  settings.kernel = scene.solver.kernel;
  settings.spacing = simulation->start().spacing;
  settings.smoothingRatio = scene.fluid.smoothing_ratio;
  settings.density = scene.fluid.density;
  settings.tabulated = true;
  settings.startTime = stats->time_s;
  settings.meltingTime = meltingTime(scene);
  for (int a = 0; a < 3; ++a) {
    if (!(scene.domain->open & (1u << (2 * a)))) settings.lo[a] = scene.domain->min[a];
    if (!(scene.domain->open & (2u << (2 * a)))) settings.hi[a] = scene.domain->max[a];
  }
  std::vector<glm::dvec3> places;
  for (const Float3& x : particles->positions) places.emplace_back(x.x, x.y, x.z);
  reference::ReferenceSolver solver(settings, places);
  solver.density();
  double worst = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    const double difference = std::abs(particles->densities[i] / scene.fluid.density - solver.densityRatio()[i]);
    worst = std::max(worst, std::isfinite(difference) ? difference : HUGE_VAL);
  }
  return CheckResult{"", worst <= kDensityTolerance, "largest difference " + percent(worst) + " of the rest density",
                     "at most " + percent(kDensityTolerance)};
}

/// Each pair that was within the support when the lists were built is in both.
Expected<CheckResult> neighborLists(const Bench& bench) {
  auto simulation = checkedRun(bench, kCheckFrames);
  if (!simulation) return simulation.error();
  const double spacing = simulation->start().spacing, support = simulation->scene().fluid.smoothing_ratio * spacing;
  for (int extra = 0; extra < 20; ++extra) {
    const auto checkpoint = simulation->checkpoint();
    if (!checkpoint) return checkpoint.error();
    const FluidSnapshot& state = checkpoint->fluid;
    // Two particles have come nearer by twice the travel since, at most. An old list says little, and one that is due is not saved.
    const double reach = support - 2 * double{readRecord<FluidControl>(state.control).travel};
    if (state.neighborCount.empty() || reach < 1.2 * spacing) {
      if (auto advanced = simulation->advance(kCheckFrame_s / 8); !advanced) return advanced.error();
      continue;
    }
    size_t missing = 0, pairs = 0, first = 0;
    for (size_t i = 0; i < state.position.size(); ++i) {
      const bool listed = state.neighborCount[i] <= state.listCapacity;
      const auto list = std::span(state.neighbors).subspan(first, listed ? state.neighborCount[i] : 0);
      const auto images = std::ranges::find_if(list, [](uint32_t j) { return j > kImageOfNeighbors; });  // behind walls
      first += list.size();
      for (size_t j = 0; listed && j < state.position.size(); ++j) {
        const Float3 &a = state.position[i], &b = state.position[j];
        if (i == j || std::hypot(double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z) >= reach) continue;
        ++pairs;
        missing += std::find(list.begin(), images, uint32_t(j)) == images;
      }
    }
    return CheckResult{"", missing == 0 && pairs > state.position.size(),
                       grouped(missing) + " of " + grouped(pairs) + " neighbors are not in the list", "0"};
  }
  return CheckResult{"", false, "no valid neighbor list at the end of 20 advances", "one"};
}

/// Equal bits, whatever pieces an advance is submitted in.
Expected<CheckResult> sameBits(const Bench& bench) {
  uint64_t hashes[2];
  for (int run = 0; run < 2; ++run) {
    auto simulation = checkedRun(bench, kCheckFrames, run == 0 ? 0 : 6);
    if (!simulation) return simulation.error();
    const auto stats = simulation->stats();
    if (!stats) return stats.error();
    hashes[run] = stats->stateHash;
  }
  char text[64];
  std::snprintf(text, sizeof text, "%016llx and %016llx", static_cast<unsigned long long>(hashes[0]),
                static_cast<unsigned long long>(hashes[1]));
  return CheckResult{"", hashes[0] == hashes[1], text, "equal state hashes of two runs"};
}

Expected<CheckResult> boundsKept(const Bench& bench) {
  auto simulation = checkedRun(bench, 2 * kCheckFrames);
  if (!simulation) return simulation.error();
  const auto stats = simulation->stats();
  if (!stats) return stats.error();
  const uint64_t wrong = stats->nonFinite + stats->outside + stats->loopBoundHits;
  return CheckResult{"", wrong == 0 && stats->densityErrorMean < 0.02,
                     grouped(stats->nonFinite) + " not finite, " + grouped(stats->outside) + " outside, " + grouped(stats->loopBoundHits) +
                         " loops cut, mean compression " + percent(stats->densityErrorMean),
                     "0, 0, 0, below 2 %"};
}

Expected<CheckResult> pictureTwice(const Bench& bench) {
  auto simulation = checkedRun(bench, kCheckFrames);
  if (!simulation) return simulation.error();
  offline::Image images[2];
  for (offline::Image& image : images) {
    auto drawn = simulation->render("final", 640, 360);
    if (!drawn) return drawn.error();
    image = std::move(*drawn);
  }
  size_t differ = 0, colors = 0;
  for (size_t k = 0; k < images[0].rgba.size(); ++k) {
    differ += images[0].rgba[k] != images[1].rgba[k];
    colors += k >= 4 && images[0].rgba[k] != images[0].rgba[k - 4];
  }
  return CheckResult{"", differ == 0 && colors > 1000,
                     grouped(differ) + " bytes differ between two pictures, " + grouped(colors) + " changes of color", "0, above 1,000"};
}

constexpr struct {
  const char* name;
  Expected<CheckResult> (*run)(const Bench&);
} kChecks[] = {{"counting sort", countingSort},
               {"radix sort", radixSort},
               {"neighbor lists against all pairs", neighborLists},
               {"density against double precision", densityMatches},
               {"same bits in two runs", sameBits},
               {"particles stay finite and inside", boundsKept},
               {"same picture twice", pictureTwice}};

}  // namespace

std::vector<std::string> selfCheckNames() {
  std::vector<std::string> names;
  for (const auto& check : kChecks) names.emplace_back(check.name);
  return names;
}

Expected<CheckResult> selfCheck(const Bench& bench, const std::string& name) {
  const auto check = std::ranges::find(kChecks, name, [](const auto& c) { return std::string(c.name); });
  if (check == std::end(kChecks)) return Error{ErrorKind::BadInput, "no self-check is named " + inQuotes(name)};
  auto result = check->run(bench);
  if (result) result->name = name;
  return result;
}

}  // namespace rill::bench
