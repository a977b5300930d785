#pragma once
// Screen-space rendering of a fluid's particles into a host's color and depth, as passes of a render graph.
//
//   auto painter = rill::FluidRenderer::create(device, {.color = VK_FORMAT_R8G8B8A8_SRGB, .depth = VK_FORMAT_D32_SFLOAT});
//   if (!painter) return fail(painter.error().message);
//   rill::SceneTargets targets;  // every frame: what has been drawn so far
//   const rill::Use drawn = rill::Use::ColorTarget, tested = rill::Use::DepthTarget;
//   targets.color = graph.import("color", {colorImage, {VK_FORMAT_R8G8B8A8_SRGB, width, height}, drawn, drawn});
//   targets.depth = graph.import("depth", {depthImage, {VK_FORMAT_D32_SFLOAT, width, height}, tested, tested});
//   rill::FluidView view{.width = width, .height = height, .focus_m = 3};
//   view.view = rill::Float4x4::from(viewMatrix);
//   view.projection = rill::Float4x4::from(projectionMatrix);
//   targets = painter->addTo(graph, state, targets, view);
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rill/device.hpp"
#include "rill/environment.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/scene.hpp"
#include "rill/vectors.hpp"

namespace rill {

/// Formats of the images that a FluidRenderer draws to. Pipelines depend on them.
struct TargetFormats {
  VkFormat color = VK_FORMAT_R16G16B16A16_SFLOAT;  ///< linear values are written; only an SRGB format encodes them
  VkFormat depth = VK_FORMAT_D32_SFLOAT;
};

/// Usage flags that the host's color image needs in addition to the host's own.
inline constexpr VkImageUsageFlags kFluidColorUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
/// The same for the depth image.
inline constexpr VkImageUsageFlags kFluidDepthUsage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;

/// The images that hold the host's scene and that the fluid is drawn into: images of the same graph, of TargetFormats and of equal size,
/// with content. They are read with Use::ComputeSampled and drawn to with Use::ColorTarget and Use::DepthTarget.
struct SceneTargets {
  ImageRef color, depth;
};

/// The host's camera.
struct FluidView {
  /// World (relative to `origin`) to view space, rigid: the eye looks along -z, y up, right handed, as GLM's lookAt makes it.
  Float4x4 view = {};
  /// View to Vulkan's clip space. Perspective or orthographic, standard or reversed depth, finite or infinite, centered or not.
  Float4x4 projection = {};
  Double3 origin = {0, 0, 0};           ///< m, in the scene's coordinates
  uint32_t x = 0, y = 0;                ///< of the viewport in the targets, pixels
  uint32_t width = 1280, height = 720;  ///< of the viewport, pixels
  double focus_m = 1;                   ///< approximate distance of the fluid, m. The resolution of the surface follows from it
};

/// How the surface is reconstructed from particles.
enum class SurfaceMethod : uint8_t {
  Auto,           ///< Planes: the most accurate over all shapes of `rill-bench render`, at about twice the time of NarrowRange
  Planes,         ///< a plane fitted around each surface particle, blended
  CurvatureFlow,  ///< van der Laan, Green and Sainz 2009: the spheres' depth, moved with its mean curvature
  NarrowRange     ///< Truong and Yuksel 2018: the spheres' depth, filtered over a narrow range of it
};

/// The fluid's appearance. Colors are linear RGB.
struct FluidLook {
  SurfaceMethod surface = SurfaceMethod::Auto;
  Float3 absorption{2.6f, 0.75f, 0.40f};  ///< 1/m, Beer-Lambert law
  Float3 scatter{0.02f, 0.13f, 0.19f};    ///< color of white light scattered by thick fluid; of an opaque fluid its color
  /// 1/m, of sunlight that shines through crests and is scattered once; its loss is that of `absorption`. 0: none, at no cost.
  Float3 scattering{0, 0, 0};
  float meanCosine = 0.92f;  ///< of the angle of that scattering (Henyey and Greenstein 1941), -1 to 1 exclusive
  /// Light of the fluid's own where it is thick, relative to a white surface in the sky's light; thin fluid has as little of it as it
  /// absorbs (Kirchhoff's law). It does not light the scene.
  Float3 emission{0, 0, 0};
  bool opaque = false;               ///< nothing is visible through the fluid, and its thickness is not computed
  float refractionIndex = 1.333f;    ///< 1 to 10
  float highlight = 900;             ///< exponent of the sun's specular reflection
  float sun = 18;                    ///< radiance of the sun's reflection relative to that of a white surface in its light
  std::optional<Float3> toSun = {};  ///< direction, of any length; empty: of the environment's sun, otherwise -0.30, 0.84, 0.45
  float aeration = 0.3f;             ///< strength of whitewater (spray and breaking crests), 0 (none) to 1; ignored if opaque
};

/// The preset of a scene's `look.preset`: one of fluidLooks(). Empty for another name.
RILL_API std::optional<FluidLook> fluidLook(std::string_view preset);
/// The method of a scene's `look.surface`. Empty for another name.
RILL_API std::optional<SurfaceMethod> surfaceMethod(std::string_view name);
/// Names of all presets.
RILL_API std::span<const std::string_view> fluidLooks();

/// What absorbs and scatters light in one of several fluids. Colors are linear RGB.
struct FluidBody {
  /// 1/m, 0 to 1e6. Empty: absorption, scatter, scattering and emission are those of the FluidLook. With one, it has no emission and no
  /// sunlight shines through its crests.
  std::optional<Float3> absorption = {};
  Float3 scatter{0, 0, 0};  ///< as FluidLook::scatter, of a fluid with an absorption
  bool diffuses = false;    ///< a component of FluidState::concentration is its share, in the order of those that do; at most four do
};

/// A clear liquid of this FluidMaterial::color, which scatters as little as the preset `water`; without a color it looks as the FluidLook.
/// Its absorption is -ln(color) / 0.1 m, at most 92 1/m.
RILL_API FluidBody fluidBody(const std::optional<Double3>& color);
/// The fluids of a scene, for FluidRenderer::setFluids(). Empty: none has a color.
RILL_API std::vector<FluidBody> fluidBodies(const Scene& scene);

/// Exact values of the surface, without a tone curve; alpha 0 without fluid.
enum class SurfaceData : uint8_t {
  Normals,   ///< n / 2 + 1/2, in world space
  Depth,     ///< distance along the view direction over `full`, gray
  Thickness  ///< of the fluid along the ray over `full`, gray
};

class FluidRendererImpl;

/// Draws the fluid of a FluidState. Only its position, concentration (of fluids that diffuse), countBuffer, capacity, spacing and origin
/// are used, so that a host can fill one itself. With several fluids (setFluids()) w of a position is the index of the particle's fluid.
/// The number of particles is the first uint of `countBuffer`, at most `capacity`; without a countBuffer it is `capacity`. Entries
/// at 1e9 m are skipped. Both buffers are read with Use::ComputeRead; a host creates its own for STORAGE_BUFFER, `position` with at least
/// 16 bytes per entry, `countBuffer` with at least 4.
/// Pixels are bitwise deterministic per driver, unless more than 1,024 surface particles share a cell of four by four samples (counted).
/// At a silhouette the fluid's depth is written in every pixel that it covers in part. Lifetime and moves as of a Fluid.
class RILL_API FluidRenderer {
 public:
  /// NoDevice if the host's queue cannot draw; Shader; BadInput for formats that cannot be drawn to.
  static Expected<FluidRenderer> create(Device& device, const TargetFormats& formats = {});
  ~FluidRenderer();
  FluidRenderer(FluidRenderer&&) noexcept;
  FluidRenderer& operator=(FluidRenderer&&) noexcept;

