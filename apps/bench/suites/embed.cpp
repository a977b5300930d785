// Startup time of a host until its first frame, with and without pipelines in the host's pipeline cache, and device memory.
#include <chrono>
#include <cstddef>

#include "bench/suites/suites.hpp"
#include "bench/workbench.hpp"
#include "core/words.hpp"
#include "rill/fluid.hpp"
#include "rill/fluid_renderer.hpp"

namespace rill::bench {
namespace {

constexpr uint32_t kWidth = 1280, kHeight = 720;
constexpr VkFormat kColor = VK_FORMAT_R16G16B16A16_SFLOAT, kDepth = VK_FORMAT_D32_SFLOAT;

/// The pipeline cache of a host: loaded at startup, saved at exit.
class HostCache {
 public:
  HostCache(offline::Context& context, std::span<const std::byte> saved) : device_(context.vkDevice()) {
    const auto get = reinterpret_cast<PFN_vkGetDeviceProcAddr>(context.getInstanceProcAddr()(context.instance(), "vkGetDeviceProcAddr"));
    create_ = reinterpret_cast<PFN_vkCreatePipelineCache>(get(device_, "vkCreatePipelineCache"));
    destroy_ = reinterpret_cast<PFN_vkDestroyPipelineCache>(get(device_, "vkDestroyPipelineCache"));
    data_ = reinterpret_cast<PFN_vkGetPipelineCacheData>(get(device_, "vkGetPipelineCacheData"));
    VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = saved.size();
    info.pInitialData = saved.data();
    if (create_(device_, &info, nullptr, &handle_) != VK_SUCCESS) handle_ = VK_NULL_HANDLE;
  }
  ~HostCache() { destroy_(device_, handle_, nullptr); }
  HostCache(const HostCache&) = delete;
  HostCache& operator=(const HostCache&) = delete;

  VkPipelineCache handle() const { return handle_; }
  std::vector<std::byte> save() const {
    size_t bytes = 0;
    if (data_(device_, handle_, &bytes, nullptr) != VK_SUCCESS) return {};
    std::vector<std::byte> data(bytes);
    if (data_(device_, handle_, &bytes, data.data()) != VK_SUCCESS) return {};
    return data;
  }

