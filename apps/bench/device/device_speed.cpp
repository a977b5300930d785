#include "bench/device/device_speed.hpp"

#include <algorithm>

#include "bench/shaders.hpp"
#include "bench/shaders/cloud.h"
#include "gpu/device_impl.hpp"
#include "graph/shader_pass.hpp"

namespace rill::bench {
namespace {

constexpr uint64_t kCopyBytes = 96ull << 20;  // more than any cache
constexpr uint32_t kCopies = 8, kDispatches = 400, kSamples = 5;

double fastest(const std::vector<double>& ms) { return *std::ranges::min_element(ms); }

}  // namespace

Expected<DeviceSpeed> measureDeviceSpeed(Workbench& workbench) {
  const uint64_t bytes = std::min(kCopyBytes, workbench.device().info().maxBufferBytes);
  const auto from = workbench.make("bench from", bytes), to = workbench.make("bench to", bytes);
  if (!from) return from.error();
  if (!to) return to.error();
  const auto copy = [&](uint32_t times) {
    return sampleGraph(workbench, kSamples, [&, times](Graph& graph) {
      BufferRef source = importWhole(graph, "bench from", *from), target = importWhole(graph, "bench to", *to);
      for (uint32_t k = 0; k < times; ++k) {
        graph.pass("copy", [&](Pass& pass) {
          pass.read(source, Use::CopySource);
          target = pass.write(target, Use::CopyTarget, true);
          pass.sideEffect();
          return [=](Commands& commands) { commands.copy(source, target, bytes); };
        });
        std::swap(source, target);
      }
    });
  };

  implOf(workbench.device()).shaders.add(benchShaders());
  const auto pipeline = computePipeline(workbench.device(), {.shader = "reorder"});
  if (!pipeline) return pipeline.error();
  const auto small = workbench.make("bench small", 4096);
  if (!small) return small.error();
  const auto dispatches = [&](uint32_t passes, uint32_t each) {
    return sampleGraph(workbench, kSamples, [&, passes, each](Graph& graph) {
      const BufferRef positions = importWhole(graph, "bench from", *from), order = importWhole(graph, "bench to", *to);
      BufferRef sorted = importWhole(graph, "bench small", *small);
      for (uint32_t k = 0; k < passes; ++k)
        graph.pass("dispatches", [&](Pass& pass) {
          const Kernel kernel = bindNamed(pass, *pipeline, {{"position", positions}, {"order", order}, {"sorted", sorted}});
          pass.sideEffect();
          return [=](Commands& commands) {
            for (uint32_t d = 0; d < each; ++d) dispatch(commands, kernel, DispatchSize(1), CloudPush{});
          };
        });
    });
  };

  // Differences of two lengths leave out what a submission costs.
  const auto one = copy(1), many = copy(1 + kCopies);
  if (!one) return one.error();
  if (!many) return many.error();
  const auto none = dispatches(1, 1), free = dispatches(1, 1 + kDispatches), waiting = dispatches(1 + kDispatches, 1);
  for (const auto* samples : {&none, &free, &waiting})
    if (!*samples) return samples->error();
  DeviceSpeed speed;
  const double copies_s = 1e-3 * std::max(fastest(many->run_ms) - fastest(one->run_ms), 1e-6);
  speed.copied_GBps = 1e-9 * 2 * double(bytes) * kCopies / copies_s;
  const auto perDispatch_us = [&](const GraphSamples& samples) {
    return 1e3 * std::max(fastest(samples.run_ms) - fastest(none->run_ms), 0.0) / kDispatches;
  };
  speed.dispatch_us = perDispatch_us(*free);
  speed.barrier_us = std::max(perDispatch_us(*waiting) - speed.dispatch_us, 0.0);
  return speed;
}

}  // namespace rill::bench
