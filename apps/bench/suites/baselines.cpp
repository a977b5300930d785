#include "bench/suites/baselines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/shaders.hpp"
#include "bench/shaders/cloud.h"
#include "bench/suites/count_name.hpp"
#include "bench/suites/tank.hpp"
#include "bench/workbench.hpp"
#include "core/words.hpp"
#include "gpu/device_impl.hpp"
#include "graph/shader_pass.hpp"
#include "rill/vectors.hpp"
#include "sort/key_sort.hpp"

namespace rill::bench {
namespace {

constexpr uint32_t kTile = 16384;  // candidates per dispatch of the brute-force search
constexpr uint32_t kStructFloats = 20;

/// Unsorted particles in a box of cells from the origin.
struct Cloud {
  std::vector<Float4> positions;
  CloudPush push{};
  uint32_t cells() const { return push.cellsX * push.cellsY * push.cellsZ; }
};

/// Density sum of a particle, and the number of neighbors including itself.
struct Found {
  float density, neighbors;
};

Expected<Cloud> cloudOf(uint32_t count) {
  auto scene = tank(count, {{"fill[0].jitter", "0.2"}});
  if (!scene) return scene.error();
  const auto start = makeParticles(*scene);
  if (!start) return start.error();
  scene->fluid.spacing = start->spacing;
  Cloud cloud;
  cloud.push.count = static_cast<uint32_t>(start->positions.size());
  cloud.push.radius = static_cast<float>(scene->fluid.smoothing_ratio * scene->fluid.spacing);
  float high[3] = {0, 0, 0};
  for (const Float3& x : start->positions) {
    cloud.positions.push_back({x.x, x.y, x.z, 0});
    high[0] = std::max(high[0], x.x);
    high[1] = std::max(high[1], x.y);
    high[2] = std::max(high[2], x.z);
  }
  uint32_t* const cells[] = {&cloud.push.cellsX, &cloud.push.cellsY, &cloud.push.cellsZ};
  for (int axis = 0; axis < 3; ++axis) *cells[axis] = static_cast<uint32_t>(high[axis] / cloud.push.radius) + 1;
  return cloud;
}

/// Over all particles.
void declare(Graph& graph, const ComputePipeline* pipeline, const CloudPush& push, std::initializer_list<Named> resources) {
  addDispatch(graph, "baseline", pipeline, divideUp(push.count, kCloudGroup), push, resources);
}

/// Time samples of a variant, and its density sums by particle index.
struct Result {
  GraphSamples samples;
  std::vector<Found> found;
  double medianMs() const { return median(samples.run_ms); }
};

/// Largest relative difference of densities; infinite if neighbor counts differ.
double difference(const std::vector<Found>& a, const std::vector<Found>& b) {
  double worst = a.size() == b.size() ? 0 : std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    worst = std::max(worst, a[i].neighbors != b[i].neighbors ? std::numeric_limits<double>::infinity()
                                                             : std::abs(double(a[i].density) - b[i].density) / a[i].density);
  return worst;
}

/// All variants on one cloud.
class SearchVariants {
 public:
  SearchVariants(Workbench& workbench, const Cloud& cloud, uint32_t repeat) : workbench_(workbench), cloud_(cloud), repeat_(repeat) {}

  Expected<void> prepare() {
    implOf(workbench_.device()).shaders.add(benchShaders());
    const std::pair<const ComputePipeline**, const char*> pipelines[] = {{&allPairs_, "all_pairs"},
                                                                         {&keys_, "cell_keys"},
                                                                         {&reorder_, "reorder"},
                                                                         {&arrays_, "grid_density"},
                                                                         {&structs_, "grid_density_struct"}};
    for (const auto& [pipeline, shader] : pipelines) {
      auto made = computePipeline(workbench_.device(), {.shader = shader});
      if (!made) return made.error();
      *pipeline = *made;
    }
    auto sort = KeySort::create(workbench_.device(), {.count = cloud_.push.count, .keyRange = cloud_.cells(), .start = true});
    if (!sort) return sort.error();
    sort_ = std::move(*sort);
    auto positions = workbench_.upload("bench positions", std::span<const Float4>(cloud_.positions));
    if (!positions) return positions.error();
    positions_ = std::move(*positions);
    const struct {
      Buffer* buffer;
      const char* name;
      uint64_t bytes;
    } buffers[] = {{&sorted_, "bench sorted", sizeof(Float4) * uint64_t{cloud_.push.count}},
                   {&order_, "bench order", 4 * uint64_t{cloud_.push.count}},
                   {&start_, "bench start", 4 * paddedWords(uint64_t{cloud_.cells()} + 1)},
                   {&result_, "bench result", sizeof(Found) * uint64_t{cloud_.push.count}}};
    for (const auto& desc : buffers) {
      auto made = workbench_.make(desc.name, desc.bytes);
      if (!made) return made.error();
      *desc.buffer = std::move(*made);
    }
    return {};
  }

