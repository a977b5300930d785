#pragma once
// Mesh files in a folder of their own, read back.
#include <gtest/gtest.h>

#include <string>

#include "scene/mesh_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/tetrahedron_files.hpp"

namespace rill::test {
namespace mesh_file_test {

class MeshFile : public ::testing::Test {
 protected:
  MeshData mesh(const std::string& name, const std::string& bytes) {
    auto read = readMesh(folder.write(name, bytes));
    EXPECT_TRUE(read) << name << ": " << (read ? "" : read.error().message);
    return read ? *read : MeshData{};
  }
  MeshData gltf(const GltfFile& file) { return mesh("m.gltf", file.gltf()); }

  /// The message after the name of the file, or "accepted".
  std::string errorOf(const std::string& name) {
    const auto read = readMesh(folder / name);
    if (read) return "accepted";
    EXPECT_TRUE(read.error().kind == ErrorKind::BadInput || read.error().kind == ErrorKind::Io) << read.error().message;
    std::string text = read.error().message;
    EXPECT_EQ(text.rfind((folder / name).string(), 0), 0U) << text;
    text.erase(0, (folder / name).string().size());
    for (size_t at = text.find(folder.string()); at != std::string::npos; at = text.find(folder.string()))
      text.replace(at, folder.string().size(), "F");
    return text;
  }
  std::string errorOf(const std::string& name, const std::string& bytes) {
    folder.write(name, bytes);
    return errorOf(name);
  }
  std::string gltfError(const GltfFile& file) { return errorOf("m.gltf", file.gltf()); }

  TemporaryFolder folder;
};

}  // namespace mesh_file_test
}  // namespace rill::test
