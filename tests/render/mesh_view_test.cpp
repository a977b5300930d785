// Solids that are meshes, in pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "offline/painter.hpp"
#include "rill/fluid.hpp"
#include "rill/particles.hpp"
#include "support/gpu_test.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

class MeshView : public GpuTest {
 protected:
  static constexpr uint32_t kAcross = 200, kDown = 140;
  using Rgba = std::array<uint8_t, 4>;

  /// A tank with a layer of water in its front half.
  MeshView() {
    scene_.domain = Domain{{0, 0, 0}, {1, 0.7, 1}, 0};
    scene_.fluid.spacing = 0.04;
    scene_.fill.emplace_back().shape = BoxShape{{0, 0, 0.6}, {1, 0.25, 1}};
    scene_.camera = Camera{.eye = {0.9, 0.9, 2.2}, .target = {0.5, 0.2, 0.5}};
  }

  static Solid solid(MeshData data, const Double3& at, bool twoSided = false) {
    return Solid{.shape = MeshShape{.two_sided = twoSided, .mesh = meshOf(std::move(data), twoSided)}, .translation = at};
  }

  /// Of the start, at `time`.
  std::vector<Rgba> picture(std::string_view view, double time = 0) {
    graph_.emplace();
    const auto start = makeParticles(scene_);
    EXPECT_TRUE(start) << start.error().message;
    auto fluid = Fluid::create(device(), {.scene = &scene_, .particles = &*start});
    EXPECT_TRUE(fluid) << fluid.error().message;
    offline::Painter painter(scene_, *start);
    const auto made = painter.prepare(device(), view, kAcross, kDown);
    EXPECT_TRUE(made) << made.error().message;
    if (!fluid || !made) return {};
    const auto tickets = painter.declare(*graph_, fluid->addTo(*graph_, {}), view, kAcross, kDown, time);
    run(*graph_);
    return read<Rgba>(*graph_, tickets.picture);
  }
  bool ran(std::string_view pass) const {
    return std::ranges::any_of(graph_->report(), [&](const PassReport& r) { return r.name == pass && r.reason.empty(); });
  }

