#include "sph/mesh_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/words.hpp"
#include "shared/mesh_field.h"

namespace rill {
namespace {

static_assert(kFieldCells == DistanceGrid::kCells && kFieldNodes == DistanceGrid::kNodes);

constexpr double kMaxCoarseWords = 4e6;  // blocks and their corners, each of which is a search for the nearest triangle

/// Distances in and around a block of nodes, and what the field stores at these: c of the header, by sums over the nodes that the
/// kernel reaches (the same sums over the half-space make it 1 at flat faces), and the distance.
class BlockWindow {
 public:
  BlockWindow(const DistanceGrid& grid, const SmoothingKernel& kernel)
      : grid_(grid),
        reach_(static_cast<int64_t>(std::ceil(kernel.h() / grid.cell))),
        side_(DistanceGrid::kNodes + 2 * reach_),
        shares_(static_cast<size_t>(side_ * side_ * side_)),
        distances_(shares_.size()) {
    for (int64_t z = -reach_; z <= reach_; ++z)
      for (int64_t y = -reach_; y <= reach_; ++y)
        for (int64_t x = -reach_; x <= reach_; ++x) {
          const double r = grid.cell * std::sqrt(static_cast<double>(x * x + y * y + z * z));
          if (r >= kernel.h()) continue;
          taps_.push_back({(z * side_ + y) * side_ + x, {float(x), float(y), float(z)}, static_cast<float>(kernel.value(r))});
          all_ += taps_.back().weight;
        }
  }

  /// Before the nodes of a block, given by its first node.
  void enter(const std::array<int64_t, 3>& first) {
    size_t n = 0;
    for (int64_t z = -reach_; z < side_ - reach_; ++z)
      for (int64_t y = -reach_; y < side_ - reach_; ++y)
        for (int64_t x = -reach_; x < side_ - reach_; ++x, ++n)
          distances_[n] = static_cast<float>(grid_.at({first[0] + x, first[1] + y, first[2] + z}) / grid_.cell);
    // Taps end a node before the window does.
    for (int64_t z = 1; z < side_ - 1; ++z)
      for (int64_t y = 1; y < side_ - 1; ++y)
        for (int64_t at = (z * side_ + y) * side_ + 1, end = at + side_ - 2; at < end; ++at)
          shares_[static_cast<size_t>(at)] = shareInside(distances_[static_cast<size_t>(at)] + laplacian(at) / 24);
  }

  /// To store at a node of the block, m. Interpolation along each axis lies above a convex function, by cell²/12 of its Laplacian in
  /// the mean over a cell, and would make a convex mesh smaller: the node has that much less. Flat faces stay as they are.
  double distance(const std::array<size_t, 3>& node) const {
    const int64_t at = indexOf(node);
    return (double{distances_[static_cast<size_t>(at)]} - double{laplacian(at)} / 12) * grid_.cell;
  }

  /// c of a node of the block, by its numbers within it.
  double factor(const std::array<size_t, 3>& node) const {
    const std::array<int64_t, 3> steps = this->steps();
    const int64_t at = indexOf(node);
    const float* distance = distances_.data() + at;
    const float* share = shares_.data() + at;
    float normal[3] = {0, 1, 0};  // between two faces any direction does
    const float slope[3] = {distance[steps[0]] - distance[-steps[0]], distance[steps[1]] - distance[-steps[1]],
                            distance[steps[2]] - distance[-steps[2]]};
    if (const float length = std::hypot(slope[0], slope[1], slope[2]); length > 0)
      for (size_t a = 0; a < 3; ++a) normal[a] = slope[a] / length;
    float mesh = 0, half = 0;
    for (const Tap& tap : taps_) {
      mesh += tap.weight * share[tap.step];
      half += tap.weight * shareInside(*distance + normal[0] * tap.offset[0] + normal[1] * tap.offset[1] + normal[2] * tap.offset[2]);
    }
    constexpr float kLeast = 1e-4f;  // of the kernel: F is as good as 0 there
    return half > kLeast * all_ ? std::min<double>(mesh / half, 1.0 + kFieldFactorRange) : 1.0;
  }

