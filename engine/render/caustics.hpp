#pragma once
// Sunlight that the fluid's surface refracts onto what is below and behind it (after Shah, Konttinen and Pattanaik 2007), as a map in the
// sun's view.
//
//   const Caustics::Frame frame = caustics.addTo(graph, fluid, look, view, thickness, thicknessUnit, solidDepths);
//   // frame.map is read as shaders/views/scenery.glsl does
#include <array>

#include "render/caustics_records.h"
#include "rill/fluid_renderer.hpp"
#include "rill/graph.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// A view along the sun's rays. Texel k along u is where dot(p, u) = first_u + k texel, for p relative to `origin`; likewise along v.
struct SunView {
  Double3 origin = {0, 0, 0};                                ///< m, in the scene's coordinates
  Double3 u = {1, 0, 0}, v = {0, 0, -1}, toSun = {0, 1, 0};  ///< orthonormal, u cross v = toSun, u horizontal
  double first_u = 0, first_v = 0;                           ///< m, of the first texel's center
  double nearest = 0;                                        ///< dot(p, toSun) where light depth is 0, m
  double texel = 1, depths = 1;                              ///< m: of a texel, and the range of light depths
  uint32_t width = 1, height = 1;                            ///< texels
  bool floor = false;                                        ///< the stage's floor, in the plane of its lower side, is a receiver
  Double3 low = {0, 0, 0}, high = {0, 0, 0};                 ///< the stage, relative to `origin`, m
  uint32_t closed = 0;                                       ///< its sides that are walls: bits -x +x -y +y -z +z
};

class Caustics {
 public:
  /// The sun's least height, as the sine of its angle above the horizon. Below there are no caustics.
  static constexpr double kLowest = 0.05;

  /// `fluids`: 1 to kMaxFluids.
  static Expected<Caustics> create(Device& device, bool solids, uint32_t fluids = 1);

  /// What a frame's passes write. The map has kCausticLevels levels, each with one layer, or two with solids, of kCausticFine texels per
  /// side of a texel of the view: half floats of red, green and blue light over the sun's, and a fourth, in the first layer the share of
  /// light that meets no fluid, in the second the depth where fluid begins.
  struct Frame {
    BufferRef map;
    BufferRef landings;  ///< per photon: place in texels of the map (floats), then half floats: light, path length in texels
    BufferRef surfaces;  ///< per texel of the view: first and last depth, share covered, thickness in m
    BufferRef sums;      ///< three words per texel of each layer, then per coarse texel, in counts; `unit`: of a photon
    double unit = 1;
    bool solids = false;
  };

  /// `thickness`: of SurfaceStage::addThickness() with a push of the same view and step 1, in counts of `thicknessUnit`, m. `solidDepths`:
  /// an image of the view's size, depths over the range, with solids. The fluid must have particles and must not be opaque. Of several
  /// fluids, `thickness` is that of each, and `bodies` the record of addLook().
  Frame addTo(Graph& graph, const FluidState& fluid, const FluidLook& look, const SunView& view, BufferRef thickness, double thicknessUnit,
              ImageRef solidDepths = {}, BufferRef bodies = {}) const;

  /// Size of a level, texels, and of the whole map, bytes.
  static std::array<uint32_t, 2> levelSize(const SunView& view, uint32_t level);
  static uint64_t mapBytes(const SunView& view, bool solids);

 private:
  bool solids_ = false;
  const ComputePipeline *particleGroups_ = nullptr, *depths_ = nullptr, *smooth_[2] = {}, *slopes_ = nullptr, *rays_ = nullptr,
                        *splat_ = nullptr, *resolve_ = nullptr, *level_ = nullptr;
};

}  // namespace rill
