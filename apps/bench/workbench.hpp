#pragma once
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bench/bench.hpp"
#include "gpu/resources.hpp"
#include "graph/import_whole.hpp"
#include "offline/context.hpp"
#include "rill/graph.hpp"

namespace rill::bench {

/// What a graph took.
struct GraphTime {
  /// Of the host's work, in order.
  struct Host {
    double declare_us = 0, compile_us = 0, prepare_us = 0, record_us = 0;
    size_t declare_allocations = 0, graph_allocations = 0;  ///< of who declares; in the three others
  } host;
  double run_ms = 0;    ///< from recording it to its end on the device
  double whole_ms = 0;  ///< with declaring, compiling and preparing it
};

/// A device of a suite's own, for graphs that belong to no scene. It outlives the buffers that it makes.
class Workbench {
 public:
  static Expected<Workbench> open(const Bench& bench);

  Device& device() { return context_->device(); }

  /// Device memory that holds `items`: where a device has memory of its own, reading the host's would be what is timed.
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

  /// Declares a graph over `graph`, runs it and waits for it.
  Expected<GraphTime> run(const std::function<void(Graph&)>& declare);
  /// Whether each pass is timed from now on: it slows the whole.
  void timePasses(bool timed) { graph_->enableTimings(timed); }
  std::span<const PassReport> passReport() const { return graph_->report(); }  ///< of the last graph
  std::span<const Timing> passTimes() const { return graph_->timings(); }      ///< of the last graph

 private:
  explicit Workbench(std::unique_ptr<offline::Context> context) : context_(std::move(context)), graph_(std::make_unique<Graph>()) {
    graph_->enableTimings(false);
  }
  Expected<Buffer> uploadBytes(std::string_view name, std::span<const std::byte> bytes);
  Expected<void> downloadBytes(const Buffer& buffer, std::span<std::byte> bytes);

  std::unique_ptr<offline::Context> context_;
  std::unique_ptr<Graph> graph_;
};

/// Whether one run goes before those that count: a driver may compile shaders in it.
enum class WarmUp { Needed, Done };

/// `samples` of a graph's time.
struct GraphSamples {
  std::vector<double> run_ms, whole_ms;
};
Expected<GraphSamples> sampleGraph(Workbench& bench, uint32_t samples, const std::function<void(Graph&)>& declare,
                                   WarmUp warmUp = WarmUp::Needed);

}  // namespace rill::bench
