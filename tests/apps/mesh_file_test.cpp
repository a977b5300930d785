// Mesh files, read back by Rill's own readers and, of VTK's, by their structure.
#include "shared/mesh_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "rill/mesh.hpp"
#include "rill/scene_io.hpp"
#include "shared/vtk_file.hpp"
#include "support/temporary_folder.hpp"

namespace rill::apps {
namespace {

using test::TemporaryFolder;

/// A tetrahedron, with numbers that have no short decimal form.
offline::SurfaceTriangles tetrahedron() {
  offline::SurfaceTriangles mesh;
  mesh.positions = {{0, 0, 0}, {1.0f / 3, 0, 0}, {0, 0.7f, 0}, {0, 0, 1e-3f}};
  mesh.normals = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  mesh.velocities = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {-1, -2, -3.5f}};
  mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return mesh;
}

std::string textOf(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::string encoded(const offline::SurfaceTriangles& mesh, MeshFormat format) {
  const auto bytes = encodeMesh(mesh, 0.25, format);
  EXPECT_TRUE(bytes) << bytes.error().message;
  return textOf(*bytes);
}

TEST(MeshFile, ReadsBackAsTheMeshOfASolid) {
  const TemporaryFolder folder;
  for (const MeshFormat format : {MeshFormat::Ply, MeshFormat::Obj, MeshFormat::Glb}) {
    const std::string name = std::string("fluid.") + meshExtension(format);
    SCOPED_TRACE(name);
    std::ofstream(folder.path() / name, std::ios::binary) << encoded(tetrahedron(), format);
    std::ofstream(folder.path() / "scene.json") << R"({"rill": "0.2", "domain": {"min": [-1, -1, -1], "max": [1, 1, 1]},
      "fluid": {"spacing": 0.1}, "solids": [{"mesh": {"file": ")" +
                                                       name + "\"}}]}";
    const auto scene = loadScene(folder.path() / "scene.json");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto* shape = std::get_if<MeshShape>(&scene->solids.at(0).shape);
    ASSERT_NE(shape, nullptr);
    const MeshData& read = shape->mesh->data();
    EXPECT_EQ(read.triangles.size(), 4u);
    ASSERT_EQ(read.vertices.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
      const Float3 expected = tetrahedron().positions[i];
      for (size_t a = 0; a < 3; ++a) EXPECT_EQ(float(read.vertices[i][a]), expected[a]);
    }
    EXPECT_NEAR(shape->mesh->volume(), 1.0 / 3 * 0.7 * 1e-3 / 6, 1e-9);
  }
}

TEST(MeshFile, PlyHasNormalsAndVelocities) {
  const std::string text = encoded(tetrahedron(), MeshFormat::Ply);
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment time 0.25\nelement vertex 4\n"
      "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property float vx\nproperty float vy\nproperty float vz\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  ASSERT_EQ(text.substr(0, header.size()), header);
  ASSERT_EQ(text.size(), header.size() + 4 * 36 + 4 * 13);
  float last[9];
  std::memcpy(last, text.data() + header.size() + 3 * 36, sizeof last);
  EXPECT_EQ(last[4], -1);
  EXPECT_EQ(last[8], -3.5f);
}

TEST(MeshFile, ObjRoundTripsNumbers) {
  const std::string text = encoded(tetrahedron(), MeshFormat::Obj);
  EXPECT_NE(text.find("v 0.33333334 0 0\n"), std::string::npos);
  EXPECT_NE(text.find("vn 0 -1 0\n"), std::string::npos);
  EXPECT_NE(text.find("f 1//1 3//3 2//2\n"), std::string::npos);
}

/// Offsets of appended arrays lead to lengths, and the last one ends where the block does.
void expectArrays(const std::string& file, size_t count) {
  const size_t begin = file.find("encoding=\"raw\">\n_");
  ASSERT_NE(begin, std::string::npos);
  const size_t data = begin + std::strlen("encoding=\"raw\">\n_");
  uint64_t expected = 0;
  size_t found = 0;
  for (size_t at = file.find("offset=\""); at != std::string::npos && at < begin; at = file.find("offset=\"", at + 1)) {
    const uint64_t offset = std::stoull(file.substr(at + 8));
    // In the order of the data; the time, which the XML has first, was added last.
    uint64_t bytes = 0;
    ASSERT_LE(data + offset + sizeof bytes, file.size());
    std::memcpy(&bytes, file.data() + data + offset, sizeof bytes);
    expected += sizeof bytes + bytes;
    ++found;
  }
  EXPECT_EQ(found, count);
  EXPECT_EQ(file.substr(data + expected), "\n</AppendedData>\n</VTKFile>\n");
}

/// The values of an appended array.
template <class T>
std::vector<T> arrayOf(const std::string& file, const std::string& name) {
  const size_t at = file.find("Name=\"" + name + "\""), begin = file.find("encoding=\"raw\">\n_");
  if (at == std::string::npos || begin == std::string::npos) return {};
  const char* data = file.data() + begin + std::strlen("encoding=\"raw\">\n_") +
                     std::stoull(file.substr(file.find("offset=\"", at) + std::strlen("offset=\"")));
  uint64_t bytes = 0;
  std::memcpy(&bytes, data, sizeof bytes);
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), data + sizeof bytes, bytes);
  return values;
}

TEST(MeshFile, VtkFilesHaveTheirArrays) {
  const std::string vtp = encoded(tetrahedron(), MeshFormat::Vtp);
  EXPECT_NE(vtp.find("<Piece NumberOfPoints=\"4\""), std::string::npos);
  EXPECT_NE(vtp.find("NumberOfPolys=\"4\""), std::string::npos);
  expectArrays(vtp, 6);
  offline::Particles particles;
  particles.positions = particles.velocities = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  particles.densities = {1000, 999, 998};
  particles.ids = {2, 0, 1};
  const std::string vtu = textOf(encodeVtu(particles, 0.25));
  EXPECT_NE(vtu.find("<Piece NumberOfPoints=\"3\" NumberOfCells=\"3\">"), std::string::npos);
  expectArrays(vtu, 8);
  EXPECT_EQ(vtu.find("Name=\"fluid\""), std::string::npos);
  particles.fluids = {0, 1, 0};
  const std::string several = textOf(encodeVtu(particles, 0.25));
  EXPECT_NE(several.find("<DataArray type=\"UInt8\" Name=\"fluid\""), std::string::npos);
  expectArrays(several, 9);
  particles.diffusing = {1};
  particles.concentrations = {{0.25F, 1, 0}};
  const std::string mixed = textOf(encodeVtu(particles, 0.25));
  EXPECT_NE(mixed.find("<DataArray type=\"Float32\" Name=\"concentration1\""), std::string::npos);
  expectArrays(mixed, 10);
  const offline::DiffuseParticles white{.positions = {{0, 1, 2}, {3, 4, 5}},
                                        .velocities = {{0, 0, 1}, {0, 0, 2}},
                                        .ages = {0.5F, 1},
                                        .classes = {WhitewaterClass::Spray, WhitewaterClass::Bubble},
                                        .randoms = {7, (1 << 24) - 1}};
  const std::string foam = textOf(encodeWhitewaterVtu(white, 0.25));
  EXPECT_NE(foam.find("<DataArray type=\"UInt8\" Name=\"class\""), std::string::npos);
  EXPECT_EQ(arrayOf<uint32_t>(foam, "random"), white.randoms);
  expectArrays(foam, 9);
  const std::pair<double, std::string> files[] = {{0, "frame_00000.vtu"}, {0.5, "frame_00001.vtu"}};
  EXPECT_NE(encodePvd(files).find("<DataSet timestep=\"0.5\" part=\"0\" file=\"frame_00001.vtu\"/>"), std::string::npos);
}

TEST(MeshFile, EncodesEmptyMeshes) {
  EXPECT_TRUE(encoded({}, MeshFormat::Ply).ends_with("end_header\n"));
  EXPECT_EQ(encoded({}, MeshFormat::Glb).find("\"mesh\""), std::string::npos);
  EXPECT_NE(encoded({}, MeshFormat::Vtp).find("NumberOfPoints=\"0\""), std::string::npos);
  EXPECT_FALSE(encoded({}, MeshFormat::Obj).empty());
}

TEST(MeshFile, KnowsItsFormats) {
  for (const char* name : {"ply", "obj", "glb", "vtp"}) {
    const auto format = meshFormat(name);
    ASSERT_TRUE(format);
    EXPECT_EQ(meshExtension(*format), std::string("mesh.") + name);
  }
  EXPECT_FALSE(meshFormat("stl"));
}

}  // namespace
}  // namespace rill::apps
