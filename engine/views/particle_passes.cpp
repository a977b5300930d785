// The passes of the particle view: visibility, light, and shading by lists of tiles.
#include <algorithm>

#include "render/surface_buffers.hpp"
#include "shared/no_depth.h"
#include "views/particle_view.hpp"

namespace rill {

using namespace particle_view;

void ParticleView::add(Graph& graph, std::string_view name, const ComputePipeline* pipeline, const DispatchSize& size, Frame& f) const {
  const BufferRef &scene = f.scene, &position = f.position, &velocity = f.velocity, &words = f.meshWords, &count = f.particles.count;
  addDispatch(graph, name, pipeline, size, f.push,
              {{"scene", scene},           {"position", position},   {"particle_count", count},
               {"velocity", velocity},     {"placed", f.poses},      {"mesh_words", words},
               {"edges", f.edges},         {"masks", f.masks},       {"depth", f.depth},
               {"winner", f.winner},       {"light_map", f.light},   {"floor_light", f.floor},
               {"occluders", f.occluders}, {"counters", f.counters}, {"survivors", f.survivors},
               {"tint", f.tint},           {"tiles", f.tiles},       {"shaded", f.shaded},
               {"rims", f.rims},           {"picture", f.picture},   {"concentration", f.concentration}});
}

void ParticleView::addSetup(Graph& graph, const FluidState& fluid, Frame& frame) const {
  frame.scene = buffers_.importScene(graph);
  frame.counters = graph.create("view counters", {kCounterWords * 4});
  frame.edges = graph.create("view edges", {kEdges * sizeof(EdgeRecord)});
  addFill(graph, "view clear", {{&frame.counters, 0}});
  add(graph, "view edges", edges_, 1, frame);
  if (scene().solids.empty())
    graph.skipped("view poses", "the scene has no solids");
  else
    frame.poses = buffers_.addPoses(graph, fluid, frame.scene, frame.push);
}

/// For each tile of the picture or the light map, the solids that may be visible in it.
void ParticleView::addSolidMasks(Graph& graph, Frame& frame, bool light) const {
  const uint64_t tiles = light ? gridCells(scene().scene.counts.y, scene().scene.counts.z, kPixelTile)
                               : gridCells(frame.push.width, frame.push.height, kPixelTile);
  const uint64_t words = tiles * divideUp(scene().solids.size(), 32);
  frame.masks = graph.create(light ? "view light masks" : "view solid masks", {words * 4});
  add(graph, "view solid tiles", light ? lightTiles_ : solidTiles_, divideUp(words, kParticleGroup), frame);
}

/// The nearest floor or solid of each pixel.
void ParticleView::addSurfaces(Graph& graph, Frame& frame) const {
  const bool solids = !scene().solids.empty();
  if (solids) addSolidMasks(graph, frame, false);
  frame.depth = graph.create("view depth", {frame.pixels * 4});
  frame.winner = graph.create("view winner", {frame.pixels * 4});
  add(graph, "view surfaces", solids ? rays(frame).surfaces : floor_, gridCells(frame.push.width, frame.push.height, kPixelTile), frame);
}

/// The light map as the solids alone fill it.
void ParticleView::addLightMap(Graph& graph, Frame& frame) const {
  if (!hasShadows(frame)) return;
  frame.light = graph.create("view light map", {lightTexels() * 4});
  if (scene().solids.empty()) {
    graph.skipped("view light solids", "the scene has no solids");
    addFill(graph, "view clear", {{&frame.light, kNoDepthBits}});
    return;
  }
  addSolidMasks(graph, frame, true);
  add(graph, "view light solids", rays(frame).lightSolids, gridCells(scene().scene.counts.y, scene().scene.counts.z, kPixelTile), frame);
}

/// Particles into the light map, and the list of those that may be visible.
void ParticleView::addVisibility(Graph& graph, Frame& frame) const {
  frame.occluders = graph.create("view occluders", {gridCells(frame.push.width, frame.push.height, frame.push.cell) * 4});
  frame.survivors = graph.create("view survivors", {uint64_t{frame.push.count} * 4});
  addFill(graph, "view clear", {{&frame.occluders, kNoDepthBits}});
  add(graph, "view project", project_, frame.particles.groups, frame);
  add(graph, "view cull", cull_, frame.particles.groups, frame);
  addArguments(graph, frame);
}

/// Writes every indirect argument from the counts so far.
void ParticleView::addArguments(Graph& graph, Frame& frame) const { add(graph, "view arguments", arguments_, 1, frame); }

/// Depths, or the particles that own them: one kernel for both, so that both find exactly the same depths.
void ParticleView::addSplat(Graph& graph, Frame& frame, bool winners) const {
  frame.push.winners = winners ? 1 : 0;
  add(graph, winners ? "view winner" : "view depth", splat_, {frame.counters, kSmallArguments * 4}, frame);
  add(graph, winners ? "view winner large" : "view depth large", splatLarge_, {frame.counters, kLargeArguments * 4}, frame);
  frame.push.winners = 0;
}

/// Color, ambient occlusion and shadow of each particle that may be visible.
void ParticleView::addTint(Graph& graph, Frame& frame) const {
  frame.tint = graph.create("view tint", {std::max<uint64_t>(frame.push.count, 1) * 8});
  const bool mixed = mixedTint_ && frame.push.coloring == kByFluid && frame.concentration != BufferRef{};
  add(graph, "view tint", mixed ? mixedTint_ : tint_, {frame.counters, kTintArguments * 4}, frame);
}

void ParticleView::addFloorShadow(Graph& graph, Frame& frame) const {
  if (!hasFloor() || !hasShadows(frame) || frame.push.unlit) {
    graph.skipped("view floor shadow", !hasFloor()        ? "the domain has no floor"
                                       : frame.push.unlit ? "nothing is lit"
                                                          : "nothing casts a shadow");
    return;
  }
  frame.floor = graph.create("view floor light", {lightTexels() * 4});
  add(graph, "view floor shadow", floorShadow_, divideUp(lightTexels(), kParticleGroup), frame);
}

/// Lists the tiles by what they hold, for the passes of addShade().
void ParticleView::addClassify(Graph& graph, Frame& frame) const {
  const uint64_t tiles = gridCells(frame.push.width, frame.push.height, kShadeTile);
  frame.tiles = graph.create("view tiles", {tiles * kTileLists * 4});
  add(graph, "view classify", classify_, divideUp(tiles, kParticleGroup), frame);
  addArguments(graph, frame);
}

/// Each pass runs on a list of tiles and writes the pixels of its own kind; together they write all.
void ParticleView::addShade(Graph& graph, Frame& frame) const {
  frame.shaded = graph.create("view shaded", {frame.pixels * 4});
  frame.rims = graph.create("view rims", {frame.pixels * 4});
  frame.picture = graph.create("view picture", {frame.pixels * 4});
  const auto onTiles = [&](std::string_view name, const ComputePipeline* pipeline, uint32_t list) {
    add(graph, name, pipeline, {frame.counters, (kTileArguments + 4 * list) * 4}, frame);
  };
  const bool fluid = frame.push.count > 0, solids = !scene().solids.empty(), shadows = frame.floor != BufferRef{};
  onTiles("view shade sky", shadeSky_, kTilesSky);
  if (hasFloor()) onTiles("view shade floor", shadows ? shadeShadowedFloor_ : shadeFloor_, kTilesFloor);
  if (fluid) onTiles("view shade fluid", shadeFluid_, kTilesFluid);
  if (solids) onTiles("view shade solids", rays(frame).shadeSolids, kTilesSolid);
  if (fluid || solids) onTiles("view resolve", resolve_, kTilesOutline);
  if (scene().scene.domain_min.w > 0) onTiles("view draw edges", drawEdges_, kTilesEdge);
}

}  // namespace rill
