#pragma once
// The rows of the keys `fluid`, `fluids` and `solver`, for the table of fields.hpp.
#include <array>

#include "model/field.hpp"
#include "rill/particles.hpp"

namespace rill::model {

inline constexpr std::array<std::string_view, 2> kKernelWords{"wendland", "poly6_spiky"};  // KernelChoice
inline constexpr std::array<std::string_view, 2> kNeighborWords{"list", "grid"};           // NeighborChoice

template <>
struct Table<FluidSettings> {
  static constexpr std::string_view about = "Material and resolution of the fluid; give either spacing or particles";
  static constexpr std::array<std::string_view, 2> one_of{"spacing", "particles"};
  static constexpr std::tuple fields{
      Field{Info{.key = "spacing",
                 .unit = "m",
                 .range = above(0),
                 .help = "distance of neighboring particles at rest; a particle has the mass density x spacing^3. Half the spacing means 8 "
                         "times the particles and shorter time steps"},
            &FluidSettings::spacing},
      Field{Info{.key = "particles",
                 .range = between(1, 4294967295.0),
                 .help = "approximate number of particles that the fills make; the spacing is computed from it. Use it in place of spacing "
                         "to fix the cost of a scene"},
            &FluidSettings::particles},
      Field{Info{.key = "density", .unit = "kg/m^3", .range = above(0), .help = "rest density; water has 1000"}, &FluidSettings::density},
      Field{Info{.key = "smoothing_ratio",
                 .range = between(1.2, 4),
                 .help = "smoothing length (support radius of the kernel) over spacing; larger values average over more neighbors, which "
                         "is smoother and slower"},
            &FluidSettings::smoothing_ratio},
      Field{Info{.key = "viscosity",
                 .unit = "Pa s",
                 .range = atLeast(0),
                 .help = "dynamic viscosity: water has 0.001, honey about 10, tar 10000; it does not shorten the time step"},
            &FluidSettings::viscosity},
      Field{Info{.key = "yield_stress",
                 .unit = "Pa",
                 .range = atLeast(0),
                 .help = "shear stress below which the fluid stands: ketchup has about 30, toothpaste 200; 0: it always flows",
                 .since = "0.2"},
            &FluidSettings::yield_stress},
      Field{Info{.key = "flow_index",
                 .range = between(0.2, 2),
                 .help = "n of the shear stress yield_stress + viscosity x rate^n (Herschel and Bulkley); below 1 the fluid thins when it "
                         "is sheared, above 1 it thickens, and the viscosity is that at a rate of 1/s",
                 .since = "0.2"},
            &FluidSettings::flow_index},
      Field{
          Info{.key = "surface_tension",
               .unit = "N/m",
               .range = atLeast(0),
               .help = "surface tension against air: water has 0.072; 0 turns it off. It shortens the time step where the spacing is small",
               .since = "0.2"},
          &FluidSettings::surface_tension},
      Field{Info{.key = "contact_angle",
                 .unit = "degrees",
                 .range = between(0, 180),
                 .help = "angle of a surface with tension at walls and solids, through the fluid: small ones wet, large ones repel",
                 .since = "0.2"},
            &FluidSettings::contact_angle},
      Field{Info{.key = "vorticity",
                 .range = between(0, 1),
                 .help = "strength of vorticity confinement (Macklin and Mueller 2013, eq. 16), which adds rotation that the solver "
                         "dissipates; 0 turns it off"},
            &FluidSettings::vorticity},
      Field{Info{.key = "drag",
                 .unit = "1/s",
                 .range = atLeast(0),
                 .help = "linear drag against air at rest: speed falls by the factor exp(-drag t); 0 turns it off",
                 .since = "0.2"},
            &FluidSettings::drag},
      Field{Info{.key = "tensile",
                 .range = between(0, 1),
                 .help = "strength of the artificial pressure s_corr (Macklin and Mueller 2013, eq. 13), which keeps particles from "
                         "clustering where the fluid is sparse; 0 turns it off"},
            &FluidSettings::tensile},
      Field{Info{.key = "tensile_radius",
                 .range = inside(0, 1),
                 .help = "artificial pressure: reference distance delta q over the smoothing length; closer pairs feel the full strength"},
            &FluidSettings::tensile_radius},
      Field{Info{.key = "tensile_power",
                 .range = between(1, 16),
                 .help = "artificial pressure: exponent n; higher values limit it to closer pairs"},
            &FluidSettings::tensile_power},
      Field{Info{.key = "capacity",
                 .range = between(0, static_cast<double>(kMaxParticles)),
                 .help = "largest number of particles at a time; emitters wait while it is reached. 0: those at the start, and what the "
                         "emitters add in the scene's duration",
                 .since = "0.2"},
            &FluidSettings::capacity}};
};

template <>
struct Table<FluidMaterial> {
  static constexpr std::string_view about = "One of several fluids";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "name", .help = "name of the fluid; unique, not empty", .required = true}, &FluidMaterial::name},
      Field{Info{.key = "density", .unit = "kg/m^3", .range = above(0), .help = "rest density; without it, fluid.density", .unset = ""},
            &FluidMaterial::density},
      Field{Info{.key = "viscosity",
                 .unit = "Pa s",
                 .range = atLeast(0),
                 .help = "dynamic viscosity; without it, fluid.viscosity",
                 .unset = ""},
            &FluidMaterial::viscosity},
      Field{Info{.key = "yield_stress",
                 .unit = "Pa",
                 .range = atLeast(0),
                 .help = "shear stress below which the fluid stands; without it, fluid.yield_stress",
                 .unset = ""},
            &FluidMaterial::yield_stress},
      Field{Info{.key = "flow_index",
                 .range = between(0.2, 2),
                 .help = "exponent of the rate of shear; without it, fluid.flow_index",
                 .unset = ""},
            &FluidMaterial::flow_index},
      Field{Info{.key = "surface_tension",
                 .unit = "N/m",
                 .range = atLeast(0),
                 .help = "surface tension against air; without it, fluid.surface_tension",
                 .unset = ""},
            &FluidMaterial::surface_tension},
      Field{Info{.key = "color",
                 .range = between(0, 1),
                 .help = "part of the light that 10 cm of the fluid let through, linear [red, green, blue]; without it, that of the look",
                 .parts = "[red, green, blue]"},
            &FluidMaterial::color},
      Field{Info{.key = "diffusion",
                 .unit = "m^2/s",
                 .range = atLeast(0),
                 .help = "diffusivity of the fluid in the others, above 0 in at most four fluids; its color follows"},
            &FluidMaterial::diffusion}};
};

