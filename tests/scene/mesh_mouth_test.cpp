// Emitters whose mouth is a flat mesh, in scene files and made in code.
#include "core/vector_math.hpp"
#include "fill/mouth.hpp"
#include "fluid/settings.hpp"
#include "support.hpp"
#include "support/flat_meshes.hpp"

namespace rill::test {
namespace {

/// A triangle of 0.5 m^2 in the plane z = 0, facing +z.
constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class MeshMouthScene : public ::testing::Test {
 protected:
  Expected<Scene> load(const std::string& emitter, const std::string& more = "") const {
    return loadScene(folder.write("s.json", R"({"rill": "0.2", "fluid": {"spacing": 0.1}, "emitters": [{)" + emitter + "}]" + more + "}"));
  }
  /// Of a scene with this file as its mouth, without the names of folders.
  std::string errorOf(const std::string& obj) const {
    folder.write("m.obj", obj);
    const auto scene = load(R"("mesh": {"file": "m.obj"}, "flow": 1)");
    std::string text = scene ? "accepted" : scene.error().message;
    const std::string in = folder.path.string() + "/";
    for (size_t at = text.find(in); at != std::string::npos; at = text.find(in)) text.erase(at, in.size());
    return text;
  }
  Folder folder;
};

TEST_F(MeshMouthScene, ReadsEveryKey) {
  folder.write("m.obj", kTriangle);
  const auto scene = load(R"("mesh": {"file": "m.obj", "scale": 0.5, "up": "z", "translation": [1, 2, 3], "rotation": [0, 2, 0, 0]},
                             "speed": 2)",
                          R"(, "solids": [{"mesh": {"file": "m.obj", "scale": 0.5, "up": "z", "two_sided": true}}])");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto& mouth = std::get<MeshMouth>(scene->emitters[0].mouth);
  EXPECT_EQ(mouth.file, folder.path / "m.obj");
  EXPECT_EQ(mouth.scale, 0.5);
  EXPECT_EQ(mouth.up, UpAxis::Z);
  EXPECT_EQ(mouth.translation, (Double3{1, 2, 3}));
  EXPECT_EQ(mouth.rotation, (Quaternion{0, 1, 0, 0})) << "normalized";
  EXPECT_EQ(mouth.mesh->max(), (Double3{0.5, 0, 0})) << "z is up, y points away";
  EXPECT_EQ(mouth.mesh, std::get<MeshShape>(scene->solids[0].shape).mesh) << "one file is read once";
  EXPECT_NEAR(areaOf(mouth), 0.125, 1e-12);
  EXPECT_NEAR(flowOf(scene->emitters[0]), 0.25, 1e-12);
  EXPECT_EQ(pivotOf(mouth), mouth.translation);
  const Double3 center = centerOf(mouth);  // half a turn about y
  EXPECT_NEAR(center.x, 1 - 0.5 / 3, 1e-12);
  EXPECT_NEAR(center.y, 2, 1e-12);
  EXPECT_NEAR(center.z, 3 + 0.5 / 3, 1e-12);
}

TEST_F(MeshMouthScene, RejectsKeysNamingThem) {
  folder.write("m.obj", kTriangle);
  const auto refused = [&](const std::string& emitter) {
    const auto scene = load(emitter);
    return scene ? std::string("accepted") : scene.error().message.substr(folder.path.string().size() + 1);
  };
  const std::string one = "s.json: emitters[0]: expected exactly one of \"disc\", \"rect\", \"mesh\"; found ";
  EXPECT_EQ(refused(R"("flow": 1)"), one + "none");
  EXPECT_EQ(refused(R"("disc": {}, "mesh": {"file": "m.obj"}, "flow": 1)"), one + "\"disc\", \"mesh\"");
  EXPECT_EQ(refused(R"("mesh": {}, "flow": 1)").substr(0, 59), "s.json: emitters[0].mesh.file: required key is missing: OBJ");
  EXPECT_EQ(refused(R"("mesh": {"file": "none.obj"}, "flow": 1)").substr(0, 57),
            "s.json: emitters[0].mesh.file: \"none.obj\": no such file (");
  EXPECT_EQ(refused(R"("mesh": {"file": "m.obj", "scale": 0}, "flow": 1)"),
            "s.json: emitters[0].mesh.scale: 0 is out of range; expected a number above 0 (m)");
  EXPECT_EQ(
      refused(R"("mesh": {"file": "m.obj", "rotation": [0, 0, 0, 0]}, "flow": 1)"),
      "s.json: emitters[0].mesh.rotation: the quaternion has zero length; expected a non-zero quaternion, [0, 0, 0, 1] for no rotation");
  EXPECT_EQ(refused(R"("mesh": {"file": "m.obj", "two_sided": true}, "flow": 1)").substr(0, 49),
            "s.json: emitters[0].mesh.two_sided: unknown key; ");
}

TEST_F(MeshMouthScene, RejectsMeshesThatAreNoMouthNamingFileAndFigure) {
  const std::string key = "s.json: emitters[0].mesh.file: m.obj: ";
  EXPECT_EQ(errorOf(kTriangle), "accepted");
  EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\nv 1 1 0.003\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"), "accepted") << "as flat as a drawing is";
  EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"),
            key +
                "the mesh is not flat: its vertex at [1, 0, 0] is 0.03325 m off the plane of the triangles; expected at most 0.001418 m, a "
                "thousandth of its size");
  EXPECT_EQ(errorOf("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n"), key + "the triangles have no area; expected a mouth with one");
  EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"),
            key + "the triangles face in opposite directions; expected all to face where the fluid goes")
      << "a closed mesh";
  EXPECT_EQ(
      errorOf("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 3 0 0\nv 3.5 0 0\nv 3 0.5 0\nf 1 2 3\nf 1 3 4\nf 5 7 6\n"),
      key + "triangles of 0.125 m^2 face against the others, the first at [3.167, 0.1667, 0]; expected all to face where the fluid goes");
  EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\nf 1 2 1\n"), key + "found no triangle with three corners, expected a mesh");
}

