#pragma once
// What a mesh does to a fluid, sampled on a grid as the device has it (shaders/shared/mesh_field.h).
#include <cstdint>
#include <vector>

#include "rill/expected.hpp"
#include "shape/distance_grid.hpp"
#include "sph/half_space.hpp"
#include "sph/solid_scale.hpp"

namespace rill {

/// A mesh displaces the density F(s) c: F of a half-space (half_space.hpp) at the signed distance s, and the factor c, the share of the
/// kernel that is inside the mesh over the share inside the half-space that touches the mesh at its closest point. c is 1 at flat faces,
/// less at convex edges and at thin walls, more in corners. Both are interpolated trilinearly between nodes, so that the gradient is that
/// of the density.
class MeshField {
 public:
  /// Up to this distance from the surface (m) nodes are fine: what a solid displaces, and 1.5 spacings that particles may move.
  static double reach(const SmoothingKernel& kernel);

  struct Sample {
    double distance = 0;          ///< m, negative inside
    Double3 gradient = {};        ///< of the distance
    double factor = 1;            ///< c
    Double3 factorGradient = {};  ///< 1/m
  };

  /// Words of all fields of a fluid: 120 MB, below the range of a storage buffer on every device that runs one.
  static constexpr uint64_t kMaxWords = 30'000'000;

  /// Nodes are half a spacing apart, or, where the device's words would not suffice, 1, 2 or 4 spacings. TooLarge where that does not do
  /// either.
  static Expected<MeshField> create(const Mesh& mesh, const SmoothingKernel& kernel);

  /// At a point of the mesh's frame, m; as the device computes it, in double precision.
  Sample sample(const Double3& local) const;

  const std::vector<uint32_t>& words() const { return words_; }
  double cell() const { return cell_; }  ///< m, between nodes near the surface

 private:
  std::vector<uint32_t> words_;
  double cell_ = 0;
};

/// The density that a mesh displaces; `coverage` is 0.
SolidSample meshSample(const HalfSpaceTable& table, const MeshField& field, const Double3& local);

}  // namespace rill