template <>
struct Table<FluidInterface> {
  static constexpr std::string_view about = "Tension between two fluids";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "between", .help = "names of two of fluids", .required = true}, &FluidInterface::between},
      Field{Info{.key = "tension",
                 .unit = "N/m",
                 .range = atLeast(0),
                 .help = "interfacial tension: oil and water have 0.02 to 0.05. At most the sum of their surface tensions: otherwise "
                         "both are raised"},
            &FluidInterface::tension}};
};

template <>
struct Table<SolverSettings> {
  static constexpr std::string_view about = "Accuracy and cost of the solver";
  static constexpr std::array one_of = kNoWords;
  static constexpr std::tuple fields{
      Field{Info{.key = "time_step",
                 .unit = "s",
                 .range = above(0),
                 .help = "longest time step; auto: as long as cfl and tolerance allow. Set it for convergence studies"},
            &SolverSettings::time_step},
      Field{Info{.key = "cfl",
                 .range = aboveTo(0, 10),
                 .help = "distance in spacings that the fastest particle may move in a substep; lower it for accuracy in fast flow"},
            &SolverSettings::cfl},
      Field{Info{.key = "max_substeps",
                 .range = between(1, 256),
                 .help = "largest number of substeps in a frame of up to 1/60 s; time that does not fit is dropped and reported. Lower it "
                         "to bound the cost of a frame"},
            &SolverSettings::max_substeps},
      Field{Info{.key = "iterations",
                 .range = between(1, 1000),
                 .help = "largest number of Jacobi iterations in a substep; more of them compress the fluid less and cost more"},
            &SolverSettings::iterations},
      Field{Info{.key = "tolerance",
                 .range = atLeast(0),
                 .help = "largest mean compression, as a fraction of the rest density; iterations and substeps are reduced as far as it "
                         "allows. 0: always the full number of iterations"},
            &SolverSettings::tolerance},
      Field{
          Info{.key = "relaxation",
               .range = aboveTo(0, 2),
               .help = "relaxation factor of the Jacobi iteration; auto: 0.56 in motion, 0.37 at rest (with the default kernel). Lower it "
                       "if the fluid jitters"},
          &SolverSettings::relaxation},
      Field{Info{.key = "regularization",
                 .range = atLeast(0),
                 .help = "epsilon of Macklin and Mueller 2013, eq. 11, as a fraction of the rest lattice's sum of |grad C|^2; larger "
                         "values make the fluid softer; auto: 0.02"},
            &SolverSettings::regularization},
      Field{Info{.key = "warm_start",
                 .range = between(0, 0.5),
                 .help = "gain of the pressure that is kept from substep to substep; 0 turns it off. auto: 0.02 in motion, at most 0.005 "
                         "at rest, 0 with several iterations"},
            &SolverSettings::warm_start},
      Field{Info{.key = "artificial_viscosity",
                 .range = between(0, 1),
                 .help = "noise damping: viscosity of waves as short as the spacing in slow fluid, over density x spacing x sqrt(g x "
                         "spacing), of which fluid.viscosity is a part; long waves keep their energy. auto: 1"},
            &SolverSettings::artificial_viscosity},
      Field{Info{.key = "kernel",
                 .help = "smoothing kernel; wendland: Wendland C2 for density and gradient. poly6_spiky: the pair of Macklin and Mueller "
                         "2013, for comparison",
                 .words = kKernelWords},
            &SolverSettings::kernel},
      Field{Info{.key = "neighbors",
                 .help = "neighbor search; list: a neighbor list that is kept for several substeps. grid: search the grid in every pass, "
                         "which needs less memory",
                 .words = kNeighborWords},
            &SolverSettings::neighbors},
      Field{Info{.key = "sleep",
                 .help = "true: fluid at rest, or regions of it, take no part in substeps until gravity, a solid, a body, a wave or the "
                         "host moves them. Not without gravity, nor with several fluids",
                 .since = "0.2"},
            &SolverSettings::sleep}};
};

}  // namespace rill::model
