// Mesh files that are refused: every fault has its message.
#include <sys/stat.h>
#include <unistd.h>

#include <limits>

#include "scene/mesh_file_fixture.hpp"

namespace rill::test {
namespace mesh_file_test {

TEST_F(MeshFile, RejectsWhatIsNoMeshFile) {
  EXPECT_EQ(errorOf("m.fbx"), ": found the extension \".fbx\", expected .obj, .stl, .ply, .gltf or .glb");
  EXPECT_EQ(errorOf("mesh"), ": found the extension \"\", expected .obj, .stl, .ply, .gltf or .glb");
  for (const std::string extension : {".obj", ".stl", ".gltf", ".glb"}) {
    EXPECT_EQ(errorOf("none" + extension), ": no such file");
    EXPECT_EQ(errorOf("m" + extension, ""), ": found an empty file, expected a mesh");
    std::filesystem::create_directory(folder / ("folder" + extension));
    EXPECT_EQ(errorOf("folder" + extension), ": found a directory, expected a regular file");
    ASSERT_EQ(::mkfifo((folder / ("pipe" + extension)).c_str(), 0600), 0);
    EXPECT_EQ(errorOf("pipe" + extension), ": found a pipe, expected a regular file");
    folder.write("large" + extension, "");
    std::filesystem::resize_file(folder / ("large" + extension), (uint64_t{1} << 32) + 1);  // without blocks on the disk
    EXPECT_EQ(errorOf("large" + extension), ": 4,294,967,297 bytes; expected at most 4,294,967,296");
  }
  std::filesystem::create_directory(folder / "folder.ply");
  EXPECT_EQ(errorOf("folder.ply"), ": not a regular file; expected a PLY file");
  folder.write("large.ply", asciiPly());
  std::filesystem::resize_file(folder / "large.ply", (uint64_t{1} << 32) + 1);
  EXPECT_EQ(errorOf("large.ply"), ": 4,294,967,297 bytes; expected at most 4,294,967,296");
  if (::geteuid() != 0) {  // root reads every file
    folder.write("locked.obj", tetrahedronObj());
    std::filesystem::permissions(folder / "locked.obj", std::filesystem::perms::none);
    EXPECT_EQ(errorOf("locked.obj"), ": cannot be opened: Permission denied");
  }
}

TEST_F(MeshFile, RejectsInvalidObj) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", finite = ", expected a finite number that a 32-bit float can hold";
  const std::vector<std::array<std::string, 2>> rows{
      {"v 0 0\n", ": line 1: found the end of the line" + finite},
      {"\n\r\nv 0 nan 0\n", ": line 3: found \"nan\"" + finite},
      {"v 0 0 1e39\n", ": line 1: found \"1e39\"" + finite},
      {"v 0 0 1,5\n", ": line 1: found \"1,5\"" + finite},
      {v + "vn 0 inf 0\n", ": line 4: found \"inf\"" + finite},
      {v + "f 1 2 4\n", ": line 4: found the corner \"4\", expected indices of the 3 lines \"v\" before it, from 1"},
      {v + "f 1 2 0\n", ": line 4: found the corner \"0\", expected indices of the 3 lines \"v\" before it, from 1"},
      {v + "f 1 2 -4\n", ": line 4: found the corner \"-4\", expected indices of the 3 lines \"v\" before it, from 1"},
      {v + "f 1 2 99999999999999999999\n",
       ": line 4: found the corner \"99999999999999999999\", expected indices of the 3 lines \"v\" before it, from 1"},
      {v + "f 1//1 2//1 3//1\n", ": line 4: found the corner \"1//1\", expected indices of the 0 lines \"vn\" before it, from 1"},
      {v + "f 1/ 2 3\n", ": line 4: found the corner \"1/\", expected indices of the 0 lines \"vt\" before it, from 1"},
      {v + "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n", ": line 6: found \"1/1/1/1\", expected a corner such as 1, 1/2, 1//3 or 1/2/3"},
      {v + "f 1 2\n", ": line 4: found a face of 2 vertices, expected three or more"},
      {v + "f\n", ": line 4: found a face of 0 vertices, expected three or more"},
      {v + "f 1 2 3" + '\0' + "\n", ": line 4: found a zero byte, expected text"},
      {v, ": found no triangle, expected at least one"},
      {asciiStl(), ": found no triangle, expected at least one"},
  };
  for (const auto& [text, message] : rows) EXPECT_EQ(errorOf("m.obj", text), message) << text;
}

TEST_F(MeshFile, RejectsInvalidStl) {
  const std::string facet = "solid a\nfacet normal 0 0 1\nouter loop\n", bytes = binaryStl();
  std::string infinite = bytes, many = bytes;
  infinite.replace(84 + 50 + 12 + 4, 4, numberBytes(std::numeric_limits<float>::infinity()));
  many.replace(80, 4, numberBytes(0xFFFFFFFFU));
  const std::vector<std::array<std::string, 2>> rows{
      {"solid", ": line 1: found the end of the file, expected facet or endsolid"},
      {"solid\nendsolid", ": found no triangle, expected at least one"},
      {"text", ": header: found 4 bytes, expected \"solid\" or a binary STL file of at least 84"},
      {bytes.substr(0, bytes.size() - 1), ": header: declares 4 triangles, found 283 bytes, expected 284"},
      {many, ": header: declares 4,294,967,295 triangles, found 284 bytes, expected 214,748,364,834"},
      {infinite, ": triangle 1: the position is inf along y, expected a finite number that a 32-bit float can hold"},
      {"solid a\nvertex 0 0 0\n", ": line 2: found \"vertex\", expected facet or endsolid"},
      {facet + "vertex 0 0\n", ": line 4: found the end of the file, expected a number"},
      {facet + "vertex 0 x 0\n", ": line 4: found \"x\", expected a number"},
      {facet + "vertex 0 0 nan\n", ": line 4: the position is nan along z, expected a finite number that a 32-bit float can hold"},
      {facet + "vertex 0 0 0\nendloop\n", ": line 5: found \"endloop\", expected vertex"},
      {asciiStl() + "more", ": line 31: found \"more\", expected solid, or the end of the file"},
  };
  for (const auto& [text, message] : rows) EXPECT_EQ(errorOf("m.stl", text), message) << text;
}

TEST_F(MeshFile, RejectsInvalidPly) {
  const std::string head = plyMeshHead("ascii"), vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", four = "3 0 1 2\n3 0 1 2\n3 0 1 2\n3 0";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::vector<std::array<std::string, 2>> rows{
      {"", ": does not begin with \"ply\"; expected a PLY file"},
      {"ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "end_header\n",
       ": the header has no face element after the vertices; expected one with vertex_indices"},
      {"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n" + xyz + "end_header\n",
       ": the header has no face element after the vertices; expected one with vertex_indices"},
      {plyMeshHead("ascii", "uchar int corners"), ": the faces have no list property \"vertex_indices\"; expected one"},
      {head + vertices + four, ": face 3, property \"vertex_indices\": found the end of the file, expected a number"},
      {head + vertices + "3 0 1 4\n" + four, ": face 0: found the vertex index 4, expected a whole number from 0 and below 4"},
      {head + vertices + "3 0 1 -1\n" + four, ": face 0: found the vertex index -1, expected a whole number from 0 and below 4"},
      {head + vertices + "3 0 1 1.5\n" + four, ": face 0: found the vertex index 1.5, expected a whole number from 0 and below 4"},
      {head + vertices + "2 0 1\n" + four, ": face 0: found 2 vertices, expected three or more"},
      {head + vertices + "-3 0 1\n" + four, ": face 0 has a list of negative length"},
      {head + vertices + "4e9 0 1\n" + four, ": face 0 has a list of 4000000000 numbers; expected at most 1048576"},
      {head + "0 0 nan\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n" + four,
       ": vertex 0: the position is nan along z, expected a finite number that a 32-bit float can hold"},
      {"ply\nformat binary_little_endian 1.0\nelement vertex 4\n" + xyz +
           "element face 18446744073709551615\nproperty list uchar int vertex_indices\nend_header\n" + std::string(100, '\0'),
       ": the header declares 18,446,744,073,709,551,615 of \"face\", at least 1 bytes each, but only 52 bytes follow; expected a complete "
       "file"},
  };
  for (const auto& [text, message] : rows) { EXPECT_EQ(errorOf("m.ply", text), message) << text; }
}

