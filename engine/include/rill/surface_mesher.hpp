#pragma once
// The surface of a fluid as a closed triangle mesh, as passes of a render graph.
//
//   auto mesher = rill::SurfaceMesher::create(device, {.capacity = state.capacity});
//   if (!mesher) return fail(mesher.error().message);
//   const rill::SurfaceMesh mesh = mesher->addTo(graph, state);  // every frame in which the mesh is wanted
//   const rill::Ticket counts = graph.readback(mesh.counts);  // or a pass of the host reads them with Use::Indirect and draws mesh.indices
//
// The mesh is closed everywhere, along walls too: each edge belongs to exactly two triangles. A plane surface lies half a spacing outside
// the outermost particles, so that the enclosed volume is that of the fluid.
#include <cstdint>
#include <memory>

#include "rill/device.hpp"
#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"

namespace rill {

/// Parameters of SurfaceMesher::create(). A limit of 0 stands for one that suits most scenes; a mesh that needs more is left empty, and
/// SurfaceMesh::counts says what it needs.
struct SurfaceMesherDesc {
  uint32_t capacity = 0;      ///< particles at most, 1 to 2^22
  double cell = 0.5;          ///< side of the grid's cells in spacings, 0.25 to 1
  uint32_t maxBlocks = 0;     ///< of 4 x 4 x 4 bins of cells, about four spacings wide, near particles
  uint32_t maxVertices = 0;   ///< of the mesh
  uint32_t maxTriangles = 0;  ///< of the mesh
};

/// Words of SurfaceMesh::counts behind a VkDrawIndexedIndirectCommand, which are its first five.
enum class MeshCount : uint32_t {
  Indices = 0,          ///< three a triangle
  Vertices = 5,         ///< of the mesh
  NeededVertices = 6,   ///< of a complete mesh: above maxVertices the mesh is empty
  NeededTriangles = 7,  ///< the same
  NeededBlocks = 8,     ///< the same; above maxBlocks it may be a lower bound, and vertices and triangles are not counted
  TooFar = 10,          ///< particles left out: more than 1,021 blocks from FluidState::origin along x or z, or 509 along y
  BoundHits = 11,       ///< sums over particles that were cut off: more than 4,096 particles lie about a point
  Words = 12
};

/// Buffers of a graph that hold the mesh. Vectors are four floats, of which the last is unused.
struct SurfaceMesh {
  BufferRef positions;   ///< m, relative to FluidState::origin
  BufferRef normals;     ///< unit length, out of the fluid
  BufferRef velocities;  ///< m/s; 0 if the state has none
  BufferRef indices;     ///< uint, three a triangle, counter-clockwise seen from outside the fluid
  BufferRef counts;      ///< uint[], MeshCount::Words of them and some for the passes
};

class SurfaceMesherImpl;

/// Makes the mesh of a FluidState, of which it uses position, velocity (optional), countBuffer, capacity and spacing, as FluidRenderer
/// does. The mesh is bitwise deterministic per driver. Lifetime and moves as of a Fluid.
class RILL_API SurfaceMesher {
 public:
  /// BadInput for values out of range; TooLarge, naming the bytes needed, before anything is allocated; Shader, OutOfMemory.
  static Expected<SurfaceMesher> create(Device& device, const SurfaceMesherDesc& desc);
  ~SurfaceMesher();
  SurfaceMesher(SurfaceMesher&&) noexcept;
  SurfaceMesher& operator=(SurfaceMesher&&) noexcept;

  /// Declares the passes. The graph's compile() fails for a state of more than `capacity` particles, or one that is invalid. A state
  /// without particles has an empty mesh.
  SurfaceMesh addTo(Graph& graph, const FluidState& fluid);

  const SurfaceMesherDesc& limits() const;  ///< with the values that stand for zeros
  uint64_t bytes() const;                   ///< of device memory in a graph, before aliasing

 private:
  friend struct ImplAccess;  // engine/core/impl_of.hpp
  explicit SurfaceMesher(std::unique_ptr<SurfaceMesherImpl>);
  std::unique_ptr<SurfaceMesherImpl> impl_;
};

}  // namespace rill
