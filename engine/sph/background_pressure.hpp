#pragma once
#include <glm/vec3.hpp>

namespace rill {

/// What of its own pressure a particle does not feel.
///
/// The pressure force of a particle i is the sum over its neighbors of (p_i + p_j) grad K. Its part p_i G, G = sum_j grad K, is zero
/// where neighbors are spread evenly, and noise in a flow, where they are not: noise that grows with depth, by which layers that slide
/// along each other rub. Differences of pressures, (p_j - p_i) grad K, have no such part (Sun, Colagrossi, Marrone, Antuono and Zhang
/// 2018, Computer Physics Communications 224, who use them away from the surface), but nothing then keeps neighbors spread evenly.
/// So a particle that moves is left without a share of p_i G, and gets all of the force where G is large: at the surface, and where the
/// neighbors have become uneven. Beside solids only the part of G along their surface counts: across it p_i G is what bears the fluid. See
/// docs/notes/background-pressure.md.
///
/// Returns the share of p_i G for a particle at `speed` (m/s) under `gravity` (m/s^2), with `coherence` 0 .. 1 of its motion: 2 would be
/// differences alone. None without gravity, where no pressure lasts, and momentum, which this does not conserve, may have to close; and
/// less for fluid at rest, whose noise the whole force damps. None either with a kernel of few neighbors, whose sums say little of how
/// evenly they are spread. `spacing` and the radius of the kernel's `support` in m.
double backgroundShare(double speed, double coherence, double gravity, double spacing, double support);

/// The share 0 .. 1 of a particle's motion that is flow. `mean`: speed of the kernel's mean of the velocities about it, `difference`: of
/// its own velocity from that, `layerSpeed`: (g d)^1/2 with gravity g and spacing d; all in m/s. Half is flow if the mean is 0.02 of the
/// layer speed, or 0.3 of the difference. None under few `layers` of fluid (pressure over that of one), where forces without a potential
/// bring energy.
double coherence(double mean, double difference, double layerSpeed, double layers);

/// The factor 0 .. 1 of that for a particle. `unevenness`: |G| d, with a K whose sum is 1 in fluid at rest and a G that includes what
/// solids displace; beside solids, its part along their surface.
double backgroundFactor(double unevenness);

/// The part of `gradient` (1/m) along the surface of solids whose displaced density has the gradient `displaced` (1/m). Of several solids
/// that is the sum: in an edge between two, what is left is perpendicular to the line that halves it. `spacing` in m.
glm::dvec3 alongSurface(const glm::dvec3& gradient, const glm::dvec3& displaced, double spacing);

}  // namespace rill
