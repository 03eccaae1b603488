#include "gltf/palette_texture.h"

#include "rig/material_colours.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::gltf {
namespace {

TEST(PaletteTexture, HasTheColourOfEachMaterialAndRedderLips) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const rig::HeadRig rig(face);
  constexpr int kSize = 256;
  const render::Image picture = PaletteTexture(rig, face, kSize);
  ASSERT_EQ(picture.height, kSize);
  ASSERT_EQ(picture.channels, 3);
  const rig::TextureSpace& space = rig.texture_space();
  const rig::TexelMap texels = space.Rasterise(kSize);
  int num_reddish = 0;
  for (int texel = 0; texel < texels.num_texels(); ++texel) {
    const int triangle = texels.triangles[size_t(texel)];
    if (triangle < 0) continue;
    const faces::HeadMaterial material = space.materials[size_t(triangle)];
    const Eigen::Vector3f colour = rig::MaterialColour(material);
    const int row = texel / kSize, column = texel % kSize;
    if (material == faces::HeadMaterial::kSkin) {
      if (picture.at(row, column, 0) - picture.at(row, column, 1) > 255 * (colour[0] - colour[1]) + 20) ++num_reddish;
      continue;
    }
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_EQ(picture.at(row, column, channel), std::lround(255 * colour[channel]));
  }
  EXPECT_GT(num_reddish, 20);
}

}  // namespace
}  // namespace daumier::gltf
