// The passes of the particle view: visibility, light, and shading by lists of tiles.
#include <algorithm>

#include "graph/step.hpp"
#include "render/surface_buffers.hpp"
#include "views/particle_view.hpp"

namespace rill {

using namespace particle_view;

namespace {

constexpr uint32_t kInfinity = 0x7F800000u;  // bits of the float

}  // namespace

void ParticleView::addSetup(Graph& graph, const FluidState& fluid, Frame& frame) const {
  frame.scene = buffers_.importScene(graph);
  frame.counters = graph.create("view counters", {kCounterWords * 4});
  frame.edges = graph.create("view edges", {kEdges * sizeof(EdgeRecord)});
  addFill(graph, "view clear", {{&frame.counters, 0}});
  addStep(graph, "view edges", edges_, {uniform(frame.scene), fresh(frame.edges)}, 1, frame.push);
  if (scene().solids.empty())
    graph.skipped("view poses", "the scene has no solids");
  else
    frame.poses = buffers_.addPoses(graph, fluid, frame.scene, frame.push);
}

/// For each tile of the picture or the light map, the solids that may be visible in it.
BufferRef ParticleView::addSolidMasks(Graph& graph, const Frame& frame, bool light) const {
  const uint64_t tiles = light ? gridCells(scene().scene.counts.y, scene().scene.counts.z, kPixelTile)
                               : gridCells(frame.push.width, frame.push.height, kPixelTile);
  const uint64_t words = tiles * divideUp(scene().solids.size(), 32);
  BufferRef masks = graph.create(light ? "view light masks" : "view solid masks", {words * 4});
  addStep(graph, "view solid tiles", light ? lightTiles_ : solidTiles_, {uniform(frame.scene), reads(frame.poses), fresh(masks)},
          divideUp(words, kParticleGroup), frame.push);
  return masks;
}

/// The nearest floor or solid of each pixel.
void ParticleView::addSurfaces(Graph& graph, Frame& frame) const {
  const uint64_t groups = gridCells(frame.push.width, frame.push.height, kPixelTile);
  const auto createTargets = [&] {
    frame.depth = graph.create("view depth", {frame.pixels * 4});
    frame.winner = graph.create("view winner", {frame.pixels * 4});
  };
  if (scene().solids.empty()) {
    createTargets();
    addStep(graph, "view surfaces", floor_, {uniform(frame.scene), fresh(frame.depth), fresh(frame.winner)}, groups, frame.push);
    return;
  }
  const BufferRef masks = addSolidMasks(graph, frame, false);
  createTargets();
  addStep(graph, "view surfaces", surfaces_,
          {uniform(frame.scene), fresh(frame.depth), fresh(frame.winner), reads(frame.poses), reads(masks)}, groups, frame.push);
}

/// The light map as the solids alone fill it.
void ParticleView::addLightMap(Graph& graph, Frame& frame) const {
  if (!hasShadows(frame)) return;
  frame.light = graph.create("view light map", {lightTexels() * 4});
  if (scene().solids.empty()) {
    graph.skipped("view light solids", "the scene has no solids");
    addFill(graph, "view clear", {{&frame.light, kInfinity}});
    return;
  }
  const BufferRef masks = addSolidMasks(graph, frame, true);
  // Binding 2 is not used by the variant for the light map.
  addStep(graph, "view light solids", lightSolids_,
          {uniform(frame.scene), fresh(frame.light), reads(frame.poses), reads(frame.poses), reads(masks)},
          gridCells(scene().scene.counts.y, scene().scene.counts.z, kPixelTile), frame.push);
}

/// Particles into the light map, and the list of those that may be visible.
void ParticleView::addVisibility(Graph& graph, Frame& frame) const {
  const uint64_t groups = divideUp(frame.push.count, kParticleGroup);
  BufferRef occluders = graph.create("view occluders", {gridCells(frame.push.width, frame.push.height, frame.push.cell) * 4});
  frame.survivors = graph.create("view survivors", {uint64_t{frame.push.count} * 4});
  addFill(graph, "view clear", {{&occluders, kInfinity}});
  addStep(graph, "view project", project_, {uniform(frame.scene), reads(frame.position), writes(occluders), writes(frame.light)}, groups,
          frame.push);
  addStep(graph, "view cull", cull_, {reads(frame.position), reads(occluders), writes(frame.counters), fresh(frame.survivors)}, groups,
          frame.push);
  addArguments(graph, frame);
}

/// Writes every indirect argument from the counts so far.
void ParticleView::addArguments(Graph& graph, Frame& frame) const {
  addStep(graph, "view arguments", arguments_, {writes(frame.counters)}, 1, frame.push);
}

/// Depths, or the particles that own them: one kernel for both, so that both find exactly the same depths.
void ParticleView::addSplat(Graph& graph, Frame& frame, bool winners) const {
  ViewPush push = frame.push;
  push.winners = winners ? 1 : 0;
  const auto add = [&](std::string_view name, const ComputePipeline* pipeline, uint32_t arguments) {
    addStep(graph, name, pipeline,
            {reads(frame.position), reads(frame.counters), reads(frame.survivors), winners ? reads(frame.depth) : writes(frame.depth),
             winners ? writes(frame.winner) : reads(frame.winner)},
            StepGroups(frame.counters, arguments), push);
  };
  add(winners ? "view winner" : "view depth", splat_, kSmallArguments);
  add(winners ? "view winner large" : "view depth large", splatLarge_, kLargeArguments);
}

/// Color, ambient occlusion and shadow of each particle that may be visible.
void ParticleView::addTint(Graph& graph, Frame& frame) const {
  frame.tint = graph.create("view tint", {std::max<uint64_t>(frame.push.count, 1) * 8});
  addStep(graph, "view tint", tint_,
          {uniform(frame.scene), reads(frame.position), reads(frame.velocity), reads(frame.counters), reads(frame.survivors),
           reads(frame.depth), reads(frame.light), fresh(frame.tint)},
          StepGroups(frame.counters, kTintArguments), frame.push);
}

void ParticleView::addFloorShadow(Graph& graph, Frame& frame) const {
  if (!hasFloor() || !hasShadows(frame) || frame.push.unlit) {
    graph.skipped("view floor shadow", !hasFloor()        ? "the domain has no floor"
                                       : frame.push.unlit ? "nothing is lit"
                                                          : "nothing casts a shadow");
    frame.floor = frame.edges;  // bound, not read
    return;
  }
  frame.floor = graph.create("view floor light", {lightTexels() * 4});
  addStep(graph, "view floor shadow", floorShadow_, {uniform(frame.scene), reads(frame.light), fresh(frame.floor)},
          divideUp(lightTexels(), kParticleGroup), frame.push);
}

/// Lists the tiles by what they hold, for the passes of addShade().
void ParticleView::addClassify(Graph& graph, Frame& frame) const {
  const uint64_t tiles = gridCells(frame.push.width, frame.push.height, kShadeTile);
  frame.tiles = graph.create("view tiles", {tiles * kTileLists * 4});
  addStep(graph, "view classify", classify_, {reads(frame.winner), reads(frame.edges), writes(frame.counters), fresh(frame.tiles)},
          divideUp(tiles, kParticleGroup), frame.push);
  addArguments(graph, frame);
}

/// Each pass runs on a list of tiles and writes the pixels of its own kind; together they write all.
void ParticleView::addShade(Graph& graph, Frame& frame) const {
  frame.shaded = graph.create("view shaded", {frame.pixels * 4});
  frame.rims = graph.create("view rims", {frame.pixels * 4});
  frame.picture = graph.create("view picture", {frame.pixels * 4});
  const auto onTiles = [&](uint32_t list) { return StepGroups(frame.counters, kTileArguments + 4 * list); };
  const bool fluid = frame.push.count > 0, solids = !scene().solids.empty();
  addStep(graph, "view shade sky", shadeSky_,
          {uniform(frame.scene), reads(frame.counters), reads(frame.tiles), reads(frame.winner), fresh(frame.shaded), fresh(frame.rims),
           fresh(frame.picture)},
          onTiles(kTilesSky), frame.push);
  if (hasFloor())
    addStep(graph, "view shade floor", shadeFloor_,
            {uniform(frame.scene), reads(frame.counters), reads(frame.tiles), reads(frame.winner), reads(frame.floor), writes(frame.shaded),
             writes(frame.rims), writes(frame.picture)},
            onTiles(kTilesFloor), frame.push);
  if (fluid)
    addStep(graph, "view shade fluid", shadeFluid_,
            {uniform(frame.scene), reads(frame.counters), reads(frame.tiles), reads(frame.winner), reads(frame.position), reads(frame.tint),
             writes(frame.shaded), writes(frame.rims)},
            onTiles(kTilesFluid), frame.push);
  if (solids)
    addStep(graph, "view shade solids", shadeSolids_,
            {uniform(frame.scene), reads(frame.counters), reads(frame.tiles), reads(frame.winner), reads(frame.poses), reads(frame.light),
             writes(frame.shaded), writes(frame.rims)},
            onTiles(kTilesSolid), frame.push);
  if (fluid || solids)
    addStep(graph, "view resolve", resolve_,
            {reads(frame.counters), reads(frame.tiles), reads(frame.depth), reads(frame.shaded), reads(frame.rims), writes(frame.picture)},
            onTiles(kTilesOutline), frame.push);
  if (scene().scene.domain_min.w > 0)
    addStep(graph, "view draw edges", drawEdges_,
            {reads(frame.counters), reads(frame.tiles), reads(frame.edges), reads(frame.depth), writes(frame.picture)}, onTiles(kTilesEdge),
            frame.push);
}

}  // namespace rill
