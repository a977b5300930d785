#pragma once
// From particles to a smooth surface: depth, normal and coverage of each pixel. The methods differ in the smoothing only.
#include <array>
#include <functional>
#include <span>
#include <string_view>

#include "gpu/resources.hpp"
#include "graph/shader_pass.hpp"
#include "render/curvature_flow.hpp"
#include "render/surface_buffers.hpp"
#include "rill/fluid.hpp"
#include "rill/fluid_renderer.hpp"
#include "rill/graph.hpp"
#include "rill/particles.hpp"
#include "sort/scan.hpp"

namespace rill {

/// Smooths the spheres' depth, a float per sample.
using DepthFilter = std::function<BufferRef(Graph&, BufferRef depth, const surface::SurfacePush&)>;

/// Sampling and smoothing of the surface. Pictures use the defaults; `rill-bench render` varies them.
struct SurfaceSettings {
  double samples = 3;         ///< minimal samples per spacing at the focus; a sample is 1, 2, 4 ... pixels wide
  double fit_reach = 2.5;     ///< planes: reach of a plane's fit, spacings
  double flow_time = 0.9;     ///< curvature flow: total time, squared spacings; blurs over about its square root
  uint32_t flow_levels = 2;   ///< curvature flow: maximal levels of the pyramid above the samples
  double narrow_sigma = 0.8;  ///< narrow range: standard deviation of the Gaussian, spacings
  DepthFilter filter = {};    ///< replaces the method's smoothing; for baselines
};

/// Names of the passes and buffers of a thickness, as seen from the eye or from the sun.
struct ThicknessNames {
  std::string_view pass, clear, counters;
};
inline constexpr ThicknessNames kFluidThickness{"fluid thickness", "fluid thickness clear", "fluid thickness counters"};
inline constexpr ThicknessNames kFluidShadow{"fluid shadow", "fluid shadow clear", "fluid shadow counters"};

class SurfaceStage {
 public:
  /// As a Fluid on any device. Graph::prepare() fails where planes of 32 bytes a particle do not fit into a buffer of the device.
  static constexpr uint32_t kMaxParticles = rill::kMaxParticles;

  /// `storageReads`: never uses texel buffers; the bits are the same.
  static Expected<SurfaceStage> create(Device& device, bool storageReads = false);

  /// `camera`: viewPush() of the view with its step. `whole`: also writes pixels without fluid. `focus`: distance of the fluid, m.
  /// The state must have particles.
  SurfaceBuffers addTo(Graph& graph, const FluidState& fluid, surface::SurfacePush camera, SurfaceMethod method, bool whole, double focus,
                       const SurfaceSettings& settings = {}) const;

  /// For addThickness() of several fluids, at most kMaxFluids.
  Expected<void> setFluids(Device& device, std::span<const FluidBody> fluids);

  /// Which thicknesses addThickness() computes.
  enum class Of : uint8_t { All, EachFluid };

  /// Thickness along each sample's ray in units of `push.unit`, one sample per `push.step` pixels. Of each fluid: as many grids of samples,
  /// and with a `sceneDepth` as many more, of the bits of the depth of its nearest particle, inverted; 0 without one.
  /// With a `sceneDepth` the last grid has sums of thicknesses times depths (fluid_depths.glsl).
  /// `sceneDepth`: of the target, per pixel, hides fluid behind it; may be an empty ref.
  /// `surface`: the result of addTo() for the same state, which counts kBoundHits; may be null. The state must have particles.
  BufferRef addThickness(Graph& graph, const ThicknessNames& names, const FluidState& fluid, const surface::SurfacePush& push,
                         BufferRef sceneDepth, SurfaceBuffers* surface, Of of = Of::All) const;
  /// Where the fluid ends on each sample's ray (fluid_back.glsl), from what addThickness() has for this scene and this push.
  BufferRef addBack(Graph& graph, const SurfaceBuffers& surface, const surface::SurfacePush& push, BufferRef thickness,
                    BufferRef sceneDepth, Of of) const;
  /// What addThickness() has of each fluid for a light's push of step 1, in m and blurred, for shaders/views/scenery.glsl. Without
  /// particles zeros, and `thickness` is not used.
  BufferRef addShadow(Graph& graph, const surface::SurfacePush& light, BufferRef thickness) const;
  /// The camera with the fields that addThickness() needs.
  static surface::SurfacePush thicknessPush(surface::SurfacePush camera, const FluidState& fluid, uint32_t step);

 private:
  /// A surface while its passes are declared: sizes, and the buffers that several parts share.
  struct Frame {
    SurfaceBuffers out;
    uint64_t sampleBlocks = 0, occluderCells = 0, cells = 0;  ///< numbers, including the margin
    double sampleSide = 0;                                    ///< m, width of a sample at the focus
    BufferRef position;                                       ///< of the fluid
    BufferRef occluders, depth;                               ///< depth: of the spheres, before smoothing
    BufferRef survivors;                                      ///< particles that are not occluded
    BufferRef start, center, rank, arrived;                   ///< screen grid of surface particles
    BufferRef plane;                                          ///< of the method `planes`
    BufferRef before, after;                                  ///< of a step of a filter; `before` is its result in the end
    BufferRef edges;                                          ///< listed pixels
    bool narrowRange = false;                                 ///< uses the narrow-range filter
    std::array<BufferRef, 2> filtered;                        ///< ping-pong buffers of the narrow-range filter
  };
  static Frame makeFrame(const FluidState& fluid, surface::SurfacePush camera, SurfaceMethod method, double focus,
                         const SurfaceSettings& settings);
  // The parts in the order in which they run; addPlanes() or addFiltered() writes the samples.
  static void addBuffers(Graph& graph, const FluidState& fluid, Frame& frame, bool whole);
  void addArguments(Graph& graph, Frame& frame) const;
  void add(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, Frame& frame) const;
  void addCounted(Graph& graph, std::string_view name, const ComputePipeline* pipeline, uint32_t arguments, Frame& frame) const;
  void addVisible(Graph& graph, Frame& frame) const;
  void addGrid(Graph& graph, const FluidState& fluid, Frame& frame) const;
  void addPlanes(Graph& graph, Frame& frame) const;
  void addFiltered(Graph& graph, Frame& frame, const SurfaceSettings& settings) const;
  void addCompose(Graph& graph, Frame& frame, const ComputePipeline* edges) const;

  DeviceImpl* device_ = nullptr;
  bool storageReads_ = false;
  uint32_t fluids_ = 1;
  CurvatureFlow flow_;
  const ComputePipeline *particleGroups_ = nullptr, *occlude_ = nullptr, *cull_ = nullptr, *arguments_ = nullptr, *splat_ = nullptr,
                        *pick_ = nullptr, *scatter_ = nullptr, *order_ = nullptr, *planes_ = nullptr, *blend_ = nullptr, *tiles_ = nullptr,
                        *compose_ = nullptr, *edges_ = nullptr, *edgesFiltered_ = nullptr, *narrow_[2] = {}, *normals_ = nullptr,
                        *thickness_ = nullptr, *thicknessNoScene_ = nullptr, *fluidThickness_ = nullptr, *fluidThicknessNoScene_ = nullptr,
                        *shadow_ = nullptr, *back_ = nullptr, *fluidBack_ = nullptr, *mixedThickness_ = nullptr,
                        *mixedThicknessNoScene_ = nullptr;
};

/// Pixels per side of a sample, such that a spacing at `depth` has `samples` to twice as many samples.
uint32_t sampleStep(const surface::SurfacePush& camera, float spacing, double depth, double samples = SurfaceSettings{}.samples);

}  // namespace rill