  Expected<Result> allPairs(uint32_t repeat) {
    const auto search = [&](Graph& graph, uint32_t last) {
      const BufferRef positions = importWhole(graph, "positions", positions_);
      BufferRef result = importWhole(graph, "result", result_);
      CloudPush push = cloud_.push;
      for (push.first = 0; push.first < last; push.first += kTile) {
        push.last = std::min(last, push.first + kTile);
        declare(graph, allPairs_, push, {{"position", positions}, {"result", result}});
      }
    };
    // One candidate per particle is enough to compile the shader.
    if (auto warmUp = workbench_.run([&](Graph& graph) { search(graph, 1); }); !warmUp) return warmUp.error();
    return sample(repeat, WarmUp::Done, [&](Graph& graph) { search(graph, cloud_.push.count); });
  }

  /// Builds the grid: cell keys, sort, reordered positions.
  Expected<Result> build() {
    auto samples = sampleGraph(workbench_, repeat_, [&](Graph& graph) {
      const BufferRef positions = importWhole(graph, "positions", positions_);
      BufferRef keys = graph.create("keys", {4 * uint64_t{cloud_.push.count}}), sorted = importWhole(graph, "sorted", sorted_);
      declare(graph, keys_, cloud_.push, {{"position", positions}, {"key", keys}});
      const SortedKeys order = sort_->addTo(
          graph, keys, {.order = importWhole(graph, "order", order_), .start = importWhole(graph, "start", start_), .keys = {}});
      declare(graph, reorder_, cloud_.push, {{"position", positions}, {"order", order.order}, {"sorted", sorted}});
    });
    if (!samples) return samples.error();
    auto order = workbench_.download<uint32_t>(order_);
    if (!order) return order.error();
    hostOrder_ = std::move(*order);
    return Result{std::move(*samples), {}};
  }

  Expected<Result> byGrid() { return searchGrid(arrays_, sorted_); }

  Expected<Result> byStructs() {
    std::vector<float> structs(size_t{kStructFloats} * cloud_.push.count);
    for (size_t slot = 0; slot < hostOrder_.size(); ++slot)
      std::memcpy(&structs[kStructFloats * slot], &cloud_.positions[hostOrder_[slot]], sizeof(Float4));
    const auto particles = workbench_.upload("bench structs", std::span<const float>(structs));
    if (!particles) return particles.error();
    return searchGrid(structs_, *particles);
  }

 private:
  Expected<Result> searchGrid(const ComputePipeline* pipeline, const Buffer& particles) {
    auto result = sample(repeat_, WarmUp::Needed, [&](Graph& graph) {
      BufferRef found = importWhole(graph, "result", result_);
      const BufferRef particle = importWhole(graph, "particles", particles), start = importWhole(graph, "start", start_);
      declare(graph, pipeline, cloud_.push, {{"position", particle}, {"particle", particle}, {"start", start}, {"result", found}});
    });
    if (!result) return result;
    std::vector<Found> byNumber(result->found.size());
    for (size_t slot = 0; slot < byNumber.size(); ++slot) byNumber[hostOrder_[slot]] = result->found[slot];
    result->found = std::move(byNumber);
    return result;
  }

  Expected<Result> sample(uint32_t repeat, WarmUp warmUp, const std::function<void(Graph&)>& graph) {
    auto samples = sampleGraph(workbench_, repeat, graph, warmUp);
    if (!samples) return samples.error();
    auto found = workbench_.download<Found>(result_);
    if (!found) return found.error();
    return Result{std::move(*samples), std::move(*found)};
  }

