#include "view/picture_scale.hpp"

#include <gtest/gtest.h>

namespace rill::view {
namespace {

/// Pictures on a machine that takes `fixed` s, and `whole` s more at a scale of 1.
void draw(PictureScale& scale, double fixed, double whole, int pictures) {
  for (int k = 0; k < pictures; ++k) scale.addImage(fixed + whole * scale.scale() * scale.scale());
}

TEST(PictureScale, KeepsFullResolutionWhenFast) {
  PictureScale scale;
  scale.addImage(3);  // shaders are compiled
  draw(scale, 0.01, 0.04, 300);
  EXPECT_EQ(scale.scale(), 1);
}

TEST(PictureScale, LowersResolutionWhenSlowWithoutOscillation) {
  PictureScale scale;
  draw(scale, 0, 0.15, 20);
  EXPECT_EQ(scale.scale(), 0.5) << "0.0375 s";
  for (int k = 0; k < 90; ++k) {
    draw(scale, 0, 0.15, 1);
    EXPECT_EQ(scale.scale(), 0.5);
  }
  draw(scale, 0, 10, 20);
  EXPECT_EQ(scale.scale(), 0.375) << "the least";
}

TEST(PictureScale, RaisesResolutionWhenFastAgain) {
  PictureScale scale;
  draw(scale, 0, 1, 20);
  EXPECT_LT(scale.scale(), 1);
  draw(scale, 0, 0.02, 100);
  EXPECT_EQ(scale.scale(), 1);
}

TEST(PictureScale, KeepsResolutionWhenLoweringDoesNotHelp) {
  PictureScale scale;
  draw(scale, 0.5, 0.01, 20);
  EXPECT_EQ(scale.scale(), 1) << "particles cost the same at any size";
}

}  // namespace
}  // namespace rill::view