  /// Replaces the built-in sky that the fluid reflects and is lit by. Its sun (findSun()) lights the fluid from where it is unless
  /// FluidLook::toSun is set, and is not reflected as a part of the picture. The host draws its background itself. Call it once, not
  /// between a graph's declaration and its recording. The first frames copy the picture to the device. Errors as create(), BadInput for a
  /// picture that EnvironmentPicture does not allow, OutOfMemory.
  Expected<void> setEnvironment(const EnvironmentPicture& picture);

  /// Draws several fluids, at most kMaxFluids: light on its way through is absorbed by each of them along its length. Particles are of the
  /// fluid whose index is w of their position; one above the last is the last. The surface, its reflection and refraction are those of the
  /// FluidLook; an opaque one hides them. Of one fluid, w is ignored. Empty: one fluid that looks as the FluidLook. Not between a graph's
  /// declaration and its recording. Errors as create(), BadInput for a FluidBody that its description does not allow.
  Expected<void> setFluids(std::span<const FluidBody> fluids);

  /// BadInput for a view that cannot be drawn: empty, larger than 8192 per side or 2^24 pixels, an invalid projection. Needs no device.
  static Expected<void> check(const FluidView& view);

  /// Declares the passes that draw the fluid over the content of `targets` and returns their new versions. The graph's compile() fails for
  /// a view that check() refuses, a viewport outside the targets, more than 2^22 particles or an invalid state.
  [[nodiscard]] SceneTargets addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view,
                                   const FluidLook& look = {});

  /// width x height pixels, RGBA8, rows from the top. `full`: m at white. Errors as of addTo().
  BufferRef addData(Graph& graph, const FluidState& fluid, const FluidView& view, SurfaceData data, float full,
                    SurfaceMethod method = SurfaceMethod::Auto);

 private:
  friend struct ImplAccess;  // engine/core/impl_of.hpp
  explicit FluidRenderer(std::unique_ptr<FluidRendererImpl>);
  std::unique_ptr<FluidRendererImpl> impl_;
};

}  // namespace rill