TEST_F(MeshMouthScene, ChecksMeshesOfAHost) {
  Scene scene;
  scene.fluid.spacing = 0.1;
  const auto messageFor = [&](MeshMouth mouth) {
    scene.emitters = {{.mouth = std::move(mouth), .flow = 1}};
    const auto checked = checkScene(scene);
    return checked ? std::string("accepted") : checked.error().message;
  };
  EXPECT_EQ(messageFor(mouthOf(cornerMesh(1))), "accepted");
  EXPECT_EQ(messageFor({}), "emitters[0].mesh.mesh: found no mesh; expected one of Mesh::create(), or a file that loadScene() reads");
  EXPECT_EQ(messageFor({.mesh = meshOf(boxMesh({0, 0, 0}, {1, 1, 1}))}),
            "emitters[0].mesh.mesh: found a mesh with an inside; expected one that was created two-sided");
  MeshMouth turned = mouthOf(cornerMesh(1));
  turned.rotation = {0, 0, 0, 2};
  EXPECT_EQ(messageFor(turned), "emitters[0].mesh.rotation: the quaternion's length is 2; expected 1");
}

TEST_F(MeshMouthScene, RejectsTrianglesThatOverlapAndTooManyRows) {
  Scene scene;
  scene.name = "jet";
  scene.fluid.spacing = 0.1;
  const auto messageFor = [&](MeshData data) {
    scene.emitters = {{.mouth = mouthOf(std::move(data)), .flow = 1}};
    const auto setup = makeFluidSetup(scene, {.capacity = 100, .extent = {1, 1, 1}});
    return setup ? std::string("accepted") : setup.error().message;
  };
  EXPECT_EQ(messageFor(joined(rectMesh(1, 1), moved(rectMesh(1, 1), 1, 0))), "accepted");
  EXPECT_EQ(messageFor(joined(rectMesh(1, 1), moved(rectMesh(1, 1), 0.5, 0))),
            "jet: emitters[0].mesh: 50 of 150 points of a layer are in several triangles; expected a mesh that does not overlap itself");
  EXPECT_EQ(messageFor(rectMesh(1000, 200)).substr(0, 85),
            "jet: emitters[0]: its mouth takes 2e+07 particles of fluid.spacing a layer; expected ");
  MeshData comb;
  for (uint32_t k = 0; k < 10; ++k) comb = joined(comb, moved(rectMesh(0.01, 2000), 0.1 * k, 0));
  comb = joined(comb, moved(rectMesh(3000, 0.01), 0, 2001));
  EXPECT_EQ(messageFor(comb),
            "jet: emitters[0]: the triangles of its mesh lie in 4e+05 rows of a lattice of fluid.spacing, rows that several are "
            "in counted for each; expected at most 262,144");
}

TEST_F(MeshMouthScene, WarnsOfMouthsThatAreBlocked) {
  Scene scene;
  scene.name = "dam";
  scene.fluid.spacing = 0.1;
  scene.domain = Domain{{0, 0, 0}, {2, 1, 1}};
  scene.solids = {{.shape = BoxShape{{0.5, 0, 0}, {1, 0.5, 1}}}};
  const auto warningsAt = [&](const Double3& place, MeshData data) {
    MeshMouth mouth = mouthOf(std::move(data));
    mouth.translation = place;
    scene.emitters = {{.mouth = mouth, .flow = 0.01}};
    return particles(scene).warnings;
  };
  const std::vector<std::string> inside{"dam: emitters[0]: its mouth is inside solids[0]; it is blocked"};
  EXPECT_EQ(warningsAt({0.75, 0.25, 0.5}, cornerMesh(0.1)), inside);
  EXPECT_EQ(warningsAt({0.75, 0.25, 0.5}, rectMesh(0.001, 0.001)), inside) << "narrower than the spacing";
  EXPECT_EQ(warningsAt({0.75, 0.25, 0.5}, cornerMesh(0.4)), std::vector<std::string>{}) << "a part is free";
  EXPECT_EQ(warningsAt({0.75, 0.5, 0.5}, ringMesh(0.4, 0.45, 24)), std::vector<std::string>{}) << "around what is in the solid";
  EXPECT_EQ(warningsAt({1.5, 1.5, 0.5}, cornerMesh(0.1)),
            std::vector<std::string>{"dam: emitters[0]: its mouth is outside the domain's walls; it is blocked"});
}

TEST_F(MeshMouthScene, ShippedStarHasTheAreaOfAStar) {
  const auto scene =
      loadScene(folder.write("s.json", R"({"rill": "0.2", "fluid": {"spacing": 0.0125}, "emitters": [{"mesh": {"file": ")" +
                                           std::string(RILL_SOURCE_DIR) + R"(/assets/scenes/meshes/star.obj"}, "flow": 0.002}]})"));
  ASSERT_TRUE(scene) << scene.error().message;
  const double star = 5 * std::sin(std::numbers::pi / 5) * 0.1 * 0.045 * (1 - 0.35 * 0.35);
  EXPECT_NEAR(areaOf(scene->emitters[0].mouth), star, 1e-4 * star) << "its file has six digits";
  EXPECT_NEAR(length(minus(centerOf(scene->emitters[0].mouth), {})), 0, 1e-6);
}

}  // namespace
}  // namespace rill::test