TEST_F(MeshFile, RejectsInvalidGltf) {
  struct Row {
    std::string GltfFile::*part;
    std::string text, message;
  };
  const auto position = [](int accessor) { return R"({"attributes":{"POSITION":)" + std::to_string(accessor) + "}}"; };
  const std::string float3 = R"("componentType":5126,"type":"VEC3")";
  const std::vector<Row> rows{
      {&GltfFile::nodes, R"({"mesh":1})", ": nodes[0].mesh: found the index 1, expected one from 0 and below 1"},
      {&GltfFile::nodes, R"({"mesh":0,"matrix":[1,0,0]})",
       ": nodes[0]: found an invalid transform, expected a matrix of 16 numbers, or a translation of 3, a rotation of 4 and a scale of 3"},
      {&GltfFile::nodes, R"({"mesh":0,"rotation":[0,0,0,0]})", ": nodes[0].rotation: found no direction, expected a unit quaternion"},
      {&GltfFile::nodes, R"({"mesh":0,"scale":[1e300,1,1]})",
       ": meshes[0].primitives[0].attributes.POSITION[1]: the position is 1e+300 along x, expected a finite number that a 32-bit float can "
       "hold"},
      {&GltfFile::nodes, R"({"children":[1,1]},{"mesh":0})", ": nodes[1]: found twice in the scene, expected a tree"},
      {&GltfFile::nodes, R"({"children":[7]})", ": nodes: found the index 7, expected one from 0 and below 1"},
      {&GltfFile::nodes, R"({"children":[1]},{"children":[0],"mesh":0})", ": found no triangle, expected at least one"},
      {&GltfFile::more, R"(,"scene":0)", ": scene: found the index 0, expected one from 0 and below 0"},
      {&GltfFile::more, R"(,"scene":0,"scenes":[{"nodes":[0,0]}])", ": nodes[0]: found twice in the scene, expected a tree"},
      {&GltfFile::more, R"(,"extensionsRequired":["KHR_draco_mesh_compression"])",
       ": extensionsRequired: found \"KHR_draco_mesh_compression\", expected none that changes shapes"},
      {&GltfFile::primitives, R"({"attributes":{"NORMAL":0}})",
       ": meshes[0].primitives[0].attributes.POSITION: missing, expected an accessor"},
      {&GltfFile::primitives, R"({"attributes":{"POSITION":0},"mode":7})", ": meshes[0].primitives[0].mode: found 7, expected 0 to 6"},
      {&GltfFile::primitives, R"({"attributes":{"POSITION":0}})", ": meshes[0].primitives[0]: found 4 corners, expected three a triangle"},
      {&GltfFile::primitives, R"({"attributes":{"POSITION":0,"NORMAL":4},"indices":1})",
       ": meshes[0].primitives[0].attributes.NORMAL: found 12 normals, expected 4"},
      {&GltfFile::primitives, R"({"attributes":{"POSITION":0},"indices":1,"material":2})",
       ": meshes[0].primitives[0].material: found the index 2, expected one from 0 and below 0"},
      {&GltfFile::primitives, R"({"attributes":{"POSITION":0},"indices":0})",
       ": accessors[0]: found the component type 5126 or another type, expected SCALAR of 5121, 5123 or 5125 (unsigned)"},
      {&GltfFile::primitives, position(1), ": accessors[1]: found the component type 5121 or another type, expected VEC3 of 5126 (float)"},
      {&GltfFile::primitives, position(99),
       ": meshes[0].primitives[0].attributes.POSITION: found the index 99, expected one from 0 and below 10"},
      {&GltfFile::accessors, ",{" + float3 + R"(,"count":3})",
       ": accessors[10].bufferView: found the index -1, expected one from 0 and below 10"},
      {&GltfFile::accessors, ",{" + float3 + R"(,"count":3,"bufferView":50})",
       ": accessors[10].bufferView: found the index 50, expected one from 0 and below 10"},
      {&GltfFile::accessors,
       ",{" + float3 +
           R"(,"count":3,"bufferView":0,"sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}})",
       ": accessors[10]: found a sparse accessor, expected one with a buffer view alone"},
      {&GltfFile::accessors, ",{" + float3 + R"(,"count":5,"bufferView":0})",
       ": accessors[10]: found 5 elements from byte 0, expected them within the 48 bytes of bufferViews[0]"},
      {&GltfFile::accessors, ",{" + float3 + R"(,"count":18446744073709551615,"bufferView":0})",
       ": accessors[10]: found 18,446,744,073,709,551,615 elements from byte 0, expected them within the 48 bytes of bufferViews[0]"},
      {&GltfFile::accessors, ",{" + float3 + R"(,"count":1,"byteOffset":18446744073709551600,"bufferView":0})",
       ": accessors[10]: found 1 elements from byte 18,446,744,073,709,551,600, expected them within the 48 bytes of bufferViews[0]"},
      {&GltfFile::views, R"(,{"buffer":0,"byteOffset":400,"byteLength":200})",
       ": bufferViews[10]: found 200 bytes from 400, expected them within the 444 of the buffer"},
      {&GltfFile::views, R"(,{"buffer":0,"byteOffset":8,"byteLength":18446744073709551615})",
       ": bufferViews[10]: found 18,446,744,073,709,551,615 bytes from 8, expected them within the 444 of the buffer"},
      {&GltfFile::views, R"(,{"buffer":3,"byteLength":20})",
       ": bufferViews[10].buffer: found the index 3, expected one from 0 and below 1"},
      {&GltfFile::views, R"(,{"buffer":0,"byteLength":48,"byteStride":8})", ": bufferViews[10].byteStride: found 8, expected at least 12"},
      {&GltfFile::uri, "none.bin", ": buffers[0].uri: F/none.bin: no such file"},
      {&GltfFile::uri, "short.bin", ": buffers[0].uri: found 5 bytes, expected 444"},
      {&GltfFile::uri, "sub", ": buffers[0].uri: F/sub: found a directory, expected a regular file"},
      {&GltfFile::uri, "/etc/passwd",
       ": buffers[0].uri: found the path \"/etc/passwd\", expected a relative one without \"..\" or backslashes"},
      {&GltfFile::uri, "sub/%2e%2e/m.bin",
       ": buffers[0].uri: found the path \"sub/../m.bin\", expected a relative one without \"..\" or backslashes"},
      {&GltfFile::uri, "data:model/x;base64,AAAA",
       ": buffers[0].uri: found \"data:model/x;base64,AAAA\", expected data:application/octet-stream;base64,..."},
  };
  folder.write("short.bin", "short");
  std::filesystem::create_directory(folder / "sub");
  for (const auto& [part, text, message] : rows) {
    GltfFile file;
    file.*part = text;
    if (part == &GltfFile::accessors || part == &GltfFile::views) file.primitives = position(10);
    if (part == &GltfFile::views) file.accessors = ",{" + float3 + R"(,"count":3,"bufferView":10})";
    EXPECT_EQ(gltfError(file), message) << text;
  }
}

