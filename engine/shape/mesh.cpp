// Mesh::create(): checks, repairs, builds the tree.
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <numeric>

#include "core/words.hpp"
#include "shape/mesh_impl.hpp"
#include "shape/mesh_repair.hpp"

namespace rill {

Mesh::Mesh(std::unique_ptr<MeshImpl> impl) : impl_(std::move(impl)) {}
Mesh::~Mesh() = default;

Expected<std::shared_ptr<const Mesh>> Mesh::create(MeshData data, bool twoSided) try {
  std::vector<std::string> warnings;
  if (auto ok = checkMeshData(data); !ok) return ok.error();
  weld(data, warnings);
  if (data.triangles.empty()) return Error{ErrorKind::BadInput, "found no triangle with three corners, expected a mesh"};
  if (!twoSided)
    if (auto ok = orient(data, warnings); !ok) return ok.error();
  double volume = 0;
  if (!twoSided) {
    turnInvertedParts(data, warnings);
    std::vector<uint32_t> all(data.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    volume = signedVolume(data, all);
  }
  auto impl = std::make_unique<MeshImpl>(std::move(data), twoSided);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  impl->low = {kFar, kFar, kFar};
  impl->high = {-kFar, -kFar, -kFar};
  double box = 1;
  for (const Triangle& t : impl->data.triangles)
    for (uint32_t corner : t) {
      const Double3& v = impl->data.vertices[corner];
      for (size_t a = 0; a < 3; ++a) {
        impl->low[a] = std::fmin(impl->low[a], v[a]);
        impl->high[a] = std::fmax(impl->high[a], v[a]);
      }
      impl->radius = std::fmax(impl->radius, std::hypot(v.x, v.y, v.z));
    }
  for (size_t a = 0; a < 3; ++a) box *= impl->high[a] - impl->low[a];
  if (!twoSided && !(volume > 1e-9 * box))
    return Error{ErrorKind::BadInput,
                 "the mesh encloses " + roundedNumber(volume) + " m^3; expected a volume, or \"two_sided\": true for a sheet"};
  impl->volume = volume;
  impl->warnings = std::move(warnings);
  return std::shared_ptr<const Mesh>(new Mesh(std::move(impl)));
} catch (const std::bad_alloc&) { return Error{ErrorKind::OutOfMemory, "not enough memory for the mesh"}; }

const MeshData& Mesh::data() const { return impl_->data; }
bool Mesh::twoSided() const { return impl_->twoSided; }
Double3 Mesh::min() const { return impl_->low; }
Double3 Mesh::max() const { return impl_->high; }
double Mesh::volume() const { return impl_->volume; }
const std::vector<std::string>& Mesh::warnings() const { return impl_->warnings; }

}  // namespace rill
