#include "fluid/boundaries.hpp"

#include <algorithm>

#include "fluid/numbers.hpp"
#include "sph/solid_density.hpp"
#include "sph/solid_pose.hpp"
#include "sph/wall.hpp"

namespace rill {
namespace {

/// Each entry with its successor behind it, so that a shader fetches the two it interpolates between at once.
void appendTable(std::vector<float>& tables, const std::vector<float>& table, uint32_t& offset) {
  offset = static_cast<uint32_t>(tables.size() / 4);
  for (size_t k = 0; k < table.size(); k += 2) {
    const size_t next = std::min(k + 2, table.size() - 2);
    tables.insert(tables.end(), {table[k], table[k + 1], table[next], table[next + 1]});
  }
}

}  // namespace

double fastestSolid(const Scene& scene) {
  double fastest = 0;
  for (const Solid& solid : scene.solids) {
    for (size_t k = 1; k < solid.motion.size(); ++k) {
      double way[3];
      for (int a = 0; a < 3; ++a) way[a] = solid.motion[k].translate[a] - solid.motion[k - 1].translate[a];
      fastest = std::max(fastest, length(way) / (solid.motion[k].at - solid.motion[k - 1].at));
    }
  }
  return fastest;
}

double fastestDriven(const Scene& scene) {
  double fastest = 0;
  for (const Solid& solid : scene.solids) fastest = std::max(fastest, solid.driven);
  return fastest;
}

void addSolids(const Scene& scene, const SmoothingKernel& kernel, const double origin[3], FluidSetup& setup) {
  for (const Solid& solid : scene.solids) {
    const SolidPose pose = solidPose(solid, 0.0);
    SolidRecord record{};
    record.shape = pose.sphere ? 1u : 0u;
    double translation[3];
    solidTranslation(solid, 0.0, translation);
    record.centerX = f(pose.center[0] - origin[0]);
    record.centerY = f(pose.center[1] - origin[1]);
    record.centerZ = f(pose.center[2] - origin[2]);
    record.baseX = f(pose.center[0] - translation[0] - origin[0]);
    record.baseY = f(pose.center[1] - translation[1] - origin[1]);
    record.baseZ = f(pose.center[2] - translation[2] - origin[2]);
    record.velocityX = f(pose.velocity[0]);
    record.velocityY = f(pose.velocity[1]);
    record.velocityZ = f(pose.velocity[2]);
    record.halfX = f(pose.half[0]);
    record.halfY = f(pose.half[1]);
    record.halfZ = f(pose.half[2]);
    record.rotationX = f(pose.rotation[0]);
    record.rotationY = f(pose.rotation[1]);
    record.rotationZ = f(pose.rotation[2]);
    record.rotationW = f(pose.rotation[3]);
    record.friction = f(pose.friction);
    record.restitution = f(pose.restitution);
    record.firstKey = static_cast<uint32_t>(setup.keyframes.size() / 4);
    record.keyCount = static_cast<uint32_t>(solid.motion.size());
    for (const Keyframe& key : solid.motion) {
      for (double x : key.translate) setup.keyframes.push_back(f(x));
      setup.keyframes.push_back(f(key.at));
    }
    if (solid.driven > 0) {
      record.driven = 1;
      record.keyCount = 2;
      setup.keyframes.insert(setup.keyframes.end(), 8, 0.0f);
      setup.driven.push_back({static_cast<uint32_t>(setup.solids.size()), solid.driven, {record.centerX, record.centerY, record.centerZ}});
      record.baseX = record.baseY = record.baseZ = 0;
    }
    setup.movingSolids |= record.keyCount > 0;
    if (pose.sphere) {
      const SphereTable table = makeSphereTable(kernel, pose.half[0]);
      appendTable(setup.tables, table.table, record.tableOffset);
      record.tableNodes = table.nodes;
      record.tableFirst = f(table.first);
    }
    setup.solids.push_back(record);
  }
}

void setWalls(const Scene& scene, const double origin[3], FluidParams& p) {
  float* low[3] = {&p.lowX, &p.lowY, &p.lowZ};
  float* high[3] = {&p.highX, &p.highY, &p.highZ};
  float* boundLow[3] = {&p.boundLowX, &p.boundLowY, &p.boundLowZ};
  float* boundHigh[3] = {&p.boundHighX, &p.boundHighY, &p.boundHighZ};
  double margin = 0.5 * scene.fluid.spacing;
  for (int a = 0; a < 3; ++a) {
    *low[a] = *boundLow[a] = -kNoWall;
    *high[a] = *boundHigh[a] = kNoWall;
    if (!scene.domain) continue;
    *boundLow[a] = f(scene.domain->min[a] - origin[a]);
    *boundHigh[a] = f(scene.domain->max[a] - origin[a]);
    if (!(scene.domain->open & (1u << (2 * a)))) *low[a] = *boundLow[a];
    if (!(scene.domain->open & (2u << (2 * a)))) *high[a] = *boundHigh[a];
    if (*low[a] > -kNoWall && *high[a] < kNoWall) margin = std::min(margin, 0.5 * (scene.domain->max[a] - scene.domain->min[a]));
  }
  p.margin = f(margin);
}

void addWallTables(const SmoothingKernel& kernel, FluidSetup& setup) {
  FluidParams& p = setup.params;
  const WallTables tables = makeWallTables(kernel);
  uint32_t first = 0;
  appendTable(setup.tables, tables.plane, first);
  appendTable(setup.tables, tables.edge, p.tableOffset2);
  appendTable(setup.tables, tables.corner, p.tableOffset3);
  appendTable(setup.tables, tables.face, p.tableOffsetFace);
  p.tableStep = f(tables.step);
  p.cornerStep = f(tables.cornerStep);
  p.tableNodes = tables.nodes;
  p.cornerNodes = tables.cornerNodes;
}

}  // namespace rill
