#pragma once
// Whitewater of a simulation.
#include <optional>

#include "rill/offline.hpp"
#include "rill/whitewater.hpp"

namespace rill::offline {

/// Foam, spray and bubbles of a scene's fluid: how many there may be, and what each of them stands for.
/// `particles`: what the fluid has at the start.
WhitewaterDesc whitewaterOf(const Scene& scene, const ParticleSet& particles, uint32_t capacity);

/// Radius of a ball of a diffuse particle's volume, m: its size in pictures.
double drawnRadius(const WhitewaterDesc& desc);

/// Gravity at a time.
Double3 gravityAt(const Scene& scene, double time_s);

struct WhitewaterTickets {
  Ticket place, motion, counts;
};
/// Adds the read-backs of all particles to a graph.
WhitewaterTickets whitewaterReadout(Graph& graph, const WhitewaterState& state);
/// The state that was read back. The frame must have completed.
WhitewaterSnapshot collectWhitewater(const Graph& graph, const WhitewaterTickets& tickets);
DiffuseParticles diffuseParticles(const WhitewaterSnapshot& state, const Double3& origin);
/// Inverse of diffuseParticles(), to be drawn: without figures since the start, and with the random bits that pictures use.
WhitewaterSnapshot whitewaterSnapshot(const DiffuseParticles& particles, const Double3& origin);

}  // namespace rill::offline