  Workbench& workbench_;
  const Cloud& cloud_;
  uint32_t repeat_;
  const ComputePipeline *allPairs_ = nullptr, *keys_ = nullptr, *reorder_ = nullptr, *arrays_ = nullptr, *structs_ = nullptr;
  std::optional<KeySort> sort_;
  Buffer positions_, sorted_, order_, start_, result_;
  std::vector<uint32_t> hostOrder_;
};

std::vector<uint32_t> countsOf(const Bench& bench) {
  std::vector<uint32_t> counts = bench.quick() ? std::vector<uint32_t>{10'000} : std::vector<uint32_t>{10'000, 50'000};
  std::erase_if(counts, [&](uint32_t count) { return !bench.selected("baseline-" + countName(count)); });
  return counts;
}

/// Large brute-force searches are long enough for a single sample.
uint32_t bruteForceSamples(const Bench& bench, uint32_t count) { return count > 20'000 ? 1 : bench.options().repeat; }
uint32_t samplesOf(const Bench& bench) { return std::max(5u, bench.options().repeat); }

/// Brute-force pairs dominate the time.
size_t partsOf(const Bench& bench, uint32_t count) { return 1 + bruteForceSamples(bench, count) * (uint64_t{count} * count / 4'000'000); }

}  // namespace

size_t Baselines::parts(const Bench& bench) const {
  size_t parts = 0;
  for (const uint32_t count : countsOf(bench)) parts += partsOf(bench, count);
  return parts;
}

Expected<void> Baselines::run(Bench& bench, Report& report) const {
  Table search{"Neighbor search in a density pass: brute force against grid, ms",
               {"particles", "neighbors", "all pairs", "grid: sort", "grid: search", "all pairs / grid"},
               {},
               "all pairs / grid: includes the sort of the grid. Both searches find the same neighbors and use no neighbor list."};
  Table layout{"Memory layout, same grid search: one struct of " + std::to_string(4 * kStructFloats) +
                   " bytes per particle against separate arrays, ms",
               {"particles", "one struct", "arrays", "struct / arrays"},
               {},
               ""};
  for (const uint32_t count : countsOf(bench)) {
    if (bench.stopped()) break;
    const std::string name = "baseline-" + countName(count);
    bench.step(name, partsOf(bench, count));
    auto workbench = Workbench::open(bench);
    if (!workbench) return workbench.error();
    const auto cloud = cloudOf(count);
    if (!cloud) return cloud.error();
    SearchVariants searches(*workbench, *cloud, samplesOf(bench));
    if (auto ready = searches.prepare(); !ready) return ready;
    const auto pairs = searches.allPairs(bruteForceSamples(bench, count)), build = searches.build();
    if (!pairs) return pairs.error();
    if (!build) return build.error();
    const auto grid = searches.byGrid(), structs = searches.byStructs();
    if (!grid) return grid.error();
    if (!structs) return structs.error();

    double neighbors = 0;
    for (const Found& found : grid->found) neighbors += (found.neighbors - 1.0) / double(grid->found.size());
    if (const double apart = difference(pairs->found, grid->found); !(apart <= 1e-4))
      report.failures.push_back(name + ": densities of all pairs and grid differ by " + roundedNumber(apart) +
                                " (infinite: neighbor counts differ), expected at most 1e-4");
    if (const double apart = difference(structs->found, grid->found); !(apart == 0))
      report.failures.push_back(name + ": densities of structs and arrays differ by " + roundedNumber(apart) +
                                " (infinite: neighbor counts differ), expected 0");
    const double byGrid = build->medianMs() + grid->medianMs();
    search.rows.push_back({grouped(cloud->push.count), number(neighbors), number(pairs->medianMs()), number(build->medianMs()),
                           number(grid->medianMs()), number(pairs->medianMs() / byGrid)});
    layout.rows.push_back({grouped(cloud->push.count), number(structs->medianMs()), number(grid->medianMs()),
                           number(structs->medianMs() / grid->medianMs())});
    report.results.push_back({{"case", name},
                              {"particles", cloud->push.count},
                              {"neighbors", neighbors},
                              {"all_pairs_ms", bench::sampleStatistics(pairs->samples.run_ms)},
                              {"grid_sort_ms", bench::sampleStatistics(build->samples.run_ms)},
                              {"grid_search_ms", bench::sampleStatistics(grid->samples.run_ms)},
                              {"struct_search_ms", bench::sampleStatistics(structs->samples.run_ms)},
                              {"all_pairs_over_grid", pairs->medianMs() / byGrid},
                              {"struct_over_arrays", structs->medianMs() / grid->medianMs()}});
  }
  if (!search.rows.empty()) {
    report.tables.push_back(std::move(search));
    report.tables.push_back(std::move(layout));
  }
  return {};
}

}  // namespace rill::bench
