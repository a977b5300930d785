// The triangles of a glTF document: the nodes of its scene with their transforms.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "scene/affine.hpp"
#include "scene/gltf_document.hpp"
#include "scene/mesh_builder.hpp"

namespace rill {
namespace {

/// The elements of an accessor, all within its buffer.
struct GltfElements {
  const unsigned char* data = nullptr;
  uint64_t count = 0, stride = 0;
  int component = 0;

  template <class T>
  T get(uint64_t element, uint64_t index = 0) const {
    T value;
    std::memcpy(&value, data + element * stride + index * sizeof(T), sizeof(T));
    return value;
  }
  Float3 vector(uint64_t element) const { return {get<float>(element, 0), get<float>(element, 1), get<float>(element, 2)}; }
  uint32_t index(uint64_t element) const {
    return component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? get<uint8_t>(element)
           : component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? get<uint16_t>(element)
                                                                 : get<uint32_t>(element);
  }
};

class GltfMesh {
 public:
  GltfMesh(const tinygltf::Model& model, const std::filesystem::path& file) : model_(model), file_(file), mesh_(file) {}

  Expected<MeshData> read() {
    if (auto ok = checkExtensions(); !ok) return ok.error();
    if (model_.nodes.empty()) {
      for (size_t i = 0; i < model_.meshes.size(); ++i) {
        if (auto ok = addMesh(static_cast<int>(i), Affine{}, elementPath("meshes", i)); !ok) return ok.error();
      }
      return mesh_.finish();
    }
    if (auto ok = collectRoots(); !ok) return ok.error();
    if (auto ok = addNodes(); !ok) return ok.error();
    return mesh_.finish();
  }

 private:
  struct Placed {
    int node;
    Affine parent;
  };

  Error fault(const std::string& where, const std::string& what) const { return meshError(file_, where, what); }
  template <class List>
  static bool has(const List& list, int index) {
    return index >= 0 && static_cast<size_t>(index) < list.size();
  }
  template <class List>
  Error outOfRange(const std::string& where, int index, const List& list) const {
    return fault(where, "found the index " + std::to_string(index) + ", expected one from 0 and below " + grouped(list.size()));
  }

  /// Required extensions that change no shape are ignored.
  Expected<void> checkExtensions() const {
    for (const std::string& name : model_.extensionsRequired) {
      bool known = false;
      for (const std::string_view prefix : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"})
        known |= name.starts_with(prefix);
      if (!known) return fault("extensionsRequired", "found " + inQuotes(name) + ", expected none that changes shapes");
    }
    return {};
  }

  /// The nodes of the default scene, or all that have no parent.
  Expected<void> collectRoots() {
    if (model_.defaultScene != -1) {
      if (!has(model_.scenes, model_.defaultScene)) return outOfRange("scene", model_.defaultScene, model_.scenes);
      const auto& nodes = model_.scenes[static_cast<size_t>(model_.defaultScene)].nodes;
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) open_.push_back({*node, {}});
      return {};
    }
    std::set<int> children;
    for (const tinygltf::Node& node : model_.nodes) children.insert(node.children.begin(), node.children.end());
    for (size_t i = model_.nodes.size(); i-- > 0;) {
      if (!children.contains(static_cast<int>(i))) open_.push_back({static_cast<int>(i), {}});
    }
    return {};
  }

  /// Parents first, in the order of the file.
  Expected<void> addNodes() {
    std::vector<bool> seen(model_.nodes.size());
    while (!open_.empty()) {
      const Placed placed = open_.back();
      open_.pop_back();
      if (!has(model_.nodes, placed.node)) return outOfRange("nodes", placed.node, model_.nodes);
      const auto index = static_cast<size_t>(placed.node);
      const std::string where = elementPath("nodes", index);
      if (seen[index]) return fault(where, "found twice in the scene, expected a tree");
      seen[index] = true;
      const tinygltf::Node& node = model_.nodes[index];
      const auto local = transformOf(node, where);
      if (!local) return local.error();
      const Affine world = placed.parent * *local;
      if (node.mesh != -1) {
        if (auto ok = addMesh(node.mesh, world, where); !ok) return ok;
      }
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) open_.push_back({*child, world});
    }
    return {};
  }

