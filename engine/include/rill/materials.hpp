#pragma once
// Materials of fluids in a scene (rill/scene.hpp). SI units.
//
//   rill::FluidSettings water{.spacing = 0.01, .viscosity = 0.001, .surface_tension = 0.072};
//   const rill::FluidMaterial oil{.name = "oil", .density = 900, .viscosity = 0.06};
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "rill/vectors.hpp"

namespace rill {

/// The largest number of fluids in a scene.
inline constexpr size_t kMaxFluids = 8;
/// The largest number of them that diffuse.
inline constexpr size_t kMaxDiffusing = 4;

/// Material and resolution of the fluid, or what all fluids of a scene with several share. Give either `spacing` or `particles`.
struct FluidSettings {
  double spacing = 0;            ///< distance of particles at rest, m, > 0; 0 if `particles` is given
  uint64_t particles = 0;        ///< approximate number of particles; 0 if `spacing` is given
  double density = 1000;         ///< rest density, kg/m^3, > 0
  double smoothing_ratio = 2.3;  ///< smoothing length (support radius of the kernel) over spacing, 1.2 .. 4
  double viscosity = 0;          ///< dynamic viscosity, Pa s, >= 0; with a flow_index other than 1 the consistency, Pa s^n
  double yield_stress = 0;       ///< shear stress below which the fluid stands, Pa, >= 0
  double flow_index = 1;         ///< n of the shear stress yield_stress + viscosity rate^n, 0.2 .. 2; below 1 it thins when sheared
  double surface_tension = 0;    ///< against air, N/m, >= 0; 0: none
  double contact_angle = 90;     ///< of its surface with walls and solids, through the fluid, degrees, 0 .. 180
  double vorticity = 0;          ///< strength of vorticity confinement (Macklin and Mueller 2013, eq. 16), 0 .. 1
  double drag = 0;               ///< linear drag against air at rest, 1/s, >= 0: dv/dt = -drag v
  double tensile = 1;            ///< strength of the artificial pressure s_corr (eq. 13), 0 .. 1
  double tensile_radius = 0.25;  ///< delta q of s_corr over the smoothing length, 0 .. 1 exclusive
  double tensile_power = 16;     ///< exponent n of s_corr, 1 .. 16
  /// Particles at a time, at most; 0: those at the start, and what the emitters add in the scene's duration.
  uint64_t capacity = 0;
};

/// One of several fluids. All have the same spacing, so that the mass of their particles follows from their densities.
struct FluidMaterial {
  std::string name = {};                       ///< unique among fluids, not empty
  std::optional<double> density = {};          ///< rest density, kg/m^3, > 0; empty: that of FluidSettings
  std::optional<double> viscosity = {};        ///< dynamic viscosity, Pa s, >= 0; empty: that of FluidSettings
  std::optional<double> yield_stress = {};     ///< Pa, >= 0; empty: that of FluidSettings
  std::optional<double> flow_index = {};       ///< 0.2 .. 2; empty: that of FluidSettings
  std::optional<double> surface_tension = {};  ///< against air, N/m, >= 0; empty: that of FluidSettings
  std::optional<Double3> color = {};           ///< of the light that 10 cm of it let through, linear RGB, 0 .. 1; empty: that of the look
  double diffusion = 0;  ///< diffusivity of it in the other fluids, m^2/s, >= 0; above 0 in at most kMaxDiffusing fluids
};

/// Tension between two of several fluids. At most the sum of their surface tensions: otherwise both are raised.
struct FluidInterface {
  std::pair<std::string, std::string> between = {};  ///< names of two of Scene::fluids
  double tension = 0;                                ///< N/m, >= 0
};

}  // namespace rill
