#pragma once
// Initial particles of waves: the rest lattice, displaced as the wave displaces the fluid.
#include "bench/experiments/measures.hpp"
#include "bench/experiments/wave_theory.hpp"

namespace rill::bench {

/// A standing wave at its highest, at rest. The displacement is that of linear theory, which keeps volumes.
/// `thickness`: layers in z.
Cloud standingWave(const StandingWave& wave, double spacing, int thickness);

/// A tank with a solitary wave whose crest is at `crest_m`: the rest lattice up to the surface. Where the surface is between two layers,
/// as many of the columns along z have the upper one as make the volume right on average.
Cloud solitaryWave(const SolitaryWave& wave, double length_m, double crest_m, double spacing, int thickness);

}  // namespace rill::bench
