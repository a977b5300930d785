#pragma once
#include "rill/whitewater.hpp"
#include "sort/key_sort.hpp"
#include "sort/scan.hpp"
#include "whitewater/whitewater_records.h"

namespace rill {

inline constexpr uint64_t kWhiteCountBytes = kWhiteCountWords * 4;

/// The passes of a Whitewater. Fluid particles are sorted into the bins of a hashed grid; old diffuse particles move and are compacted;
/// new ones follow behind them.
class WhitewaterImpl {
 public:
  // whitewater.cpp
  static Expected<std::unique_ptr<WhitewaterImpl>> create(Device& device, const WhitewaterDesc& desc);
  // whitewater_passes.cpp
  WhitewaterState addTo(Graph& graph, const FluidState& fluid, double seconds, const Double3& gravity);

  WhitewaterDesc desc;
  uint64_t bytes = 0;

 private:
  struct Pipelines {
    const ComputePipeline *keys = nullptr, *gather = nullptr, *surface = nullptr, *births = nullptr, *begin = nullptr, *advance = nullptr,
                          *compact = nullptr, *emit = nullptr, *finish = nullptr;
  };
  struct Frame;

  // whitewater.cpp
  Expected<void> makeBuffers(Device& device);
  void stage(const WhitewaterSnapshot* snapshot);

  // whitewater_passes.cpp
  WhitePush pushFor(const FluidState& fluid, double seconds, const Double3& gravity) const;
  void upload(Graph& graph, Frame& frame);
  void add(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, Frame& frame) const;
  void addFluid(Graph& graph, Frame& frame) const;

  uint32_t bins_ = 0;
  Buffer place_, motion_, counts_;
  Buffer staging_;        // the state at the start
  uint64_t staged_ = 0;   // diffuse particles in it
  bool started_ = false;  // a graph copies it
  std::optional<KeySort> sort_;
  Scan birthScan_, aliveScan_;
  Pipelines pipelines_;
};

}  // namespace rill
