#pragma once
// From particles to a smooth surface: its depth and normal in every pixel. The methods share all that comes before the smoothing.
#include <array>
#include <functional>
#include <string_view>

#include "gpu/resources.hpp"
#include "graph/step.hpp"
#include "render/curvature_flow.hpp"
#include "render/surface_buffers.hpp"
#include "rill/fluid.hpp"
#include "rill/fluid_renderer.hpp"
#include "rill/graph.hpp"
#include "sort/scan.hpp"

namespace rill {

/// From the spheres' depth, a float a sample, to a smooth one.
using DepthFilter = std::function<BufferRef(Graph&, BufferRef depth, const surface::SurfacePush&)>;

/// How finely the surface is sampled and how far it is smoothed. The defaults are what pictures are made with; `rill-bench render` varies
/// them.
struct SurfaceSettings {
  double samples = 3;          ///< a spacing at the focus, at least: samples are 1, 2, 4 ... pixels wide
  double fit_reach = 2.5;      ///< planes: how far around a particle its plane is fitted, spacings
  double flow_time = 0.9;      ///< curvature flow: spacings squared; blurs over about its root
  uint32_t flow_levels = 2;    ///< curvature flow: of the pyramid above the samples, at most
  double narrow_sigma = 0.8;   ///< narrow range: standard deviation of its Gaussian, spacings
  DepthFilter filter = {};     ///< in place of the method's own; for baselines
  bool storage_reads = false;  ///< reads through storage buffers even where texel buffers would do; the same bits
};

/// What the passes and buffers of a thickness are called: the eye's and the sun's are told apart by them.
struct ThicknessNames {
  std::string_view pass, clear, counters;
};
inline constexpr ThicknessNames kFluidThickness{"fluid thickness", "fluid thickness clear", "fluid thickness counters"};
inline constexpr ThicknessNames kFluidShadow{"fluid shadow", "fluid shadow clear", "fluid shadow counters"};

class SurfaceStage {
 public:
  /// Of 32 bytes a plane: what a buffer holds.
  static constexpr uint32_t kMaxParticles = (128u << 20) / 32;

  static Expected<SurfaceStage> create(Device& device);

  /// `camera`: viewPush() of the view with its step. `whole`: pixels without fluid are written, too. `focus`: m, how far away the fluid is.
  /// The state has particles.
  SurfaceBuffers addTo(Graph& graph, const FluidState& fluid, surface::SurfacePush camera, SurfaceMethod method, bool whole, double focus,
                       const SurfaceSettings& settings = {}) const;

  /// Counts of `push.unit` along each sample's ray, a sample every `push.step` pixels: 1 m of fluid measures 1 m.
  /// `sceneDepth`: m a pixel, what lies behind it is not counted; an empty ref: nothing is in the way.
  /// `counters`: those of addTo(), where kBoundHits goes on; null: nobody asks.
  BufferRef addThickness(Graph& graph, const ThicknessNames& names, const FluidState& fluid, const surface::SurfacePush& push,
                         BufferRef sceneDepth, BufferRef* counters) const;
  /// The camera with what addThickness() asks for.
  static surface::SurfacePush thicknessPush(surface::SurfacePush camera, const FluidState& fluid, uint32_t step);

 private:
  /// A surface in the making: how much there is of everything, and the buffers that more than one part of it works on.
  struct Frame {
    SurfaceBuffers out;
    uint64_t sampleBlocks = 0, occluderCells = 0, cells = 0;  ///< of the picture with its margin
    double sampleSide = 0;                                    ///< m, at the focus
    BufferRef occluders, depth;                               ///< the depth of the spheres
    BufferRef survivors;                                      ///< particles that nothing hides
    BufferRef start, center;                                  ///< screen grid of those that are surface
    BufferRef plane;                                          ///< of the method that has planes
    bool narrows = false;                                     ///< by the narrow-range filter
    std::array<BufferRef, 2> filtered;                        ///< which that goes back and forth between
    bool texels = false;                                      ///< start, center, plane and what a filter reads are texel buffers
    bool storageReads = false;                                ///< nothing is to be one
    StepBinding walks(BufferRef buffer) const { return texels ? rill::texels(buffer) : reads(buffer); }
  };
  static Frame frameOf(const FluidState& fluid, surface::SurfacePush camera, SurfaceMethod method, double focus,
                       const SurfaceSettings& settings);
  // Its parts, in the order in which they run. Those of a method make samples of what the first ones found.
  static void addBuffers(Graph& graph, const FluidState& fluid, Frame& frame, bool whole);
  void addArguments(Graph& graph, SurfaceBuffers& out) const;
  void addVisible(Graph& graph, const FluidState& fluid, Frame& frame) const;
  void addGrid(Graph& graph, const FluidState& fluid, Frame& frame) const;
  void addPlanes(Graph& graph, Frame& frame) const;
  void addFiltered(Graph& graph, Frame& frame, const SurfaceSettings& settings) const;
  void addCompose(Graph& graph, Frame& frame, const ComputePipeline* edges, bool whole) const;

  Device* device_ = nullptr;
  CurvatureFlow flow_;
  const ComputePipeline *occlude_ = nullptr, *cull_ = nullptr, *arguments_ = nullptr, *splat_ = nullptr, *pick_ = nullptr,
                        *scatter_ = nullptr, *order_ = nullptr, *planes_[2] = {}, *blend_[2] = {}, *tiles_ = nullptr, *compose_ = nullptr,
                        *edges_[2] = {}, *edgesFiltered_[2] = {}, *narrow_[2][2] = {}, *normals_[2] = {}, *thickness_ = nullptr,
                        *thicknessNoScene_ = nullptr;
};

/// Pixels a side of a sample: what sees a spacing as `samples` to twice as many where the fluid is.
uint32_t sampleStep(const surface::SurfacePush& camera, float spacing, double depth, double samples = SurfaceSettings{}.samples);

}  // namespace rill
