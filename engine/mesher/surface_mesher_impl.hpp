#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "mesher/mesher_records.h"
#include "rill/surface_mesher.hpp"
#include "sort/key_sort.hpp"
#include "sort/scan.hpp"

namespace rill {

/// The passes of a SurfaceMesher. Particles are sorted by block; the blocks that they reach are listed in the order of their keys; then
/// particles are sorted by bin, and fields, vertices and triangles follow block by block. All places come from sorts and prefix sums.
class SurfaceMesherImpl {
 public:
  // surface_mesher.cpp
  static Expected<std::unique_ptr<SurfaceMesherImpl>> create(Device& device, const SurfaceMesherDesc& desc);
  // surface_mesher_passes.cpp
  SurfaceMesh addTo(Graph& graph, const FluidState& fluid);

  SurfaceMesherDesc limits;
  uint64_t bytes = 0;

 private:
  struct Pipelines {
    const ComputePipeline *keys = nullptr, *flag = nullptr, *compact = nullptr, *reach = nullptr, *dilate = nullptr, *arguments = nullptr,
                          *neighbors = nullptr, *binKeys = nullptr, *gather = nullptr, *ellipsoids = nullptr, *states = nullptr,
                          *mixed = nullptr, *nearArguments = nullptr, *lists = nullptr, *field = nullptr, *rows = nullptr,
                          *finish = nullptr, *vertices = nullptr, *triangles = nullptr, *shade = nullptr;
  };
  struct Frame;

  // surface_mesher.cpp
  /// Fails if a mesh of the limits does not fit on the device.
  Expected<void> setSizes(Device& device);
  Expected<void> makeSorts(Device& device);
  Expected<void> makePipelines(Device& device);
  // surface_mesher_passes.cpp
  void add(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, Frame& frame) const;
  void addCounted(Graph& graph, std::string_view name, const ComputePipeline* pipeline, uint32_t arguments, Frame& frame) const;
  void makeBuffers(Graph& graph, Frame& frame) const;
  void addDistinct(Graph& graph, Frame& frame, BufferRef sorted, uint32_t count, BufferRef& listed, uint32_t word, const Scan& scan) const;
  void addBlocks(Graph& graph, Frame& frame) const;
  void addBins(Graph& graph, Frame& frame) const;
  void addMesh(Graph& graph, Frame& frame) const;

  uint32_t binCells_ = 0;  // along a bin
  uint64_t rows_ = 0, corners_ = 0, listed_ = 0;
  bool texels_ = false;  // arrays are read through texel buffers
  std::array<uint32_t, 512> table_{};
  std::optional<KeySort> blockSort_, reachedSort_, binSort_;
  Scan particleScan_, reachedScan_, rowScan_;
  Pipelines pipelines_;
};

}  // namespace rill
