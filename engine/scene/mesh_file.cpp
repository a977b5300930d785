#include "scene/mesh_file.hpp"

#include <algorithm>
#include <string>

#include "core/words.hpp"
#include "scene/json_text.hpp"
#include "scene/mesh_readers.hpp"

namespace rill {
namespace {

std::string lowerCaseExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return extension;
}

Expected<MeshData> readByExtension(const std::filesystem::path& file) {
  const std::string extension = lowerCaseExtension(file);
  const bool text = extension == ".obj", stl = extension == ".stl", gltf = extension == ".gltf", glb = extension == ".glb";
  if (extension == ".ply") return readPlyMesh(file);
  if (!text && !stl && !gltf && !glb) {
    return Error{ErrorKind::BadInput,
                 file.string() + ": found the extension " + inQuotes(extension) + ", expected .obj, .stl, .ply, .gltf or .glb"};
  }
  const auto bytes = readWholeFile(file, kMaxMeshBytes);
  if (!bytes) return bytes.error();
  if (bytes->empty()) return Error{ErrorKind::BadInput, file.string() + ": found an empty file, expected a mesh"};
  return text ? readObj(*bytes, file) : stl ? readStl(*bytes, file) : readGltf(*bytes, file, glb);
}

}  // namespace

Expected<MeshData> readMesh(const std::filesystem::path& file) {
  return guarded(file, [&] { return readByExtension(file); });
}

}  // namespace rill
