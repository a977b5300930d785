#include "lanes/walk_scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace rill::lanes {
namespace {

constexpr float kSpacing = 0.05f, kSupport = 0.1f, kReach = 0.11f;
constexpr float kFarthestCell = 8388608.0f;  // grid.glsl

/// cellKey(cellOf(x)) of grid.glsl.
uint32_t keyOf(const FluidParams& params, const std::array<float, 4>& x) {
  const uint32_t size[3] = {params.gridSizeX, params.gridSizeY, params.gridSizeZ};
  uint32_t cell[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    const float scale = params.inverseCell * (axis == 0 ? float(kCellsPerReach) : 1.0f), cells = float(size[axis]);
    const float place = std::floor(std::clamp(x[axis] * scale, -kFarthestCell, kFarthestCell));
    cell[axis] = std::min(uint32_t(place - cells * std::floor(place / cells)), size[axis] - 1);
  }
  return (cell[2] * size[1] + cell[1]) * size[0] + cell[0];
}

template <class T>
std::vector<uint32_t> wordsOf(const T& record) {
  std::vector<uint32_t> out(sizeof record / 4);
  std::memcpy(out.data(), &record, sizeof record);
  return out;
}

}  // namespace

WalkScene::WalkScene() {
  params.spacing = kSpacing;
  params.support = kSupport;
  params.inverseSupport = 1 / kSupport;
  params.valueScale = 0.05f;
  params.gradientScale = -1;
  params.inverseRestGradient = 1;
  params.reach = params.nearReach = kReach;
  params.inverseCell = 1 / kReach;
  params.gridSizeX = 16;
  params.gridSizeY = params.gridSizeZ = 6;
  params.lowX = params.lowY = params.lowZ = params.boundLowX = params.boundLowY = params.boundLowZ = -kNoWall;
  params.highX = params.highY = params.highZ = params.boundHighX = params.boundHighY = params.boundHighZ = kNoWall;
  params.farLimit = 1.0e6f;
  params.warmLimit = 1;
  params.fullNeighbors = 20;

  std::mt19937 random(7);
  std::uniform_real_distribution<float> wide(-0.15f, 0.35f), narrow(0.1f, 0.13f);
  std::vector<std::pair<uint32_t, std::array<float, 4>>> made;
  const auto add = [&](float x, float y, float z) {
    const std::array<float, 4> place{x, y, z, 0};
    made.emplace_back(keyOf(params, place), place);
  };
  for (int k = 0; k < 250; ++k) add(wide(random), wide(random), wide(random));
  for (int k = 0; k < 45; ++k) add(narrow(random), narrow(random), narrow(random));  // more than a window, and than the list holds
  for (int k = 0; k < 5; ++k) add(kInactivePosition, kInactivePosition, kInactivePosition);
  std::ranges::stable_sort(made, {}, [](const auto& entry) { return entry.first; });
  for (auto& [key, place] : made) {
    place[3] = std::bit_cast<float>(static_cast<uint32_t>(particles.size()) + 0x00800000u);  // shared/number.glsl
    keys.push_back(key);
    particles.push_back(place);
  }
  params.chunkParticles = kListBlock;
  params.listCapacity = kListCapacity;
  particles.push_back({kInactivePosition, kInactivePosition, kInactivePosition, 0});
  keys.push_back(0);
  params.capacity = count();
  cellStart.resize(params.gridSizeX * params.gridSizeY * params.gridSizeZ + 1);
  for (uint32_t i = 0; i < count(); ++i) ++cellStart[keys[i] + 1];
  for (size_t k = 1; k < cellStart.size(); ++k) cellStart[k] += cellStart[k - 1];
}

std::vector<uint32_t> WalkScene::neighborsOf(uint32_t i, float distance) const {
  std::vector<uint32_t> found;
  for (uint32_t j = 0; j < count() && particles[i][0] < kInactiveLimit; ++j) {
    float squared = 0;
    for (size_t axis = 0; axis < 3; ++axis)
      squared += (particles[i][axis] - particles[j][axis]) * (particles[i][axis] - particles[j][axis]);
    if (j != i && squared < distance * distance) found.push_back(j);
  }
  return found;
}

double WalkScene::densityOf(uint32_t i) const {
  double sum = 0;
  for (uint32_t j = 0; j < count(); ++j) {
    double squared = 0;
    for (size_t axis = 0; axis < 3; ++axis) squared += std::pow(double(particles[i][axis]) - particles[j][axis], 2);
    const double q = std::sqrt(squared) / params.support;
    sum += std::pow(std::max(1 - q, 0.0), 4) * (1 + 4 * q);
  }
  return params.valueScale * sum;
}

Outcome walk(const WalkScene& scene, const EmbeddedShader& shader, uint32_t subgroupSize, uint32_t cluster, Rules rules, uint32_t seed) {
  const bool hasList = shader.name == "fluid/build";  // others walk
  std::map<uint32_t, uint32_t> constants;
  for (const ShaderConstant& constant : shader.constants) {
    if (constant.name == "CLUSTER") constants[constant.id] = cluster;
    if (constant.name == "LIST_CAPACITY") constants[constant.id] = hasList ? kListCapacity : 0;
    if (constant.name == "WALKS") constants[constant.id] = 1;
  }
  const Program program(shader.words, constants);
  FluidControl control{};
  control.count = control.solved = scene.count();
  control.step = control.nextStep = control.warmStep = 0.001f;
  control.relaxation = control.nextRelaxation = 0.5f;
  Memory memory;
  memory.push =
      wordsOf(DensityPush{.first = 0, .last = scene.count(), .iteration = 0, .parity = 0, .blockStart = 0});  // begins as ChunkPush
  std::vector<uint32_t> particles(scene.particles.size() * 4);
  std::memcpy(particles.data(), scene.particles.data(), particles.size() * 4);
  for (uint32_t k = 0; k < shader.bindings.size(); ++k) {
    auto& words = memory.buffers[k];
    const std::string_view name = shader.bindings[k].name;
    if (name == "params")
      words = wordsOf(scene.params);
    else if (name == "control")
      words = wordsOf(control);
    else if (name == "sums")
      words = wordsOf(FluidSums{});
    else if (name == "cellStart")
      words = scene.cellStart;
    else if (name == "cell")
      words = scene.keys;
    else if (name == "particle" || name == "sortedPrediction" || name == "sortedPosition" || name == "orderedPosition")
      words = particles;
    else if (name == "list")
      words.resize(kListBlock * kListCapacity);
    else if (name == "histogram")
      words.resize(3 * kMeasureBins);
    else
      words.resize(particles.size());
  }
  Outcome out;
  const uint32_t groups = (scene.count() + kFluidGroup - 1) / kFluidGroup;
  for (uint32_t group = 0; group < groups; ++group)
    for (uint32_t k = 0; k < kFluidGroup / subgroupSize && out.strayShuffles == 0; ++k) {
      Subgroup subgroup(program, memory, {subgroupSize, k, group, groups}, rules, seed + 1000 * group + k);
      subgroup.run();
      out.strayShuffles += subgroup.strayShuffles();
    }
  for (uint32_t k = 0; k < shader.bindings.size(); ++k) out.arrays[std::string(shader.bindings[k].name)] = memory.buffers[k];
  return out;
}

}  // namespace rill::lanes
