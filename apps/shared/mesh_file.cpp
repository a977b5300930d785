#include "shared/mesh_file.hpp"

#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <limits>

#include "core/words.hpp"
#include "shared/file_bytes.hpp"
#include "shared/vtk_file.hpp"

namespace rill::apps {
namespace {

constexpr std::array<std::string_view, 4> kNames = {"ply", "obj", "glb", "vtp"};

std::vector<std::byte> ply(const offline::SurfaceTriangles& mesh, double time_s) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment time " + shortestNumber(time_s) + "\nelement vertex " +
                       std::to_string(mesh.positions.size()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz"}) header += std::string("property float ") + name + "\n";
  header += "element face " + std::to_string(mesh.indices.size() / 3) + "\nproperty list uchar int vertex_indices\nend_header\n";
  FileBytes file;
  file.reserve(header.size() + mesh.positions.size() * 36 + mesh.indices.size() / 3 * 13);
  file.text(header);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    file.value(mesh.positions[i]);
    file.value(mesh.normals[i]);
    file.value(mesh.velocities[i]);
  }
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    file.value(uint8_t{3});
    for (size_t k = 0; k < 3; ++k) file.value(mesh.indices[i + k]);
  }
  return file.take();
}

void addNumber(std::string& text, auto number) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  assert(error == std::errc{});
  text.append(digits.data(), end);
}

std::vector<std::byte> obj(const offline::SurfaceTriangles& mesh, double time_s) {
  std::string text = "# rill mesh, time " + shortestNumber(time_s) + " s\n";
  const auto addVectors = [&](const char* tag, const std::vector<Float3>& vectors) {
    for (const Float3& v : vectors) {
      text += tag;
      for (const float x : v) {
        text += ' ';
        addNumber(text, x);
      }
      text += '\n';
    }
  };
  addVectors("v", mesh.positions);
  addVectors("vn", mesh.normals);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    text += 'f';
    for (size_t k = 0; k < 3; ++k) {
      text += ' ';
      addNumber(text, uint64_t{mesh.indices[i + k]} + 1);
      text += "//";
      addNumber(text, uint64_t{mesh.indices[i + k]} + 1);
    }
    text += '\n';
  }
  FileBytes file;
  file.text(text);
  return file.take();
}

/// glTF: a JSON chunk that describes the binary one. A mesh without triangles, which glTF does not allow, is a scene without a node.
std::vector<std::byte> glb(const offline::SurfaceTriangles& mesh, double time_s) {
  const size_t vectorBytes = mesh.positions.size() * sizeof(Float3), indexBytes = mesh.indices.size() * sizeof(uint32_t);
  std::string json = R"({"asset":{"version":"2.0","generator":"Rill"},"scene":0,"extras":{"time_s":)" + shortestNumber(time_s) + "},";
  if (mesh.indices.empty()) {
    json += R"("scenes":[{}]})";
  } else {
    Float3 low = mesh.positions[0], high = low;
    for (const Float3& p : mesh.positions)
      for (size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], p[a]);
        high[a] = std::max(high[a], p[a]);
      }
    const auto corner = [](const Float3& v) {
      std::string text;
      for (const float x : v) {
        text += text.empty() ? "[" : ",";
        addNumber(text, x);
      }
      return text + "]";
    };
    const std::string count = std::to_string(mesh.positions.size()), bytes = std::to_string(vectorBytes);
    json += R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"fluid"}],"meshes":[{"name":"fluid","primitives":[{"attributes":)"
            R"({"POSITION":0,"NORMAL":1,"_VELOCITY":2},"indices":3}]}],"accessors":[)"
            R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
            count + R"(,"min":)" + corner(low) + R"(,"max":)" + corner(high) + "},";
    for (const char* view : {"1", "2"})
      json += std::string(R"({"bufferView":)") + view + R"(,"componentType":5126,"type":"VEC3","count":)" + count + "},";
    json +=
        R"({"bufferView":3,"componentType":5125,"type":"SCALAR","count":)" + std::to_string(mesh.indices.size()) + R"(}],"bufferViews":[)";
    for (size_t k = 0; k < 3; ++k)
      json += R"({"buffer":0,"byteOffset":)" + std::to_string(k * vectorBytes) + R"(,"byteLength":)" + bytes + R"(,"target":34962},)";
    json += R"({"buffer":0,"byteOffset":)" + std::to_string(3 * vectorBytes) + R"(,"byteLength":)" + std::to_string(indexBytes) +
            R"(,"target":34963}],"buffers":[{"byteLength":)" + std::to_string(3 * vectorBytes + indexBytes) + "}]}";
  }
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const size_t binary = 3 * vectorBytes + indexBytes, all = 20 + json.size() + (mesh.indices.empty() ? 0 : 8 + binary);
  FileBytes file;
  file.reserve(all);
  for (const uint32_t word : {0x46546C67u, 2u, static_cast<uint32_t>(all), static_cast<uint32_t>(json.size()), 0x4E4F534Au})
    file.value(word);
  file.text(json);
  if (mesh.indices.empty()) return file.take();
  file.value(static_cast<uint32_t>(binary));
  file.value(0x004E4942u);
  for (const std::vector<Float3>* vectors : {&mesh.positions, &mesh.normals, &mesh.velocities}) file.values(*vectors);
  file.values(mesh.indices);
  return file.take();
}

}  // namespace

std::optional<MeshFormat> meshFormat(std::string_view name) {
  for (size_t k = 0; k < kNames.size(); ++k)
    if (name == kNames[k]) return static_cast<MeshFormat>(k);
  return std::nullopt;
}

const char* meshExtension(MeshFormat format) {
  constexpr std::array<const char*, 4> extensions = {"mesh.ply", "mesh.obj", "mesh.glb", "mesh.vtp"};
  return extensions[static_cast<size_t>(format)];
}

Expected<std::vector<std::byte>> encodeMesh(const offline::SurfaceTriangles& mesh, double time_s, MeshFormat format) {
  assert(mesh.normals.size() == mesh.positions.size() && mesh.velocities.size() == mesh.positions.size());
  const uint64_t bytes = uint64_t{mesh.positions.size()} * 36 + uint64_t{mesh.indices.size()} * 4 + 4096;
  if (format == MeshFormat::Glb && bytes > std::numeric_limits<uint32_t>::max())
    return Error{ErrorKind::TooLarge,
                 "a .glb file holds less than 4 GiB; found a mesh of " + grouped(bytes) + " bytes, expected another format"};
  if (format == MeshFormat::Ply && mesh.positions.size() > size_t(std::numeric_limits<int32_t>::max()))
    return Error{ErrorKind::TooLarge, "a .ply file holds less than 2^31 vertices; found " + grouped(mesh.positions.size())};
  switch (format) {
    case MeshFormat::Obj:
      return obj(mesh, time_s);
    case MeshFormat::Glb:
      return glb(mesh, time_s);
    case MeshFormat::Vtp:
      return encodeVtp(mesh, time_s);
    case MeshFormat::Ply:
      break;
  }
  return ply(mesh, time_s);
}

}  // namespace rill::apps