 private:
  /// Where a neighboring node is, and the kernel's value there.
  struct Tap {
    int64_t step;
    float offset[3];  // cells
    float weight;
  };
  /// Of a cell whose points are at this distance (cells) in the mean, as if it faced the surface.
  static float shareInside(float distance) { return std::clamp(0.5f - distance, 0.0f, 1.0f); }
  /// Of the distance, cells, at a node that is not the window's last.
  float laplacian(int64_t at) const {
    const float* distance = distances_.data() + at;
    float sum = -6 * *distance;
    for (int64_t step : steps()) sum += distance[step] + distance[-step];
    return sum;
  }
  /// To the next node along each axis.
  std::array<int64_t, 3> steps() const { return {1, side_, side_ * side_}; }
  int64_t indexOf(const std::array<size_t, 3>& node) const {
    int64_t at = 0;
    for (size_t a = 0; a < 3; ++a) at += (static_cast<int64_t>(node[a]) + reach_) * steps()[a];
    return at;
  }

  const DistanceGrid& grid_;
  int64_t reach_, side_;                   // cells that the kernel reaches; nodes along the window around a block
  std::vector<float> shares_, distances_;  // in the window; distances in cells
  std::vector<Tap> taps_;
  float all_ = 0;
};

uint32_t packed(double distance, double factor, double range) {
  const auto part = [](double v) { return static_cast<uint16_t>(static_cast<int16_t>(std::lround(std::clamp(v, -1.0, 1.0) * 32767))); };
  return part(distance / range) | uint32_t{part((factor - 1) / kFieldFactorRange)} << 16;
}

double unpacked(uint32_t word, int part) {
  return std::max(static_cast<double>(static_cast<int16_t>(word >> 16 * part & 0xffffu)) / 32767, -1.0);
}

uint32_t wordOf(double v) { return std::bit_cast<uint32_t>(static_cast<float>(v)); }
double numberOf(uint32_t word) { return std::bit_cast<float>(word); }

/// Largest distance of a node, m.
double rangeOf(const DistanceGrid& grid) {
  float most = 0;
  for (float s : grid.nodes) most = std::max(most, std::abs(s));
  return std::max<double>(most, grid.cell);
}

}  // namespace

double MeshField::reach(const SmoothingKernel& kernel) { return solidReach(kernel) + 1.5 * kernel.spacing(); }

Expected<MeshField> MeshField::create(const Mesh& mesh, const SmoothingKernel& kernel) {
  const double d = kernel.spacing(), shell = mesh.twoSided() ? 0.5 * d : 0.0;
  const DistanceBand band{.inside = d, .outside = reach(kernel)};
  MeshField field;
  DistanceGrid grid;
  double words = 0;
  for (double cell = 0.5 * d; cell <= 4 * d; cell *= 2) {
    words = gridWords(mesh, cell, band);
    if (words > kMaxCoarseWords) continue;
    auto sampled = sampleDistances(mesh, cell, band, shell, kMaxWords - static_cast<uint64_t>(words));
    if (!sampled) continue;
    grid = *std::move(sampled);
    field.cell_ = cell;
    break;
  }
  if (field.cell_ == 0)
    return Error{ErrorKind::TooLarge,
                 "a mesh of " + roundedNumber(mesh.max()[0] - mesh.min()[0]) + " x " + roundedNumber(mesh.max()[1] - mesh.min()[1]) +
                     " x " + roundedNumber(mesh.max()[2] - mesh.min()[2]) + " m needs a field of more than " + grouped(4 * kMaxWords) +
                     " bytes at a spacing of " + roundedNumber(d) + " m; expected a smaller mesh, or a larger spacing"};
  const double range = rangeOf(grid);
  std::vector<uint32_t>& out = field.words_;
  const auto header = [&](uint32_t at, uint32_t value) { out[at] = value; };
  out.resize(kFieldHeader);
  for (uint32_t a = 0; a < 3; ++a) {
    header(kFieldBlocks + a, grid.blocks[a]);
    header(kFieldLow + a, wordOf(grid.low[a]));
  }
  header(kFieldEdge, wordOf(grid.block()));
  header(kFieldRange, wordOf(range));
  header(kFieldCorners, static_cast<uint32_t>(out.size()));
  for (float s : grid.corners) out.push_back(wordOf(s));
  header(kFieldFine, static_cast<uint32_t>(out.size()));
  const size_t nodes = out.size() + grid.fine.size();
  for (uint32_t fine : grid.fine)
    out.push_back(fine == DistanceGrid::kCoarse ? kFieldCoarse : static_cast<uint32_t>(nodes + size_t{fine} * DistanceGrid::kBlockNodes));
  out.reserve(nodes + grid.nodes.size());
  BlockWindow window(grid, kernel);
  const double displacing = solidReach(kernel);
  for (size_t block = 0, n = 0; block < grid.blockCount(); ++block) {
    if (grid.fine[block] == DistanceGrid::kCoarse) continue;
    const std::array<size_t, 3> in{block % grid.blocks[0], block / grid.blocks[0] % grid.blocks[1],
                                   block / (size_t{grid.blocks[0]} * grid.blocks[1])};
    window.enter({int64_t(in[0] * kFieldCells), int64_t(in[1] * kFieldCells), int64_t(in[2] * kFieldCells)});
    for (size_t k = 0; k < DistanceGrid::kBlockNodes; ++k, ++n) {
      const double s = grid.nodes[n];
      const bool displaces = s < displacing + grid.cell && s > -band.inside - grid.cell;
      const std::array<size_t, 3> node{k % kFieldNodes, k / kFieldNodes % kFieldNodes, k / (kFieldNodes * kFieldNodes)};
      out.push_back(packed(window.distance(node), displaces ? window.factor(node) : 1.0, range));
    }
  }
  return field;
}

MeshField::Sample MeshField::sample(const Double3& local) const {
  const uint32_t* w = words_.data();
  const double edge = numberOf(w[kFieldEdge]), range = numberOf(w[kFieldRange]);
  std::array<size_t, 3> block{}, cell{};
  Double3 t, beyond;
  for (size_t a = 0; a < 3; ++a) {
    const double low = numberOf(w[kFieldLow + a]), inside = std::clamp(local[a], low, low + edge * w[kFieldBlocks + a]);
    beyond[a] = local[a] - inside;
    const double at = (inside - low) / edge;
    block[a] = std::min(static_cast<size_t>(at), size_t{w[kFieldBlocks + a]} - 1);
    t[a] = std::clamp(at - static_cast<double>(block[a]), 0.0, 1.0);
  }
  const size_t bx = w[kFieldBlocks], by = w[kFieldBlocks + 1];
  const uint32_t own = w[w[kFieldFine] + (block[2] * by + block[1]) * bx + block[0]];
  const bool fine = own != kFieldCoarse;
  size_t row = bx + 1, layer = row * (by + 1), first = w[kFieldCorners] + block[2] * layer + block[1] * row + block[0];
  if (fine) {
    for (size_t a = 0; a < 3; ++a) {
      t[a] *= kFieldCells;
      cell[a] = std::min(static_cast<size_t>(t[a]), size_t{kFieldCells - 1});
      t[a] -= static_cast<double>(cell[a]);
    }
    row = kFieldNodes;
    layer = row * row;
    first = own + cell[2] * layer + cell[1] * row + cell[0];
  }
  double value[2] = {0, 0}, slope[2][3] = {};
  for (size_t k = 0; k < 8; ++k) {
    const std::array<size_t, 3> in{k & 1, k >> 1 & 1, k >> 2};
    const uint32_t word = w[first + in[0] + in[1] * row + in[2] * layer];
    const double node[2] = {fine ? unpacked(word, 0) * range : numberOf(word), fine ? 1 + unpacked(word, 1) * kFieldFactorRange : 1.0};
    double weight[3];
    for (size_t a = 0; a < 3; ++a) weight[a] = in[a] != 0 ? t[a] : 1 - t[a];
    for (size_t v = 0; v < 2; ++v) {
      value[v] += weight[0] * weight[1] * weight[2] * node[v];
      for (size_t a = 0; a < 3; ++a) slope[v][a] += (in[a] != 0 ? 1 : -1) * weight[(a + 1) % 3] * weight[(a + 2) % 3] * node[v];
    }
  }
  const double perMeter = (fine ? kFieldCells : 1.0) / edge, far = std::hypot(beyond.x, beyond.y, beyond.z);
  Sample s{.distance = value[0] + far, .factor = value[1]};
  for (size_t a = 0; a < 3; ++a) {
    s.gradient[a] = far > 0 ? beyond[a] / far : perMeter * slope[0][a];
    s.factorGradient[a] = far > 0 ? 0 : perMeter * slope[1][a];
  }
  if (far > 0) s.factor = 1;
  return s;
}

SolidSample meshSample(const HalfSpaceTable& table, const MeshField& field, const Double3& local) {
  const MeshField::Sample s = field.sample(local);
  const LineSample half = table.sample(s.distance);
  SolidSample out{.value = half.value * s.factor};
  for (size_t a = 0; a < 3; ++a) out.gradient[a] = half.slope * s.factor * s.gradient[a] + half.value * s.factorGradient[a];
  return out;
}

}  // namespace rill
