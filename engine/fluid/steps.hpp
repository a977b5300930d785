#pragma once
// How long substeps are, and how much a correction does: what a scene asks for, bounded by what is stable. Warnings say what is used
// instead.
#include <string>

#include "fluid/settings.hpp"
#include "sph/kernel.hpp"

namespace rill {

/// Spacings that the fastest particle may move before the list is rebuilt.
inline constexpr double kTravel = 1.2;
/// Where there is surface tension: drops whose particles meet unseen drift (docs/notes/surface-tension.md).
inline constexpr double kTravelWithTension = 0.6;

/// The widest side of `room`, m.
double widest(const Double3& room);

/// As many as a list lives for where the step is the longest that the CFL condition allows, and one more: it is shorter as a rule. Where
/// something else bounds the step, as surface tension does, a list may live for long.
uint32_t substepsPerBlock(const SolverSettings& solver);

void setRegularization(const Scene& scene, const SmoothingKernel& kernel, FluidSetup& setup);
void setRelaxation(FluidSetup& setup);
void setCfl(const Scene& scene, FluidSetup& setup);
void setGains(const Scene& scene, FluidSetup& setup);

/// The head of the start, and what the device needs to follow it: see docs/notes/column-height.md. What nothing can hold may be drops far
/// apart: no column is higher than one drop of all of it.
void setColumn(const Scene& scene, const StartFigures& start, FluidSetup& setup);

void setSpeeds(const Scene& scene, const StartFigures& start, FluidParams& p);

/// No step is longer than the longest stable one, whatever is asked for.
void setLongestStep(const Scene& scene, FluidSetup& setup);

/// Where nothing holds the fluid up there is no initial pressure.
void setInitialPressure(const Scene& scene, const SmoothingKernel& kernel, const Double3& room, FluidSetup& setup);

/// Warns if substeps of at most `longest` seconds, which `why` asks for, are too short for frames of 1/60 s.
void warnOfDropping(const std::string& why, double longest, FluidSetup& setup);

/// No step is longer than `longest` seconds, which `why` asks for.
void boundStep(double longest, const std::string& why, FluidSetup& setup);

/// BadInput where steps are so short that the rounding of positions, which are floats, decides speeds.
Expected<void> checkSteps(const Scene& scene, const Double3& room, const FluidSetup& setup);

}  // namespace rill
