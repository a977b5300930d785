// Meshes in a scene: keys, files, fills.
#include <cmath>
#include <numbers>

#include "fluid/settings.hpp"
#include "shape/mass.hpp"
#include "support.hpp"
#include "support/meshes.hpp"
#include "support/tetrahedron_files.hpp"

namespace rill::test {
namespace {

/// A scene of 0.2 in a folder with a file of a mesh.
class MeshScene : public ::testing::Test {
 protected:
  Expected<Scene> load(const std::string& more, const std::string& version = "0.2") const {
    return loadScene(folder.write("s.json", R"({"rill": ")" + version + R"(", "fluid": {"spacing": 0.1}, )" + more + "}"));
  }
  std::string errorOf(const std::string& more, const std::string& version = "0.2") const {
    const auto scene = load(more, version);
    return scene ? std::string("no error") : scene.error().message.substr(folder.path.string().size() + 1);
  }
  Folder folder;
};

Fill meshFill(MeshData data) { return Fill{.shape = MeshShape{.mesh = meshOf(std::move(data))}}; }

size_t countOf(const Fill& fill, double spacing) {
  Scene s;
  s.fluid.spacing = spacing;
  s.fill = {fill};
  return particles(s).positions.size();
}

TEST_F(MeshScene, AppliesUpAndScale) {
  folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto scene = load(R"("solids": [{"mesh": {"file": "m.obj", "scale": 0.5, "up": "z"}, "translation": [1, 2, 3]}])");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto& shape = std::get<MeshShape>(scene->solids[0].shape);
  EXPECT_EQ(shape.mesh->max(), (Double3{0.5, 1.5, 0})) << "z is up, y points away";
  EXPECT_EQ(shape.mesh->min(), (Double3{0, 0, -1}));
  EXPECT_NEAR(shape.mesh->volume(), 0.125, 1e-12);
  EXPECT_EQ(scene->solids[0].translation, (Double3{1, 2, 3}));
}

TEST_F(MeshScene, SolidsOfOneFileShareAMesh) {
  folder.write("m.obj", tetrahedronObj());
  const auto scene =
      load(R"("solids": [{"mesh": {"file": "m.obj"}}, {"mesh": {"file": "m.obj"}}, {"mesh": {"file": "m.obj", "scale": 2}}])");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto meshOfSolid = [&](size_t k) { return std::get<MeshShape>(scene->solids[k].shape).mesh; };
  EXPECT_EQ(meshOfSolid(0), meshOfSolid(1));
  EXPECT_NE(meshOfSolid(0), meshOfSolid(2));
}

TEST_F(MeshScene, ErrorsNameTheKeyAndTheFile) {
  folder.write("m.obj", tetrahedronObj());
  folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(errorOf(R"("solids": [{"mesh": {"file": "m.obj"}}])", "0.1"),
            "s.json: solids[0].mesh: the scene says \"rill\": \"0.1\"; the key needs \"rill\": \"0.2\"");
  EXPECT_NE(errorOf(R"("solids": [{"mesh": {"file": "none.obj"}}])").find("s.json: solids[0].mesh.file: "), std::string::npos);
  const std::string open = errorOf(R"("solids": [{"mesh": {"file": "open.obj"}}])");
  EXPECT_NE(open.find("open.obj: the mesh is not closed: found 3 open edges, the first from [0, 0, 0]"), std::string::npos) << open;
  EXPECT_EQ(errorOf(R"("solids": [{"mesh": {"file": "open.obj", "two_sided": true}}])"), "no error");
  EXPECT_NE(errorOf(R"("fill": [{"mesh": {"file": "open.obj", "two_sided": true}}])").find("fill[0].mesh.two_sided"), std::string::npos);
  EXPECT_NE(errorOf(R"("solids": [{"mesh": {"file": "m.obj", "scale": 0}}])").find("solids[0].mesh.scale"), std::string::npos);
  EXPECT_NE(errorOf(R"("solids": [{"name": "a", "mesh": {"file": "m.obj"}}, {"name": "a", "mesh": {"file": "m.obj"}}])").find("name"),
            std::string::npos);
}

// Two lobes of one closed surface that crosses itself, so that what one encloses counts against the other.
std::string crossedPrism(double lobe) {
  const std::string x = std::to_string(lobe);
  std::string text;
  for (const char* z : {" 0\n", " 1\n"})
    text += "v -1 -1" + std::string(z) + "v -1 1" + z + "v " + x + " -" + x + z + "v " + x + " " + x + z;
  // The outline -1 -1, -1 1, x -x, x x crosses itself in the middle.
  return text + "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 1 4 3 2\nf 5 6 7 8\n";
}

TEST_F(MeshScene, RejectsBodiesOfMeshesWithoutAMass) {
  const auto bodyOf = [&](const std::string& file, const std::string& more = "") {
    return errorOf(R"("solids": [{"box": {}}, {"mesh": {"file": ")" + file + "\"" + more + R"(}, "body": {"density": 500}}])");
  };
  folder.write("good.obj", tetrahedronObj());
  folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder.write("point.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
  folder.write("crossed.obj", crossedPrism(1));
  EXPECT_EQ(bodyOf("good.obj"), "no error");
  const std::pair<std::string, std::string> cases[] = {{bodyOf("open.obj"), "open.obj: the mesh is not closed: found 3 open edges"},
                                                       {bodyOf("flat.obj"), "flat.obj: the mesh encloses 0 m^3; expected a volume"},
                                                       {bodyOf("point.obj"), "point.obj: found no triangle with three corners"},
                                                       {bodyOf("crossed.obj"), "crossed.obj: the mesh encloses 0 m^3; expected a volume"}};
  for (const auto& [error, words] : cases) {
    EXPECT_EQ(error.rfind("s.json: solids[1].mesh.file: ", 0), 0U) << error;
    EXPECT_NE(error.find(words), std::string::npos) << error;
  }
  EXPECT_NE(bodyOf("open.obj", R"(, "two_sided": true)").find("solids[1].body: found a body of a two-sided mesh"), std::string::npos);
}

// A volume is left, but the moments of one lobe count against those of the other.
TEST_F(MeshScene, RejectsBodiesWhoseMeshCrossesItself) {
  folder.write("crossed.obj", crossedPrism(0.99));
  const auto scene = load(R"("solids": [{"box": {}}, {"mesh": {"file": "crossed.obj"}, "body": {"density": 500}}])");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto setup = makeFluidSetup(*scene, {.capacity = 1, .extent = {1, 1, 1}});
  ASSERT_FALSE(setup);
  for (const char* words : {"s.json: solids[1].body: a mass of 9.95 kg", "expected a mesh that does not cross itself"})
    EXPECT_NE(setup.error().message.find(words), std::string::npos) << setup.error().message;
}

TEST_F(MeshScene, TurnsBodiesThatAreInsideOut) {
  folder.write("turned.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const auto scene = load(R"("solids": [{"mesh": {"file": "turned.obj"}, "body": {"density": 600}}])");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(massOf(scene->solids[0]).mass, 100, 1e-9);
  EXPECT_EQ(std::get<MeshShape>(scene->solids[0].shape).mesh->warnings(),
            std::vector<std::string>{"the mesh was inside out: all triangles turned"});
}

TEST(MeshFill, HasItsVolumeInParticles) {
  const double ball = 4.0 / 3 * std::numbers::pi;
  for (const double d : {0.1, 0.07, 0.05})
    EXPECT_NEAR(static_cast<double>(countOf(meshFill(ballMesh(1, 5)), d)) * d * d * d, ball, 0.01 * ball) << d;
  EXPECT_EQ(countOf(meshFill(boxMesh({0.3, 0.2, 0.1}, {1.3, 0.7, 0.5})), 0.1), 10U * 5 * 4) << "as a box";
  EXPECT_EQ(countOf(meshFill(joined(boxMesh({0, 0, 0}, {1, 1, 1}), boxMesh({0.5, 0, 0}, {1.5, 1, 1}))), 0.1), 1500U) << "parts overlap";
  EXPECT_EQ(countOf(meshFill(joined(boxMesh({0, 0, 0}, {1, 1, 1}), turned(boxMesh({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7})))), 0.1), 1000U - 64)
      << "a cavity";
}

TEST(MeshFill, IsRotatedAndTranslated) {
  Scene s;
  s.fluid.spacing = 0.1;
  Fill fill = meshFill(boxMesh({0, 0, 0}, {1, 0.2, 0.2}));
  fill.rotation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // x becomes y
  fill.translation = {3, 0, 0};
  s.fill = {fill};
  const ParticleSet set = particles(s);
  ASSERT_EQ(set.positions.size(), 40U);
  for (const Float3& p : set.positions) {
    const double x = set.origin.x + p.x, y = set.origin.y + p.y;
    EXPECT_TRUE(x > 2.8 && x < 3 && y > 0 && y < 1) << x << " " << y;
  }
}

TEST(MeshFill, RejectsMoreRowsThanPoints) {
  Scene s;
  s.fluid.spacing = 0.05;
  s.fill = {meshFill(joined(boxMesh({0, 0, 0}, {1, 1, 1}), boxMesh({0, 1e4, 1e4}, {1, 1e4 + 1, 1e4 + 1})))};
  const auto set = makeParticles(s);
  ASSERT_FALSE(set);
  EXPECT_NE(set.error().message.find("fill[0].mesh: its bounds have"), std::string::npos) << set.error().message;
}

TEST(MeshFill, WarnsOfRepairs) {
  Scene s;
  s.fluid.spacing = 0.1;
  s.fill = {meshFill(turned(boxMesh({0, 0, 0}, {1, 1, 1})))};
  const ParticleSet set = particles(s);
  EXPECT_EQ(set.positions.size(), 1000U);
  ASSERT_EQ(set.warnings.size(), 1U);
  EXPECT_EQ(set.warnings[0], "fill[0]: the mesh was inside out: all triangles turned");
}

}  // namespace
}  // namespace rill::test
