#pragma once
// One tetrahedron, (0, 0, 0), (1, 0, 0), (0, 1, 0) and (0, 0, 1), as mesh files.
#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rill::test {

inline constexpr std::array<std::array<float, 3>, 4> kTetrahedronVertices{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline constexpr std::array<std::array<uint8_t, 3>, 4> kTetrahedron{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

/// Bytes of a number of 8, 16 or 32 bits.
template <class T>
std::string numberBytes(T number, bool big = false) {
  const auto bits = [&] {
    if constexpr (std::is_same_v<T, float>)
      return std::bit_cast<uint32_t>(number);
    else
      return static_cast<uint32_t>(number);
  }();
  std::string out;
  for (size_t k = 0; k < sizeof(T); ++k) out += static_cast<char>(bits >> 8 * (big ? sizeof(T) - 1 - k : k));
  return out;
}
inline std::string vertexBytes(size_t vertex, bool big = false) {
  std::string out;
  for (const float v : kTetrahedronVertices[vertex]) out += numberBytes(v, big);
  return out;
}

inline std::string tetrahedronObj() { return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"; }

inline std::string asciiStl() {
  std::string text = "solid tetrahedron of 4\n";
  for (const auto& triangle : kTetrahedron) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const size_t v : triangle) {
      text += "      vertex";
      for (const float x : kTetrahedronVertices[v]) text += x == 0 ? " 0.0e+00" : " +1";
      text += '\n';
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid tetrahedron of 4\n";
}
inline std::string binaryStl(const std::string& header = "binary") {
  std::string bytes = header + std::string(80 - header.size(), ' ') + numberBytes<uint32_t>(4);
  for (const auto& triangle : kTetrahedron) {
    bytes += std::string(12, '\0');
    for (const size_t v : triangle) bytes += vertexBytes(v);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string plyMeshHead(const std::string& format, const std::string& list = "uchar int vertex_indices",
                               const std::string& more = {}) {
  return "ply\nformat " + format + " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + more +
         "element face 4\nproperty list " + list + "\nend_header\n";
}
inline std::string asciiPly(const std::string& list = "uchar int vertex_indices") {
  return plyMeshHead("ascii", list) + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}
inline std::string binaryPly(bool big) {
  std::string bytes = plyMeshHead(big ? "binary_big_endian" : "binary_little_endian");
  for (size_t v = 0; v < 4; ++v) bytes += vertexBytes(v, big);
  for (const auto& triangle : kTetrahedron) {
    bytes += '\3';
    for (const int32_t v : triangle) bytes += numberBytes(v, big);
  }
  return bytes;
}

/// A glTF document, of which tests replace parts. Accessor k views buffer view k.
struct GltfFile {
  enum Part { Positions, Bytes, Shorts, Words, Corners, Strided, Normals, Strip, Fan, Base, PartCount };

  std::string primitives = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string nodes = R"({"mesh":0})";
  std::string more;       ///< members of the document
  std::string accessors;  ///< after those of the parts
  std::string views;      ///< likewise
  std::string uri;        ///< of the buffer; empty: its data, or the file's own

  std::string gltf() const { return json(uri.empty() ? "data:application/octet-stream;base64," + base64(buffer()) : uri); }
  std::string glb() const {
    std::string text = json(uri), data = buffer();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4, '\0');
    const auto length = static_cast<uint32_t>(12 + 8 + text.size() + 8 + data.size());
    return "glTF" + numberBytes<uint32_t>(2) + numberBytes(length) + numberBytes(static_cast<uint32_t>(text.size())) + "JSON" + text +
           numberBytes(static_cast<uint32_t>(data.size())) + std::string("BIN\0", 4) + data;
  }

  static std::string buffer() {
    std::string out;
    for (const PartData& part : parts()) out += part.bytes;
    return out;
  }
  static std::string base64(const std::string& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
      uint32_t three = 0;
      for (size_t k = 0; k < 3; ++k) three = three << 8U | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0U);
      for (size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63U];
    }
    return out;
  }

 private:
  struct PartData {
    std::string bytes, accessor, stride;
  };

  static std::vector<PartData> parts() {
    std::vector<PartData> out(PartCount);
    for (size_t v = 0; v < 4; ++v) {
      out[Positions].bytes += vertexBytes(v);
      out[Strided].bytes += vertexBytes(v) + "pad!";
      out[Normals].bytes += numberBytes(1.0F) + numberBytes(2.0F) + numberBytes(2.0F);
    }
    for (const auto& triangle : kTetrahedron) {
      for (const uint8_t v : triangle) {
        out[Bytes].bytes += numberBytes(v);
        out[Shorts].bytes += numberBytes<uint16_t>(v);
        out[Words].bytes += numberBytes<uint32_t>(v);
        out[Corners].bytes += vertexBytes(v);
      }
    }
    for (const uint32_t v : {0, 2, 1, 3, 0, 2}) out[Strip].bytes += numberBytes(v);
    for (const uint32_t v : {3, 0, 1, 2, 0}) out[Fan].bytes += numberBytes(v);
    for (const uint32_t v : {0, 2, 1}) out[Base].bytes += numberBytes(v);
    const auto accessor = [&](Part part, int count, int component, const char* type) {
      out[part].accessor =
          R"("count":)" + std::to_string(count) + R"(,"componentType":)" + std::to_string(component) + R"(,"type":")" + type + '"';
    };
    for (const Part part : {Positions, Strided, Normals}) accessor(part, 4, 5126, "VEC3");
    accessor(Corners, 12, 5126, "VEC3");
    accessor(Bytes, 12, 5121, "SCALAR");
    accessor(Shorts, 12, 5123, "SCALAR");
    accessor(Words, 12, 5125, "SCALAR");
    accessor(Strip, 6, 5125, "SCALAR");
    accessor(Fan, 5, 5125, "SCALAR");
    accessor(Base, 3, 5125, "SCALAR");
    out[Strided].stride = R"(,"byteStride":16)";
    return out;
  }

  std::string json(const std::string& from) const {
    std::string allAccessors, allViews;
    size_t at = 0, index = 0;
    for (const auto& [bytes, accessor, stride] : parts()) {
      const auto add = [&](std::string& list, std::initializer_list<std::string_view> pieces) {
        if (index > 0) list += ',';
        for (const std::string_view piece : pieces) list += piece;
      };
      add(allAccessors, {R"({"bufferView":)", std::to_string(index), ",", accessor, "}"});
      add(allViews, {R"({"buffer":0,"byteOffset":)", std::to_string(at), R"(,"byteLength":)", std::to_string(bytes.size()), stride, "}"});
      ++index;
      at += bytes.size();
    }
    return R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[)" + primitives + R"(]}],"nodes":[)" + nodes + R"(],"accessors":[)" +
           allAccessors + accessors + R"(],"bufferViews":[)" + allViews + views + R"(],"buffers":[{"byteLength":)" + std::to_string(at) +
           (from.empty() ? "" : R"(,"uri":")" + from + '"') + "}]" + more + "}";
  }
};

}  // namespace rill::test
