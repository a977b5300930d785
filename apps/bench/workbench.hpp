#pragma once
#include <cstring>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "bench/bench.hpp"
#include "gpu/resources.hpp"
#include "graph/import_whole.hpp"
#include "offline/context.hpp"
#include "rill/graph.hpp"

namespace rill::bench {

/// Times of one graph.
struct GraphTime {
  /// CPU time and allocations, in order of execution.
  struct Host {
    double declare_us = 0, compile_us = 0, prepare_us = 0, record_us = 0;
    size_t declare_allocations = 0, graph_allocations = 0;  ///< while declaring; while compiling, preparing and recording
  } host;
  double run_ms = 0;    ///< from recording to completion on the device
  double total_ms = 0;  ///< including declaring, compiling and preparing
};

/// A device for graphs without a scene. It must outlive the buffers that it creates.
class Workbench {
 public:
  static Expected<Workbench> open(const Bench& bench);

  Device& device() { return context_.device(); }

  /// Uploads `items` to device memory, so that timed passes do not read host memory over the bus.
  template <class T>
  Expected<Buffer> upload(std::string_view name, std::span<const T> items) {
    return uploadBytes(name, std::as_bytes(items));
  }
  Expected<Buffer> make(std::string_view name, uint64_t bytes) { return createBuffer(device(), name, bytes); }
  template <class T>
  Expected<std::vector<T>> download(const Buffer& buffer) {
    std::vector<T> items(buffer.size() / sizeof(T));
    if (auto done = downloadBytes(buffer, std::as_writable_bytes(std::span(items))); !done) return done.error();
    return items;
  }

  /// Declares a graph, runs it and waits for its completion.
  Expected<GraphTime> run(const std::function<void(Graph&)>& declare);
  /// Enables time stamps per pass, which slow the graph.
  void timePasses(bool timed) { graph_.enableTimings(timed); }
  std::span<const PassReport> passReport() const { return graph_.report(); }  ///< of the last graph
  std::span<const Timing> passTimes() const { return graph_.timings(); }      ///< of the last graph

 private:
  explicit Workbench(offline::Context context) : context_(std::move(context)) { graph_.enableTimings(false); }
  Expected<Buffer> uploadBytes(std::string_view name, std::span<const std::byte> bytes);
  Expected<void> downloadBytes(const Buffer& buffer, std::span<std::byte> bytes);

  offline::Context context_;
  Graph graph_;
};

/// Whether to run the graph once before sampling: drivers may compile shaders on first use.
enum class WarmUp { Needed, Done };

/// Times of repeated runs of one graph.
struct GraphSamples {
  std::vector<double> run_ms, total_ms;
};
Expected<GraphSamples> sampleGraph(Workbench& bench, uint32_t samples, const std::function<void(Graph&)>& declare,
                                   WarmUp warmUp = WarmUp::Needed);

}  // namespace rill::bench