TEST_F(MeshFile, RejectsInvalidDocuments) {
  const std::string deep = R"({"asset":{"version":"2.0","extras":)" + std::string(100'000, '[') + std::string(100'000, ']') + "}}";
  const std::string start = R"({"asset":{"version":"2.0"},"buffers":[)", glb = GltfFile{}.glb();
  const std::vector<std::array<std::string, 2>> rows{
      {"{}", ": asset.version: found null, expected \"2.0\""},
      {R"({"asset":{"version":"1.0"}})", ": asset.version: found the string \"1.0\", expected \"2.0\""},
      {"[]", ": JSON: found no object, expected a glTF document"},
      {deep, ":1:290: nested deeper than 256 levels"},
      {R"({"asset":{"version":"2.0"}})", ": found no triangle, expected at least one"},
      {start + R"({"byteLength":0}]})", ": buffers[0].byteLength: missing or invalid, expected a whole number from 1"},
      {start + R"({"byteLength":12}]})", ": buffers[0].uri: missing, expected the buffer's file or data"},
      {start + R"({"byteLength":4294967297,"uri":"a"}]})",
       ": buffers[0]: found more than 4,294,967,296 bytes of buffers, expected at most that"},
      {start + R"({"byteLength":12,"uri":"data:application/octet-stream;base64,AAAA"}]})",
       ": glTF: Failed to decode 'uri' : data:application/octet-stream;base64,AAAA in Buffer, expected a valid document"},
  };
  for (const auto& [text, message] : rows) EXPECT_EQ(errorOf("m.gltf", text), message) << text.substr(0, 200);
  EXPECT_EQ(errorOf("m.glb", GltfFile{}.gltf()), ": header: does not begin with \"glTF\", expected a binary glTF file");
  EXPECT_EQ(errorOf("m.glb", glb.substr(0, 15)), ": header: found 15 bytes, expected 20 or more");
  EXPECT_EQ(errorOf("m.glb", "glTF" + numberBytes<uint32_t>(1) + glb.substr(8)), ": header: found the version 1, expected 2");
  EXPECT_EQ(errorOf("m.gltf", glb), ": header: found a binary glTF file, expected JSON; such files end in .glb");
}

TEST_F(MeshFile, RejectsTruncatedFiles) {
  const std::vector<std::array<std::string, 2>> rows{{"m.stl", binaryStl()},
                                                     {"m.stl", asciiStl().substr(0, asciiStl().find("endsolid") + 8)},
                                                     {"m.ply", binaryPly(false)},
                                                     {"m.gltf", GltfFile{}.gltf()},
                                                     {"m.glb", GltfFile{}.glb()}};
  for (const auto& [name, bytes] : rows) {
    EXPECT_FALSE(mesh(name, bytes).triangles.empty());
    for (size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 100)
      EXPECT_NE(errorOf(name, bytes.substr(0, length)), "accepted") << name << " of " << length;
  }
}

}  // namespace mesh_file_test
}  // namespace rill::test
