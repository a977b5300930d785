// Meshes from files: every format yields the same triangles.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/mesh_file_fixture.hpp"

namespace rill::test {
namespace mesh_file_test {

using Corners = std::array<std::array<double, 3>, 3>;

/// Triangles by their coordinates, in an order of their own, the smallest corner first.
std::vector<Corners> sorted(std::vector<Corners> triangles) {
  for (Corners& t : triangles) {
    for (auto& corner : t) {
      for (double& v : corner) v = std::round(v * 1e6) / 1e6 + 0.0;
    }
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::vector<Corners> trianglesOf(const MeshData& mesh) {
  std::vector<Corners> out;
  for (const auto& triangle : mesh.triangles) {
    Corners corners;
    for (size_t c = 0; c < 3; ++c) {
      const Double3& v = mesh.vertices.at(triangle[c]);
      corners[c] = {v.x, v.y, v.z};
    }
    out.push_back(corners);
  }
  return sorted(out);
}

template <class Map>
std::vector<Corners> tetrahedron(const Map& map, bool turned = false) {
  std::vector<Corners> out;
  for (const auto& triangle : kTetrahedron) {
    Corners corners;
    for (size_t c = 0; c < 3; ++c) {
      const auto& v = kTetrahedronVertices[triangle[c]];
      corners[c] = map(std::array<double, 3>{v[0], v[1], v[2]});
    }
    if (turned) std::swap(corners[1], corners[2]);
    out.push_back(corners);
  }
  return sorted(out);
}
std::vector<Corners> tetrahedron() {
  return tetrahedron([](const auto& v) { return v; });
}

/// Six times the enclosed volume.
double sixVolumes(const MeshData& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : trianglesOf(mesh)) {
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

double area(const MeshData& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : trianglesOf(mesh)) {
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    sum += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return sum;
}

std::string withCrLf(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

TEST_F(MeshFile, FormatsYieldTheSameTriangles) {
  GltfFile external;
  external.uri = "m%20m.bin";
  folder.write("m m.bin", GltfFile::buffer() + "bytes that the buffer leaves out");
  const std::string obj = tetrahedronObj();
  const std::vector<std::array<std::string, 3>> rows{
      {"OBJ", "m.obj", obj},
      {"CR LF, extension in capitals", "m.OBJ", withCrLf(obj)},
      {"comments, weights, colors", "m.obj",
       "# c\n\nv 0 0 0 1\nv 1 0 0 1 0 0\nv\t0 1 0\n  v 0 0 1\ns off\nvp 1\nl 1 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4"},
      {"negative indices", "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -1 -2\nv 0 0 1\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n"},
      {"objects and groups", "m.obj",
       "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\ng b c\nf 1 2 4\no d\nusemtl none\nf 1 4 3\ng\nf 2 3 4\n"},
      {"texture coordinates", "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nf 1/1 3/1 2/1\nf 1 2 4\nf 1/-1 4/1 3/1\nf 2 3 4\n"},
      {"binary STL", "m.stl", binaryStl()},
      {"binary STL whose header begins with solid", "m.stl", binaryStl("solid")},
      {"binary STL with bytes at the end", "m.stl", binaryStl() + "more"},
      {"ASCII STL", "m.stl", asciiStl()},
      {"ASCII STL with CR LF", "m.stl", withCrLf(asciiStl())},
      {"two solids, one without a name", "m.stl", "solid\nendsolid\n" + asciiStl()},
      {"ASCII PLY", "m.ply", asciiPly()},
      {"ASCII PLY with CR LF", "m.ply", withCrLf(asciiPly())},
      {"vertex_index", "m.ply", asciiPly("ushort uchar vertex_index")},
      {"little-endian PLY", "m.ply", binaryPly(false)},
      {"big-endian PLY", "m.ply", binaryPly(true)},
      {"glTF", "m.gltf", GltfFile{}.gltf()},
      {"glTF with a file", "m.gltf", external.gltf()},
      {"GLB", "m.GLB", GltfFile{}.glb()},
      {"GLB with a file", "m.glb", external.glb()},
  };
  for (const auto& [what, name, bytes] : rows) {
    const MeshData read = mesh(name, bytes);
    EXPECT_EQ(trianglesOf(read), tetrahedron()) << what;
    EXPECT_TRUE(read.normals.empty() && read.colors.empty()) << what;
  }
}

TEST_F(MeshFile, ReadsPrimitivesOfGltf) {
  const std::vector<std::array<std::string, 2>> rows{
      {"bytes", R"({"attributes":{"POSITION":0},"indices":1})"},
      {"shorts", R"({"attributes":{"POSITION":0},"indices":2})"},
      {"words", R"({"attributes":{"POSITION":0},"indices":3})"},
      {"not indexed", R"({"attributes":{"POSITION":4}})"},
      {"strided", R"({"attributes":{"POSITION":5},"indices":1})"},
      {"strip", R"({"attributes":{"POSITION":0},"indices":7,"mode":5})"},
      {"fan and triangle", R"({"attributes":{"POSITION":0},"indices":8,"mode":6},{"attributes":{"POSITION":0},"indices":9})"},
      {"with lines and points",
       R"({"attributes":{"POSITION":0},"mode":1},{"attributes":{"POSITION":0},"indices":1},{"attributes":{},"mode":0})"},
  };
  for (const auto& [what, primitives] : rows) {
    GltfFile file;
    file.primitives = primitives;
    EXPECT_EQ(trianglesOf(gltf(file)), tetrahedron()) << what;
  }
}

TEST_F(MeshFile, AppliesTransformsOfNodes) {
  using Point = std::array<double, 3>;
  struct Row {
    std::string nodes, more;
    Point (*map)(const Point&);
    bool mirrored = false;
  };
  const std::vector<Row> rows{
      {R"({"mesh":0,"translation":[1,2,3]})", "",
       [](const Point& p) {
         return Point{p[0] + 1, p[1] + 2, p[2] + 3};
       }},
      {R"({"mesh":0,"rotation":[0,0,0.70710678,0.70710678]})", "",
       [](const Point& p) {
         return Point{-p[1], p[0], p[2]};
       }},
      {R"({"mesh":0,"scale":[2,3,4]})", "",
       [](const Point& p) {
         return Point{2 * p[0], 3 * p[1], 4 * p[2]};
       }},
      {R"({"mesh":0,"scale":[-1,1,1]})", "",
       [](const Point& p) {
         return Point{-p[0], p[1], p[2]};
       },
       true},
      {R"({"mesh":0,"matrix":[0,1,0,0, 1,0,0,0, 0,0,1,0, 5,6,7,1]})", "",
       [](const Point& p) {
         return Point{p[1] + 5, p[0] + 6, p[2] + 7};
       },
       true},
      {R"({"children":[1],"translation":[1,0,0]},{"mesh":0,"scale":[2,2,2],"translation":[0,1,0]})", "",
       [](const Point& p) {
         return Point{2 * p[0] + 1, 2 * p[1] + 1, 2 * p[2]};
       }},
      {R"({"children":[1],"scale":[-1,1,1]},{"mesh":0,"scale":[1,-1,1]})", "",
       [](const Point& p) {
         return Point{-p[0], -p[1], p[2]};
       }},
      {R"({"mesh":0,"scale":[9,9,9]},{"mesh":0})", R"(,"scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}])",
       [](const Point& p) { return p; }},
  };
  for (const Row& row : rows) {
    GltfFile file;
    file.nodes = row.nodes;
    file.more = row.more;
    EXPECT_EQ(trianglesOf(gltf(file)), tetrahedron(row.map, row.mirrored)) << row.nodes;
  }
  GltfFile all;
  all.nodes = R"({"mesh":0},{"mesh":0,"translation":[5,0,0]})";
  all.more = R"(,"scenes":[{"nodes":[0]}])";
  EXPECT_EQ(gltf(all).triangles.size(), 8U);
  GltfFile none;
  none.nodes = "";
  EXPECT_EQ(trianglesOf(gltf(none)), tetrahedron());
}

TEST_F(MeshFile, TriangulatesPolygons) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  const MeshData cube = mesh("m.obj", vertices + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n");
  EXPECT_EQ(cube.triangles.size(), 12U);
  EXPECT_DOUBLE_EQ(sixVolumes(cube), 6);
  EXPECT_DOUBLE_EQ(area(cube), 6);
  // An L, whose fan from the first corner would cover more than the L; seen from either side.
  for (const char* face : {"f 1 2 3 4 5 6\n", "f 6 5 4 3 2 1\n", "f 2 3 4 5 6 1\n"}) {
    const MeshData corner = mesh("m.obj", std::string("v 2 5 0\nv 2 5 2\nv 1 5 2\nv 1 5 1\nv 0 5 1\nv 0 5 0\n") + face);
    EXPECT_EQ(corner.triangles.size(), 4U);
    EXPECT_DOUBLE_EQ(area(corner), 3) << face;
  }
  std::string disc =
                  "ply\nformat ascii 1.0\nelement vertex 1000\nproperty float x\nproperty float y\nproperty float z\n"
                  "element face 1\nproperty list ushort int vertex_indices\nend_header\n",
              face = "1000";
  for (int i = 0; i < 1000; ++i) {
    const double angle = i * 2 * 3.14159265358979 / 1000;
    disc += std::to_string(std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + " 0\n";
    face += ' ' + std::to_string(i);
  }
  const MeshData round = mesh("m.ply", disc + face);
  EXPECT_EQ(round.triangles.size(), 998U);
  EXPECT_NEAR(area(round), 3.1416, 1e-3);
}

TEST_F(MeshFile, ReadsNormals) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 2\nvn 3 0 0\n";
  const MeshData obj = mesh("m.obj", vertices + "f 1//1 2//2 3//-2\nf 1//1 2//1 4//1\n");
  ASSERT_EQ(obj.normals.size(), 6U);
  EXPECT_EQ(obj.normals[0], (Float3{0, 0, 1}));
  EXPECT_EQ(obj.normals[1], (Float3{1, 0, 0}));
  EXPECT_EQ(obj.normals[2], (Float3{0, 0, 1}));
  EXPECT_TRUE(mesh("m.obj", vertices + "f 1//1 2//2 3//1\nf 1 2 4\n").normals.empty());
  const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
  const MeshData ply = mesh("m.ply", plyMeshHead("ascii", "uchar int vertex_indices", normals) +
                                         "0 0 0 0 0 0\n1 0 0 3 0 4\n0 1 0 0 1 0\n0 0 1 0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  ASSERT_EQ(ply.normals.size(), 12U);
  EXPECT_EQ(ply.normals[0], (Float3{0, 0, -1})) << "without a direction: the triangle's";
  EXPECT_EQ(ply.normals[2], (Float3{0.6F, 0, 0.8F}));
  GltfFile file;
  file.primitives = R"({"attributes":{"POSITION":0,"NORMAL":6},"indices":1})";
  file.nodes = R"({"mesh":0,"scale":[-2,1,1]})";  // (1, 2, 2) becomes (-1/2, 2, 2)
  const MeshData turned = gltf(file);
  ASSERT_EQ(turned.normals.size(), 12U);
  EXPECT_NEAR(turned.normals[0].x, -0.5 / std::sqrt(8.25), 1e-6);
  EXPECT_NEAR(turned.normals[0].y, 2 / std::sqrt(8.25), 1e-6);
}

TEST_F(MeshFile, ReadsColors) {
  folder.write("m.mtl", "newmtl red\r\nKa 1 1 1\r\nKd 0.5 0.25 0\r\n\r\nnewmtl bright\r\nKd 2 0 -1\r\n");
  const std::string obj = "mtllib m.mtl\n" + tetrahedronObj() + "usemtl red\nf 1 3 2\nusemtl bright\nf 1 2 4\nusemtl missing\nf 1 4 3\n";
  const MeshData colored = mesh("m.obj", obj);
  ASSERT_EQ(colored.colors.size(), 7U);
  EXPECT_EQ(colored.colors[0], (Float3{1, 1, 1})) << "without a material";
  EXPECT_EQ(colored.colors[4], (Float3{0.5F, 0.25F, 0}));
  EXPECT_EQ(colored.colors[5], (Float3{1, 0, 0}));
  EXPECT_EQ(colored.colors[6], (Float3{1, 1, 1}));
  for (const char* library : {"mtllib none.mtl\n", "mtllib /etc/passwd\n", "mtllib ../m.mtl\n", "mtllib\n", "mtllib .\n"})
    EXPECT_TRUE(mesh("m.obj", library + tetrahedronObj() + "usemtl red\nf 1 2 3\n").colors.empty()) << library;
  GltfFile file;
  file.primitives = R"({"attributes":{"POSITION":0},"indices":9},{"attributes":{"POSITION":0},"indices":9,"material":0})";
  file.more = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,0.5]}}])";
  const MeshData painted = gltf(file);
  ASSERT_EQ(painted.colors.size(), 2U);
  EXPECT_EQ(painted.colors[0], (Float3{1, 1, 1}));
  EXPECT_EQ(painted.colors[1], (Float3{0.25F, 0.5F, 0.75F}));
}

}  // namespace mesh_file_test
}  // namespace rill::test
