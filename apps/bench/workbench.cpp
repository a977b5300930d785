#include "bench/workbench.hpp"

#include <chrono>

#include "bench/count_allocations.hpp"
#include "shared/pipeline_cache_folder.hpp"

namespace rill::bench {
namespace {

using Clock = std::chrono::steady_clock;
double millisecondsSince(Clock::time_point begin) { return 1e3 * std::chrono::duration<double>(Clock::now() - begin).count(); }

}  // namespace

Expected<Workbench> Workbench::open(const Bench& bench) {
  offline::ContextDesc desc;
  desc.device = bench.options().device.name;
  desc.pipelineCache = apps::pipelineCacheFolder();
  desc.framesInFlight = 1;  // run() waits for every graph
  auto context = offline::Context::create(desc);
  if (!context) return context.error();
  return Workbench(std::move(*context));
}

Expected<GraphTime> Workbench::run(const std::function<void(Graph&)>& declare) {
  GraphTime time;
  Clock::time_point begin = Clock::now();
  const Clock::time_point first = begin;
  const auto lapMicroseconds = [&] {
    const double ms = millisecondsSince(begin);
    begin = Clock::now();
    return 1e3 * ms;
  };
  startCounting();
  graph_.reset();
  declare(graph_);
  time.host.declare_us = lapMicroseconds();
  time.host.declare_allocations = stopCounting();
  begin = Clock::now();
  startCounting();
  const auto compiled = graph_.compile();
  time.host.graph_allocations = stopCounting();
  time.host.compile_us = lapMicroseconds();
  if (!compiled) return compiled.error();
  if (auto began = context_.beginFrame(); !began) return began.error();
  begin = Clock::now();
  startCounting();
  const auto prepared = graph_.prepare(device());
  time.host.graph_allocations += stopCounting();
  time.host.prepare_us = lapMicroseconds();
  if (!prepared) return prepared.error();
  const Clock::time_point recording = Clock::now();
  const auto submitted = context_.submit([&](VkCommandBuffer commands) {
    begin = Clock::now();
    startCounting();
    graph_.record(commands);
    time.host.graph_allocations += stopCounting();
    time.host.record_us = lapMicroseconds();
  });
  if (!submitted) return submitted.error();
  if (auto waited = context_.wait(); !waited) return waited.error();
  time.run_ms = millisecondsSince(recording);
  time.total_ms = millisecondsSince(first);
  return time;
}

Expected<Buffer> Workbench::uploadBytes(std::string_view name, std::span<const std::byte> bytes) {
  auto staging = createBuffer(device(), "bench upload", bytes.size(), MemoryKind::Upload);
  if (!staging) return staging.error();
  std::memcpy(staging->mapped(), bytes.data(), bytes.size());
  auto target = make(name, bytes.size());
  if (!target) return target.error();
  auto ran = run([&](Graph& graph) {
    const BufferRef from = importWhole(graph, "bench upload", *staging);
    BufferRef to = importWhole(graph, name, *target);
    graph.pass("upload", [&](Pass& pass) {
      pass.read(from, Use::CopySource);
      to = pass.write(to, Use::CopyTarget, true);
      return [=, size = bytes.size()](Commands& commands) { commands.copy(from, to, size); };
    });
  });
  if (!ran) return ran.error();
  return std::move(*target);
}

Expected<void> Workbench::downloadBytes(const Buffer& buffer, std::span<std::byte> bytes) {
  Ticket ticket;
  auto ran = run([&](Graph& graph) { ticket = graph.readback(importWhole(graph, "bench download", buffer)); });
  if (!ran) return ran.error();
  const auto content = graph_.data(ticket);
  if (content.size() < bytes.size()) return Error{ErrorKind::Failed, "bench download: the readback returned too few bytes"};
  std::memcpy(bytes.data(), content.data(), bytes.size());
  return {};
}

Expected<GraphSamples> sampleGraph(Workbench& bench, uint32_t samples, const std::function<void(Graph&)>& declare, WarmUp warmUp) {
  if (warmUp == WarmUp::Needed)
    if (auto first = bench.run(declare); !first) return first.error();
  GraphSamples taken;
  for (uint32_t k = 0; k < samples; ++k) {
    const auto time = bench.run(declare);
    if (!time) return time.error();
    taken.run_ms.push_back(time->run_ms);
    taken.total_ms.push_back(time->total_ms);
  }
  return taken;
}

}  // namespace rill::bench