 private:
  VkDevice device_;
  VkPipelineCache handle_ = VK_NULL_HANDLE;
  PFN_vkCreatePipelineCache create_ = nullptr;
  PFN_vkDestroyPipelineCache destroy_ = nullptr;
  PFN_vkGetPipelineCacheData data_ = nullptr;
};

/// Times of the startup steps of a host (ms), and its memory.
struct Start {
  double borrow = 0, fluid = 0, renderer = 0, first_frame = 0, second_fluid = 0;
  uint64_t fluid_bytes = 0, transient_bytes = 0;
  std::vector<std::byte> cache;
};

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return 1e3 * std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Expected<Start> measureStart(const Bench& bench, const Scene& scene, const ParticleSet& particles, std::span<const std::byte> saved) {
  auto context = offline::Context::create({.device = bench.options().device.name});
  if (!context) return context.error();
  const HostCache cache(*context, saved);
  DeviceRequirements needs;
  if (auto ok = appendRequired(context->getInstanceProcAddr(), context->instance(), context->physicalDevice(), needs); !ok)
    return ok.error();
  (void)needs.chain();  // links the features, as the context does for device creation
  Start start;
  Stopwatch stopwatch;
  auto device = Device::borrow({.instance = context->instance(),
                                .physicalDevice = context->physicalDevice(),
                                .device = context->vkDevice(),
                                .queueFamily = context->queueFamily(),
                                .getInstanceProcAddr = context->getInstanceProcAddr(),
                                .enabled = &needs.features,
                                .cache = cache.handle()});
  if (!device) return device.error();
  start.borrow = stopwatch.lap();
  {
    auto fluid = Fluid::create(*device, {.scene = &scene, .particles = &particles});
    if (!fluid) return fluid.error();
    start.fluid = stopwatch.lap();
    auto renderer = FluidRenderer::create(*device, {kColor, kDepth});
    if (!renderer) return renderer.error();
    start.renderer = stopwatch.lap();

    auto frame = context->beginFrame();
    if (!frame) return frame.error();
    device->beginFrame(*frame);
    Graph graph;
    SceneTargets targets{graph.create("color", {kColor, kWidth, kHeight}), graph.create("depth", {kDepth, kWidth, kHeight})};
    graph.pass("background", [&](Pass& pass) {
      targets.color = pass.write(targets.color, Use::ColorTarget, Load::Clear);
      targets.depth = pass.write(targets.depth, Use::DepthTarget, Load::Clear);
      return [](Commands&) {};
    });
    FluidView view;
    view.view.column[3] = {-0.5f, -0.3f, -3, 1};
    view.projection = Float4x4{{{1.2f, 0, 0, 0}, {0, -2.1f, 0, 0}, {0, 0, 0, -1}, {0, 0, 0.1f, 0}}};
    view.focus_m = 3;
    targets = renderer->addTo(graph, fluid->addTo(graph, {.advance_s = 1.0 / 60}), targets, view);
    graph.pass("consume", [&](Pass& pass) {
      pass.read(targets.color, Use::ComputeSampled);
      pass.sideEffect();
      return [](Commands&) {};
    });
    if (auto ok = graph.compile(); !ok) return ok.error();
    if (auto ok = graph.prepare(*device); !ok) return ok.error();
    if (auto ok = context->submit([&](VkCommandBuffer commands) { graph.record(commands); }); !ok) return ok.error();
    if (auto ok = context->wait(); !ok) return ok.error();
    start.first_frame = stopwatch.lap();
    auto second = Fluid::create(*device, {.scene = &scene, .particles = &particles});
    if (!second) return second.error();
    start.second_fluid = stopwatch.lap();
    for (const FluidBuffer& buffer : fluid->buffers()) start.fluid_bytes += buffer.bytes;
    start.transient_bytes = graph.transientBytes();
    start.cache = cache.save();
  }
  return start;
}

}  // namespace

Expected<Report> runEmbed(Bench& bench) {
  auto scene = namedScene("dam-break", {{"fluid.particles", "10000"}});
  if (!scene) return scene.error();
  const auto particles = makeParticles(*scene);
  if (!particles) return particles.error();
  scene->fluid.spacing = particles->spacing;

  const uint32_t samples = bench.quick() ? 3 : 9;
  bench.plan(2 * samples, "start");
  constexpr const char* kCases[] = {"new pipelines", "pipelines from the host's cache"};
  struct Row {
    std::vector<double> borrow, fluid, renderer, first_frame, second_fluid;
  } rows[2];
  Start last;
  for (uint32_t k = 0; k < 2 * samples && !bench.stopped(); ++k) {
    const uint32_t mode = k % 2;  // runs with a cache use the one of the run before
    bench.step(kCases[mode]);
    auto start = measureStart(bench, *scene, *particles, mode == 0 ? std::span<const std::byte>{} : std::span<const std::byte>(last.cache));
    if (!start) return start.error();
    last = *std::move(start);
    rows[mode].borrow.push_back(last.borrow);
    rows[mode].fluid.push_back(last.fluid);
    rows[mode].renderer.push_back(last.renderer);
    rows[mode].first_frame.push_back(last.first_frame);
    rows[mode].second_fluid.push_back(last.second_fluid);
  }

  Report report;
  Table times;
  times.title = "Startup of a host, ms (medians)";
  times.columns = {"", "borrow", "fluid", "renderer", "first frame", "second fluid"};
  times.note =
      "Dam break of 10,000 particles at 1280x720. first frame: from declaration to completion on the device, which may include shader\n"
      "compilation by the driver. second fluid: shares the pipelines of the first.";
  for (uint32_t mode = 0; mode < 2; ++mode) {
    const Row& row = rows[mode];
    times.rows.push_back({kCases[mode], number(median(row.borrow)), number(median(row.fluid)), number(median(row.renderer)),
                          number(median(row.first_frame)), number(median(row.second_fluid))});
    report.results.push_back({{"case", kCases[mode]},
                              {"borrow_ms", sampleStatistics(row.borrow)},
                              {"fluid_ms", sampleStatistics(row.fluid)},
                              {"renderer_ms", sampleStatistics(row.renderer)},
                              {"first_frame_ms", sampleStatistics(row.first_frame)},
                              {"second_fluid_ms", sampleStatistics(row.second_fluid)}});
  }
  Table memory;
  memory.title = "Device memory";
  memory.columns = {"what", "MiB"};
  const auto mebibytes = [](uint64_t bytes) { return number(double(bytes) / (1 << 20)); };
  memory.rows = {{"fluid of 10,000 particles", mebibytes(last.fluid_bytes)},
                 {"transient resources of a frame at 1280x720", mebibytes(last.transient_bytes)},
                 {"saved pipeline cache", mebibytes(last.cache.size())}};
  report.results.push_back({{"case", "memory"},
                            {"fluid_bytes", last.fluid_bytes},
                            {"transient_bytes", last.transient_bytes},
                            {"cache_bytes", last.cache.size()}});
  report.tables = {std::move(times), std::move(memory)};
  return report;
}

}  // namespace rill::bench