  Expected<Affine> transformOf(const tinygltf::Node& node, const std::string& where) const {
    const auto fits = [](const std::vector<double>& numbers, size_t length) {
      return (numbers.empty() || numbers.size() == length) &&
             std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
    };
    if (!fits(node.matrix, 16) || !fits(node.rotation, 4) || !fits(node.scale, 3) || !fits(node.translation, 3))
      return fault(where,
                   "found an invalid transform, expected a matrix of 16 numbers, or a translation of 3, a rotation of 4 and a scale of 3");
    Affine out;
    if (!node.matrix.empty()) {
      for (size_t i = 0; i < 3; ++i) {
        for (size_t k = 0; k < 4; ++k) out.row[i][k] = node.matrix[4 * k + i];  // by columns
      }
      return out;
    }
    if (!node.rotation.empty()) {
      double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
      const double length = std::sqrt(x * x + y * y + z * z + w * w);
      if (!(length > 0) || !std::isfinite(length))
        return fault(memberPath(where, "rotation"), "found no direction, expected a unit quaternion");
      x /= length, y /= length, z /= length, w /= length;
      out.row = {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
                  {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
                  {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0}}};
    }
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3 && !node.scale.empty(); ++k) out.row[i][k] *= node.scale[k];
      if (!node.translation.empty()) out.row[i][3] = node.translation[i];
    }
    return out;
  }

  Expected<void> addMesh(int index, const Affine& transform, const std::string& node) {
    if (!has(model_.meshes, index)) return outOfRange(memberPath(node, "mesh"), index, model_.meshes);
    const auto& primitives = model_.meshes[static_cast<size_t>(index)].primitives;
    std::map<int, uint32_t> starts;
    for (size_t i = 0; i < primitives.size(); ++i) {
      const std::string where = elementPath(memberPath(elementPath("meshes", static_cast<size_t>(index)), "primitives"), i);
      if (auto ok = addPrimitive(primitives[i], transform, where, starts); !ok) return ok;
    }
    return {};
  }

  /// `starts`: first vertex of each accessor that has been added with this transform.
  Expected<void> addPrimitive(const tinygltf::Primitive& primitive, const Affine& transform, const std::string& where,
                              std::map<int, uint32_t>& starts) {
    const int mode = primitive.mode;
    if (mode >= TINYGLTF_MODE_POINTS && mode < TINYGLTF_MODE_TRIANGLES) return {};
    if (mode < 0 || mode > TINYGLTF_MODE_TRIANGLE_FAN)
      return fault(memberPath(where, "mode"), "found " + std::to_string(mode) + ", expected 0 to 6");
    const auto positions = attribute(primitive, "POSITION", where);
    if (!positions) return positions.error();
    const bool hasNormals = primitive.attributes.contains("NORMAL");
    const auto normals = hasNormals ? attribute(primitive, "NORMAL", where) : *positions;
    if (!normals) return normals.error();
    if (normals->count != positions->count) {
      return fault(memberPath(memberPath(where, "attributes"), "NORMAL"),
                   "found " + grouped(normals->count) + " normals, expected " + grouped(positions->count));
    }
    Expected<GltfElements> indices = *positions;
    if (primitive.indices != -1) {
      indices = elements(primitive.indices, TINYGLTF_TYPE_SCALAR, memberPath(where, "indices"));
      if (!indices) return indices.error();
    }
    if (auto ok = setMaterial(primitive.material, where); !ok) return ok;
    auto [start, added] = starts.try_emplace(primitive.attributes.at("POSITION"), static_cast<uint32_t>(mesh_.vertexCount()));
    if (added) {
      if (auto ok = addVertices(*positions, transform, where); !ok) return ok;
    }
    const NormalTransform turned(transform);
    const auto corner = [&](uint64_t k) { return primitive.indices == -1 ? k : indices->index(k); };
    const uint64_t length = indices->count, count = mode == TINYGLTF_MODE_TRIANGLES ? length / 3 : length < 3 ? 0 : length - 2;
    if (mode == TINYGLTF_MODE_TRIANGLES && length % 3 != 0)
      return fault(where, "found " + grouped(length) + " corners, expected three a triangle");
    for (uint64_t i = 0; i < count; ++i) {
      std::array<uint64_t, 3> k{3 * i, 3 * i + 1, 3 * i + 2};
      if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) k = {i, i + 1 + i % 2, i + 2 - i % 2};
      if (mode == TINYGLTF_MODE_TRIANGLE_FAN) k = {0, i + 1, i + 2};
      if (turned.mirrored) std::swap(k[1], k[2]);
      std::array<uint32_t, 3> triangle;
      std::array<Float3, 3> turnedNormals;
      for (size_t c = 0; c < 3; ++c) {
        const uint64_t vertex = corner(k[c]);
        if (vertex >= positions->count) {
          return fault(memberPath(where, "indices"),
                       "found the index " + grouped(vertex) + ", expected one below " + grouped(positions->count));
        }
        triangle[c] = static_cast<uint32_t>(start->second + vertex);
        if (hasNormals) turnedNormals[c] = turned(normals->vector(vertex));
      }
      const std::span<const Float3> all = turnedNormals;
      if (auto ok = mesh_.addPolygon(triangle, hasNormals ? all : all.first(0), [&] { return where; }); !ok) return ok;
    }
    return {};
  }

  Expected<void> addVertices(const GltfElements& positions, const Affine& transform, const std::string& where) {
    for (uint64_t i = 0; i < positions.count; ++i) {
      const Float3 p = positions.vector(i);
      const auto vertex = [&] { return elementPath(memberPath(memberPath(where, "attributes"), "POSITION"), i); };
      if (auto ok = mesh_.addVertex(transform.point({p.x, p.y, p.z}), vertex); !ok) return ok;
    }
    return {};
  }

  Expected<void> setMaterial(int index, const std::string& where) {
    if (index == -1) {
      mesh_.setColor({});
      return {};
    }
    if (!has(model_.materials, index)) return outOfRange(memberPath(where, "material"), index, model_.materials);
    const auto& color = model_.materials[static_cast<size_t>(index)].pbrMetallicRoughness.baseColorFactor;
    if (color.size() != 4) return fault(memberPath(where, "material"), "found an invalid base color, expected four numbers");
    mesh_.setColor(Float3{static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])});
    return {};
  }

  Expected<GltfElements> attribute(const tinygltf::Primitive& primitive, const std::string& name, const std::string& where) {
    const std::string path = memberPath(memberPath(where, "attributes"), name);
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return fault(path, "missing, expected an accessor");
    auto out = elements(found->second, TINYGLTF_TYPE_VEC3, path);
    const bool fresh = name == "NORMAL" && checkedNormals_.insert(found->second).second;
    for (uint64_t i = 0; out && i < out->count && fresh; ++i) {
      for (const float v : out->vector(i)) {
        if (!std::isfinite(v)) return fault(elementPath(path, i), "found " + shortestNumber(v) + ", expected finite numbers");
      }
    }
    return out;
  }

  /// The elements of an accessor: vectors of floats, or indices of 8, 16 or 32 bits.
  Expected<GltfElements> elements(int index, int type, const std::string& where) const {
    if (!has(model_.accessors, index)) return outOfRange(where, index, model_.accessors);
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<size_t>(index)];
    const std::string path = elementPath("accessors", static_cast<size_t>(index));
    if (accessor.sparse.isSparse) return fault(path, "found a sparse accessor, expected one with a buffer view alone");
    if (!has(model_.bufferViews, accessor.bufferView))
      return outOfRange(memberPath(path, "bufferView"), accessor.bufferView, model_.bufferViews);
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<size_t>(accessor.bufferView)];
    const std::string viewPath = elementPath("bufferViews", static_cast<size_t>(accessor.bufferView));
    if (!has(model_.buffers, view.buffer)) return outOfRange(memberPath(viewPath, "buffer"), view.buffer, model_.buffers);
    const auto& bytes = model_.buffers[static_cast<size_t>(view.buffer)].data;
    const bool vector = type == TINYGLTF_TYPE_VEC3;
    const uint64_t component = vector                                                             ? 4
                               : accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE  ? 1
                               : accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2
                               : accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT   ? 4
                                                                                                  : 0;
    if (accessor.type != type || component == 0 || (vector && accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)) {
      return fault(path, "found the component type " + std::to_string(accessor.componentType) + " or another type, expected " +
                             (vector ? "VEC3 of 5126 (float)" : "SCALAR of 5121, 5123 or 5125 (unsigned)"));
    }
    const uint64_t size = vector ? 3 * component : component, stride = view.byteStride == 0 ? size : view.byteStride;
    const uint64_t room = view.byteLength - std::min<uint64_t>(view.byteLength, accessor.byteOffset);
    if (stride < size)
      return fault(memberPath(viewPath, "byteStride"), "found " + grouped(stride) + ", expected at least " + grouped(size));
    if (accessor.count > 0 && (room < size || accessor.count - 1 > (room - size) / stride)) {
      return fault(path, "found " + grouped(accessor.count) + " elements from byte " + grouped(accessor.byteOffset) +
                             ", expected them within the " + grouped(view.byteLength) + " bytes of " + viewPath);
    }
    return GltfElements{bytes.data() + view.byteOffset + accessor.byteOffset, accessor.count, stride, accessor.componentType};
  }

  const tinygltf::Model& model_;
  const std::filesystem::path& file_;
  MeshBuilder mesh_;
  std::vector<Placed> open_;      // nodes to add, the next last
  std::set<int> checkedNormals_;  // accessors
};

}  // namespace

Expected<MeshData> readGltf(std::string_view bytes, const std::filesystem::path& file, bool binary) {
  const auto model = loadGltf(bytes, file, binary);
  if (!model) return model.error();
  return GltfMesh(*model, file).read();
}

}  // namespace rill
