#pragma once
// The fluid's surface on a driver: cameras, clouds of particles, the surface as data, and pictures drawn into a host's targets.
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "render/fluid_renderer_impl.hpp"
#include "support/gpu_test.hpp"
#include "views/scenery.hpp"

namespace rill::test {

inline constexpr float kSpacing = 0.1f;
inline constexpr double kDegree = std::numbers::pi / 180;

struct Vector {
  double x = 0, y = 0, z = 0;
};
inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(Vector a, double k) { return {a.x * k, a.y * k, a.z * k}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector unit(Vector a) { return a * (1 / std::sqrt(dot(a, a))); }

struct Pixel {
  float depth = 0;  ///< m; infinite: no fluid
  Vector normal;    ///< in view space: x right, y up, z away from the eye
};

/// The host's scene in front of or behind the fluid.
struct Backdrop {
  std::array<float, 4> color{0, 0, 0, 1};
  float depth = 0;                           ///< as the target stores it
  std::vector<std::array<float, 4>> pixels;  ///< in place of the color, of a target of four floats
  std::vector<float> depths;                 ///< in place of the one depth
};

struct Drawn {
  std::vector<std::byte> color;  ///< texels of the target's format
  std::vector<float> depth;
  /// Four channels a texel, as a shader would read them; of the formats that the tests draw to.
  std::vector<std::array<double, 4>> channels(VkFormat format) const;
};

/// sRGB encoding of linear light (IEC 61966-2-1).
double encodedSrgb(double linear);

class SurfaceOnGpu : public GpuTest {
 protected:
  static constexpr uint32_t kWidth = 320, kHeight = 240;

  /// Looks along -z from the origin.
  static FluidView perspective(double focus = 4);
  static FluidView looking(Vector eye, Vector target, uint32_t width, uint32_t height);
  /// The same eye with parallel rays, `halfHeight` m to the upper edge: depth grows from 0 to 1 over 100 m.
  static FluidView orthographic(double halfHeight, FluidView eye = perspective());
  /// The same eye with depth from 0 at `near` to 1 at `far`, or the other way round.
  static FluidView finite(FluidView view, double near, double far, bool reversed);

  void fill(const std::vector<Float4>& positions);
  FluidState state(Graph& graph);
  /// Of the default formats.
  FluidRendererImpl& renderer();

  /// The surface of the picture, computed by texel reads and by storage reads, with equal bits.
  std::vector<Pixel> surface(const FluidView& view, SurfaceMethod method = SurfaceMethod::Auto);

  /// Fills the graph's transient memory with a different value per run, so that a read of undefined content changes the picture.
  void fillTransients(Graph& graph, int run);

  /// Targets of a size that hold the backdrop.
  SceneTargets hosts(Graph& graph, const TargetFormats& formats, uint32_t width, uint32_t height, const Backdrop& backdrop);
  /// The fluid over a backdrop, drawn twice with equal bits. Without a size, targets end at the viewport's lower right corner.
  Drawn drawn(const FluidView& view, const FluidLook& look, const Backdrop& backdrop = {}, const TargetFormats& formats = {},
              uint32_t width = 0, uint32_t height = 0);

  /// Particles of a lattice, jittered.
  std::vector<Float4> block(Vector low, Vector high, double jitter = 0.2);
  /// Four layers of a fluid at rest under a plane, the first half a spacing below it; jittered 0.25 spacings along and 0.1 across.
  std::vector<Float4> under(Vector point, Vector normal, Vector u, Vector v, double extent);
  /// A ball of spherical shells at rest density; each shell is a spiral.
  std::vector<Float4> shells(Vector center, double radius);
  /// Uniformly distributed in a box.
  std::vector<Float4> scattered(Vector low, Vector high, uint32_t count);

  Buffer position_, backdrop_, backdropDepth_;
  uint32_t count_ = 0;
  std::vector<FluidBody> bodies_;                  ///< of drawn()
  std::optional<EnvironmentPicture> environment_;  ///< of drawn()
  std::optional<FluidRenderer> renderer_;
  std::mt19937 random_{7};
};

}  // namespace rill::test