  static int apart(const Rgba& a, const Rgba& b) {
    int most = 0;
    for (size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
  }
  /// How many pixels differ by more than this in a channel.
  static size_t different(const std::vector<Rgba>& a, const std::vector<Rgba>& b, int tolerance) {
    EXPECT_EQ(a.size(), b.size());
    size_t count = 0;
    for (size_t k = 0; k < std::min(a.size(), b.size()); ++k) count += apart(a[k], b[k]) > tolerance ? 1 : 0;
    return count;
  }

  Scene scene_;
  std::optional<Graph> graph_;
};

/// Turned and moved, so that the pose counts; partly behind water, which refracts it.
TEST_F(MeshView, BoxOfTrianglesLooksLikeABox) {
  const BoxShape box{{0.3, 0.02, 0.2}, {0.6, 0.42, 0.5}};
  Solid rays{.shape = box, .rotation = {0, std::sin(0.3), 0, std::cos(0.3)}};
  rays.motion = {{0, {0, 0, 0}}, {1, {0.1, 0.1, 0}}};
  Solid triangles = rays;
  triangles.shape = solid(boxMesh({-0.15, -0.2, -0.15}, {0.15, 0.2, 0.15}), {}).shape;
  triangles.translation = {0.45, 0.22, 0.35};
  for (const double time : {0.0, 0.5}) {
    scene_.solids.clear();
    const auto bare = picture("final", time);
    EXPECT_FALSE(ran("scenery meshes") || ran("scenery solids"));
    scene_.solids = {rays};
    const auto wanted = picture("final", time);
    EXPECT_TRUE(ran("scenery solids"));
    EXPECT_FALSE(ran("scenery meshes"));
    scene_.solids = {triangles};
    const auto seen = picture("final", time);
    EXPECT_TRUE(ran("scenery meshes"));
    EXPECT_FALSE(ran("scenery solids"));
    EXPECT_GT(different(bare, wanted, 12), 1200u);
    EXPECT_LT(different(wanted, seen, 3), 150u) << time;
  }
}

/// By rays through the fluid's field, whose edges are a little round.
TEST_F(MeshView, ParticlesShowTheField) {
  for (const double time : {0.0, 0.5}) {
    Solid rays{.shape = BoxShape{{0.3, 0.1, 0.2}, {0.6, 0.5, 0.5}}, .rotation = {0, std::sin(0.3), 0, std::cos(0.3)}};
    rays.motion = {{0, {0, 0, 0}}, {1, {0.1, 0.1, 0}}};
    Solid triangles = rays;
    triangles.shape = solid(boxMesh({-0.15, -0.2, -0.15}, {0.15, 0.2, 0.15}), {}).shape;
    triangles.translation = {0.45, 0.3, 0.35};
    scene_.solids.clear();
    const auto bare = picture("particles", time);
    scene_.solids = {rays};
    const auto wanted = picture("particles", time);
    scene_.solids = {triangles};
    EXPECT_GT(different(bare, wanted, 12), 1200u);
    EXPECT_LT(different(wanted, picture("particles", time), 24), 150u) << time;
  }
  scene_.solids = {solid(ballMesh(0.15, 4), {0.3, 0.4, 0.3}), Solid{.shape = SphereShape{{0.7, 0.4, 0.3}, 0.1}}};
  const auto seen = picture("particles");
  scene_.solids.front() = Solid{.shape = SphereShape{{0.3, 0.4, 0.3}, 0.15}};
  EXPECT_LT(different(picture("particles"), seen, 24), 120u);
}

TEST_F(MeshView, FramesAMeshFarFromItsOrigin) {
  scene_.camera.reset();
  scene_.domain.reset();
  scene_.fill.front().shape = BoxShape{{0, 0, 0}, {0.4, 0.2, 0.4}};
  scene_.solids = {solid(boxMesh({5, 0, 7}, {5.2, 0.3, 7.2}), {-4.5, 0, -7})};
  const auto start = makeParticles(scene_);
  ASSERT_TRUE(start);
  const CameraView camera = sceneCamera(scene_, *start, 1);
  EXPECT_NEAR(camera.target[0], 0.35, 0.1);
  EXPECT_LT(std::hypot(camera.eye[0] - camera.target[0], camera.eye[1] - camera.target[1], camera.eye[2] - camera.target[2]), 3);
}

TEST_F(MeshView, ColorsAreThoseOfTheTriangles) {
  MeshData box = boxMesh({-0.2, 0, -0.2}, {0.2, 0.4, 0.2});
  scene_.solids = {solid(box, {0.5, 0, 0.3})};
  const auto plain = picture("final");
  box.colors.assign(box.triangles.size(), Float3{0.8f, 0.02f, 0.02f});
  scene_.solids = {solid(box, {0.5, 0, 0.3})};
  const auto red = picture("final");
  size_t reds = 0;
  for (const auto& [r, g, b, a] : red) reds += r > 2 * g && r > 2 * b ? 1 : 0;
  EXPECT_GT(reds, 1000u);
  for (const auto& [r, g, b, a] : plain) EXPECT_FALSE(r > 2 * g && r > 2 * b);
}

TEST_F(MeshView, SheetIsSeenFromBothSides) {
  MeshData sheet;
  sheet.vertices = {{-0.3, 0.3, -0.2}, {0.3, 0.3, -0.2}, {0.3, 0.5, 0.2}, {-0.3, 0.5, 0.2}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene_.solids.clear();
  const auto bare = picture("final");
  scene_.solids = {solid(sheet, {0.5, 0, 0.3}, true)};
  const auto one = picture("final");
  scene_.solids = {solid(turned(sheet), {0.5, 0, 0.3}, true)};
  const auto other = picture("final");
  EXPECT_GT(different(bare, one, 12), 600u);
  EXPECT_LT(different(one, other, 3), 20u) << "lit from the side of the eye, however its triangles are turned";
}

/// A ball above the floor darkens what lies towards the front right of it.
TEST_F(MeshView, CastsShadows) {
  scene_.fill.front().shape = BoxShape{{0, 0, 0.9}, {0.2, 0.1, 1}};
  Solid rays{.shape = SphereShape{{0.5, 0.5, 0.4}, 0.12}};
  scene_.solids = {rays};
  const auto wanted = picture("final");
  scene_.solids = {solid(ballMesh(0.12, 4), {0.5, 0.5, 0.4})};
  EXPECT_LT(different(wanted, picture("final"), 12), 120u);
  scene_.solids.clear();
  EXPECT_GT(different(wanted, picture("final"), 12), 600u);
}

TEST_F(MeshView, EnvironmentLightsMeshes) {
  const TemporaryFolder folder;
  std::string sky = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
  for (int k = 0; k < 32; ++k) sky += {'\x10', '\x40', '\x10', '\x81'};  // green
  scene_.look.environment = folder.write("green.hdr", sky);
  scene_.solids = {solid(ballMesh(0.12, 4), {0.5, 0.5, 0.4})};
  const auto seen = picture("final");
  scene_.solids = {Solid{.shape = SphereShape{{0.5, 0.5, 0.4}, 0.12}}};
  EXPECT_LT(different(picture("final"), seen, 12), 120u);
}

TEST_F(MeshView, ManySolidsOfAllKinds) {
  const auto ball = meshOf(ballMesh(0.08, 3));
  scene_.solids.clear();
  for (int k = 0; k < 9; ++k) {
    const int column = k % 3, row = k / 3;
    const Double3 at = {0.2 + 0.3 * column, 0.15 + 0.2 * row, 0.3};
    if (k % 3 == 0) scene_.solids.push_back(Solid{.shape = SphereShape{at, 0.08}});
    if (k % 3 == 1) scene_.solids.push_back(solid(boxMesh({-0.07, -0.07, -0.07}, {0.07, 0.07, 0.07}), at));
    if (k % 3 == 2) scene_.solids.push_back(Solid{.shape = MeshShape{.mesh = ball}, .translation = at});
  }
  const auto seen = picture("final");
  EXPECT_TRUE(ran("scenery meshes") && ran("scenery solids"));
  for (Solid& s : scene_.solids)
    if (std::holds_alternative<MeshShape>(s.shape)) {
      const Double3 at = s.translation;
      s.translation = {0, 0, 0};
      if (std::get<MeshShape>(s.shape).mesh == ball)
        s.shape = SphereShape{at, 0.08};
      else
        s.shape = BoxShape{{at.x - 0.07, at.y - 0.07, at.z - 0.07}, {at.x + 0.07, at.y + 0.07, at.z + 0.07}};
    }
  EXPECT_LT(different(picture("final"), seen, 12), 300u);
}

}  // namespace
}  // namespace rill::test
