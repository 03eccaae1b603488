#include "fitting/palette_texture.h"

#include "faces/appearance/skin_fields.h"
#include "rig/material_colours.h"
#include "tests/rig/named_model.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

class PaletteTextureTest : public ::testing::Test {
 protected:
  static constexpr int kSize = 128;

  Eigen::Vector3f At(const render::Image& texture, int texel) const {
    const uint8_t* rgb = &texture.pixels[3 * size_t(texel)];
    return Eigen::Vector3f(rgb[0], rgb[1], rgb[2]) / 255;
  }

  const faces::FaceModel model_ = daumier::testing::NamedModel();
  const rig::HeadRig rig_{model_.face_template};
  const rig::TexelMap texels_ = rig_.texture_space().Rasterise(kSize);
  const HeadPalette palette_ = {
      .skin = {0.5F, 0.4F, 0.3F}, .lips = {0.8F, 0.1F, 0.1F}, .brows = {0.1F, 0.1F, 0.4F}, .iris = {0.1F, 0.6F, 0.2F}};
  const render::Image texture_ = PaletteTexture(rig_, model_.face_template, palette_, kSize);
};

TEST_F(PaletteTextureTest, HasTheColourOfEachMaterial) {
  int num_irises = 0, num_teeth = 0;
  for (int texel = 0; texel < texels_.num_texels(); ++texel) {
    const int triangle = texels_.triangles[size_t(texel)];
    if (triangle < 0) continue;
    const faces::HeadMaterial material = rig_.texture_space().materials[size_t(triangle)];
    if (material == faces::HeadMaterial::kIris) {
      EXPECT_LT((At(texture_, texel) - palette_.iris).norm(), 0.01F);
      ++num_irises;
    }
    if (material == faces::HeadMaterial::kTooth) {
      EXPECT_LT((At(texture_, texel) - rig::MaterialColour(material)).norm(), 0.01F);
      ++num_teeth;
    }
  }
  EXPECT_GT(num_irises, 0);
  EXPECT_GT(num_teeth, 0);
}

TEST_F(PaletteTextureTest, PaintsLipsWhereTheFaceHasThem) {
  const Eigen::VectorXd lips = faces::SkinField(model_.face_template, "lips");
  Eigen::Vector3f of_lips = Eigen::Vector3f::Zero(), of_others = Eigen::Vector3f::Zero();
  int num_lips = 0, num_others = 0;
  for (int texel = 0; texel < texels_.num_texels(); ++texel) {
    const int triangle = texels_.triangles[size_t(texel)];
    if (triangle < 0 || rig_.texture_space().materials[size_t(triangle)] != faces::HeadMaterial::kSkin) continue;
    double least = 1, most = 0;
    for (int i = 0; i < 3; ++i) {
      const int finished = rig_.texture_space().triangles(triangle, i);
      if (finished >= int(rig_.finished_vertices().size())) continue;
      const int v = rig_.finished_vertices()[size_t(finished)];
      if (v >= lips.size()) continue;
      least = std::min(least, lips[v]);
      most = std::max(most, lips[v]);
    }
    if (most < least) continue;
    if (least > 0.99) {
      of_lips += At(texture_, texel);
      ++num_lips;
    } else if (most < 0.01) {
      of_others += At(texture_, texel);
      ++num_others;
    }
  }
  ASSERT_GT(num_others, 100);
  EXPECT_LT((of_others / float(num_others) - palette_.skin).norm(), 0.12F) << "but for blush, brows and lids";
  ASSERT_GT(num_lips, 0);
  EXPECT_LT((of_lips / float(num_lips) - palette_.lips).norm(), 0.02F);
}

TEST_F(PaletteTextureTest, FillsGuttersAndIsDeterministic) {
  EXPECT_EQ(PaletteTexture(rig_, model_.face_template, palette_, kSize), texture_);
  const std::vector<int> nearest = rig::NearestShownTexels(texels_, 1);
  for (int texel = 0; texel < texels_.num_texels(); ++texel)
    if (nearest[size_t(texel)] >= 0) {
      EXPECT_EQ(At(texture_, texel), At(texture_, nearest[size_t(texel)]));
    }
}

}  // namespace
}  // namespace daumier::fitting
