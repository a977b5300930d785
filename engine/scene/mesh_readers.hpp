#pragma once
// The readers behind readMesh(), one per format. They may throw what their libraries throw; readMesh() does not.
#include <filesystem>
#include <string>
#include <string_view>

#include "rill/expected.hpp"
#include "rill/mesh.hpp"

namespace rill {

/// Largest size of a mesh file, and of all its buffers together, in bytes.
inline constexpr uint64_t kMaxMeshBytes = uint64_t{1} << 32;

/// `what`: "found X, expected Y".
inline Error meshError(const std::filesystem::path& file, const std::string& where, const std::string& what) {
  return {ErrorKind::BadInput, file.string() + ": " + where + ": " + what};
}

/// The content of a mesh file in memory. `file`: its name in messages, and what names of other files are relative to.
Expected<MeshData> readObj(std::string_view bytes, const std::filesystem::path& file);
Expected<MeshData> readStl(std::string_view bytes, const std::filesystem::path& file);
Expected<MeshData> readGltf(std::string_view bytes, const std::filesystem::path& file, bool binary);
Expected<MeshData> readPlyMesh(const std::filesystem::path& file);

/// Calls a reader. What it throws becomes an error.
template <class Reader>
Expected<MeshData> guarded(const std::filesystem::path& file, const Reader& reader) {
  try {
    return reader();
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::OutOfMemory, file.string() + ": not enough memory to read the mesh"};
  } catch (const std::exception& thrown) {
    return Error{ErrorKind::BadInput, file.string() + ": invalid content (" + thrown.what() + "), expected a mesh"};
  }
}

}  // namespace rill
