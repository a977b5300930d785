// The sun in environment maps.
#include "render/environment_sun.hpp"

#include <gtest/gtest.h>

#include "render/environment_pictures.hpp"
#include "rill/scene_io.hpp"

namespace rill::test {
namespace environment_test {

const Double3 kSuns[] = {{0, 1, 0},     {0.01, 0.99995, 0}, {0.6, 0.64, -0.48}, {0.6, 0.64, 0.48},  {-0.6, 0.8, 0},
                         {0, 0.6, 0.8}, {1e-3, 0.6, 0.8},   {-0.96, 0.28, 0},   {0.8, 0.12, 0.588}, {-0.36, 0.872, 0.331}};

TEST(EnvironmentSunTest, IsFoundWithinATexel) {
  for (const Double3& to : kSuns) {
    const double size = std::sqrt(dotOf(to, to));
    const Double3 sun = {to.x / size, to.y / size, to.z / size};
    for (const double radius : {1.5 * kTexel, 4 * kTexel}) {
      const auto found = findSun(sunny(sun, radius, 3000));
      ASSERT_TRUE(found) << sun.x << " " << sun.y << " " << sun.z;
      const double apart = std::acos(std::min(dotOf(sun, {found->direction.x, found->direction.y, found->direction.z}), 1.0));
      EXPECT_LT(apart, kTexel) << sun.x << " " << sun.y << " " << sun.z << ", radius " << radius;
      EXPECT_NEAR(double{found->radius}, radius, 0.75 * kTexel) << "texels are inside or outside";
      EXPECT_NEAR(double{found->light.y / found->light.x}, 0.9, 0.01);
      EXPECT_NEAR(double{found->light.z / found->light.x}, 0.7, 0.01);
    }
  }
}

TEST(EnvironmentSunTest, TakingItOutKeepsIrradiance) {
  for (const Double3& to : kSuns) {
    const double size = std::sqrt(dotOf(to, to));
    EnvironmentPicture map = sunny({to.x / size, to.y / size, to.z / size}, 3 * kTexel, 3000);
    const EnvironmentPicture before = map;
    const auto sun = takeSun(map);
    ASSERT_TRUE(sun);
    for (const uint32_t texel : map.texels) ASSERT_LT(unpacked(texel)[0], 0.21) << "the disc is gone";
    const Double3 direction = {sun->direction.x, sun->direction.y, sun->direction.z};
    for (const Double3& normal : {Double3{0, 1, 0}, direction, Double3{0.6, 0.8, 0}}) {
      const Rgb whole = irradianceOf(before, normal), sky = irradianceOf(map, normal);
      const double facing = std::numbers::pi * std::max(dotOf(normal, direction), 0.0);
      if (facing < 0.1) continue;  // a disc that is partly below the surface's horizon
      const double light[] = {sun->light.x, sun->light.y, sun->light.z};
      for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(sky[c] + facing * light[c], whole[c], 0.01 * whole[c]) << to.x << " " << to.y;
    }
  }
}

TEST(EnvironmentSunTest, OtherPicturesHaveNone) {
  EXPECT_FALSE(findSun(picture(64, [](uint32_t, uint32_t) { return Rgb{1, 1, 1}; })));
  EXPECT_FALSE(findSun(picture(64, [](uint32_t, uint32_t) { return Rgb{0, 0, 0}; })));
  EXPECT_FALSE(findSun(sunny({0.6, 0.64, -0.48}, 0.4, 3000))) << "a softbox";
  EXPECT_FALSE(findSun(sunny({0.6, 0.64, -0.48}, 3 * kTexel, 1))) << "clipped";
  EXPECT_FALSE(findSun(sunny({0.6, -0.64, -0.48}, 3 * kTexel, 3000))) << "below the horizon";
  EXPECT_FALSE(findSun({}));
  EXPECT_FALSE(findSun({4, 2, {1, 2, 3}}));
}

}  // namespace environment_test
}  // namespace rill::test
