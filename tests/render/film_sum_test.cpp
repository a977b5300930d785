// Means of pictures, and particles moved by their velocities.
#include "views/film_sum.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "gpu/module_pipelines.hpp"
#include "graph/shader_pass.hpp"
#include "shared/fluid_records.h"
#include "shared/solid_records.h"
#include "support/gpu_test.hpp"
#include "views/finish_records.h"
#include "views/motion.hpp"
#include "views/scene_buffers.hpp"

namespace rill::test {
namespace film_sum_test {

using Texel = std::array<float, 4>;

double numberOf(uint16_t half) {
  const double value =
      std::ldexp((half & 0x7FFF) < 1024 ? half & 1023 : (half & 1023) + 1024, (half & 0x7FFF) < 1024 ? -24 : ((half >> 10) & 31) - 25);
  return half & 0x8000 ? -value : value;
}

class FilmPasses : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    bringViewShaders(device());
  }

  ImageRef image(Graph& graph, const Buffer& texels, uint32_t width, uint32_t height) {
    const BufferRef in = graph.import("texels", importOf(texels));
    ImageRef out = graph.create("light", {VK_FORMAT_R32G32B32A32_SFLOAT, width, height});
    graph.pass("upload", [&](Pass& pass) {
      pass.read(in, Use::CopySource);
      out = pass.write(out, Use::CopyTarget);
      return [=](Commands& commands) { commands.copy(in, out); };
    });
    return out;
  }
};

TEST_F(FilmPasses, MeanOfPicturesIsThatOfTheirLight) {
  constexpr uint32_t kWidth = 37, kHeight = 5, kPictures = 7;
  auto sum = FilmSum::create(device());
  ASSERT_TRUE(sum && sum->resize(device(), kWidth, kHeight));
  std::vector<Texel> wanted(kWidth * kHeight);
  for (const uint32_t round : {0u, 1u}) {  // the second sum begins anew
    for (Texel& texel : wanted) texel = {};
    for (uint32_t k = 0; k < kPictures; ++k) {
      std::vector<Texel> texels(wanted.size());
      for (size_t i = 0; i < texels.size(); ++i)
        for (size_t c = 0; c < 3; ++c) {
          texels[i][c] = float(std::exp(3 * std::sin(double(i * 3 + c) + 0.7 * k + round)));
          wanted[i][c] += texels[i][c] / kPictures;
        }
      texels[3] = {-1, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1};
      const Buffer source = upload("texels", texels);
      Graph graph;
      sum->add(graph, image(graph, source, kWidth, kHeight), k == 0);
      run(graph);
    }
  }
  Graph graph;
  const Ticket linear = graph.readback(sum->linear(graph, kPictures)), shown = graph.readback(sum->picture(graph, kPictures, 1));
  run(graph);
  const auto halves = read<std::array<uint16_t, 4>>(graph, linear);
  ASSERT_EQ(halves.size(), wanted.size());
  for (size_t i = 0; i < wanted.size(); ++i) {
    if (i == 3) continue;
    for (size_t c = 0; c < 3; ++c) ASSERT_NEAR(numberOf(halves[i][c]), wanted[i][c], wanted[i][c] / 1024 + 1e-6) << i;
    ASSERT_EQ(halves[i][3], 0x3C00) << "alpha is 1";
  }
  EXPECT_EQ(numberOf(halves[3][0]), 0);
  EXPECT_EQ(numberOf(halves[3][1]), 0) << "a NaN is black";
  EXPECT_EQ(numberOf(halves[3][2]), 65504);

  // The tone curve is that of a picture without samples.
  constexpr uint32_t kTile = finish::kPictureTile;
  std::vector<Texel> twice = wanted;
  for (Texel& texel : twice)
    for (float& value : texel) value *= 2;
  const Buffer source = upload("mean", twice);
  Graph plain;
  ModulePipelines pipelines(device());
  const ComputePipeline* tone = pipelines.make("views/tonemap");
  BufferRef aliased = plain.create("aliased", {twice.size() * 4});
  addDispatch(plain, "tone", tone, Groups{(kWidth + kTile - 1) / kTile, (kHeight + kTile - 1) / kTile, 1}, 1.0f,
              {{"hdr", image(plain, source, kWidth, kHeight)}, {"aliased", aliased}});
  const Ticket ticket = plain.readback(aliased);
  run(plain);
  const auto expected = read<std::array<uint8_t, 4>>(plain, ticket), got = read<std::array<uint8_t, 4>>(graph, shown);
  for (size_t i = 0; i < got.size(); ++i)
    for (size_t c = 0; c < 4 && i != 3; ++c) ASSERT_NEAR(got[i][c], expected[i][c], 1) << i;
}

TEST_F(FilmPasses, ParticlesMoveByTheirVelocities) {
  const std::vector<Float4> position{{1, 2, 3, 0.5f}, {-4, 0, 8, 7}, {kInactivePosition, kInactivePosition, kInactivePosition, 0}};
  const std::vector<Float4> velocity{{10, -20, 4, 1}, {0, 0, 0, 1}, {1, 1, 1, 1}};
  SolidRecord still{}, body{}, driven{};
  for (SolidRecord* solid : {&still, &body, &driven}) {
    solid->pose.rotationW = 1;
    solid->pose.velocityX = 2;
    solid->pose.angularY = 3;
    solid->body = kNoBody;
    solid->friction = 0.25f;
  }
  body.body = 0;
  driven.driven = 1;
  const Buffer positions = upload("position", position), velocities = upload("velocity", velocity);
  const Buffer solids = upload("solids", std::vector<SolidRecord>{still, body, driven});
  auto motion = Motion::create(device());
  ASSERT_TRUE(motion);
  Graph graph;
  FluidState state{.capacity = 3, .spacing = 1};
  state.position = graph.import("position", importOf(positions));
  state.velocity = graph.import("velocity", importOf(velocities));
  state.solids = graph.import("solids", importOf(solids));
  const FluidState moved = motion->addTo(graph, state, 3, -0.25);
  const Ticket at = graph.readback(moved.position), poses = graph.readback(moved.solids);
  run(graph);
  const auto got = read<Float4>(graph, at);
  ASSERT_EQ(got.size(), 3u);
  EXPECT_EQ(got[0], (Float4{-1.5f, 7, 2, 0.5f}));
  EXPECT_EQ(got[1], position[1]);
  EXPECT_EQ(got[2], position[2]) << "an inactive one";
  const auto solid = read<SolidRecord>(graph, poses);
  ASSERT_EQ(solid.size(), 3u);
  EXPECT_EQ(solid[0].pose.centerX, 0) << "its keyframes say where it is";
  for (const size_t k : {1u, 2u}) {
    EXPECT_FLOAT_EQ(solid[k].pose.centerX, -0.5f);
    EXPECT_NEAR(solid[k].pose.rotationY, std::sin(-0.375), 0.02);
    EXPECT_EQ(solid[k].friction, 0.25f);
  }
}

}  // namespace film_sum_test
}  // namespace rill::test
