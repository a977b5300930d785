#pragma once
// Initial particles of waves: the rest lattice with the velocities of theory. A displaced lattice is too dense in places: it rises
// before time begins, and its depth oscillates.
#include "bench/experiments/measures.hpp"
#include "bench/experiments/wave_theory.hpp"

namespace rill::bench {

/// A standing wave as its surface passes through level, with the velocities of linear theory. `thickness`: layers in z.
Cloud standingWave(const StandingWave& wave, double spacing, int thickness);

/// A tank with a solitary wave whose crest is at `crest_m`: the rest lattice up to the surface. Where the surface is between two layers,
/// as many of the columns along z have the upper one as make the volume right on average.
Cloud solitaryWave(const SolitaryWave& wave, double length_m, double crest_m, double spacing, int thickness);

}  // namespace rill::bench
