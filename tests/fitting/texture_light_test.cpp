#include "fitting/texture_light.h"

#include "core/random.h"
#include "tests/fitting/small_atlas.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::fitting {
namespace {

/// The front of a ball of even albedo under a light.
class LitBall : public ::testing::Test {
 protected:
  LitBall() : normals_(400, 3) {
    Rng rng(3);
    for (Eigen::Index v = 0; v < normals_.rows(); ++v) {
      normals_.row(v) << rng.Normal(), rng.Normal(), std::abs(rng.Normal()) + 0.3;
      normals_.row(v).normalize();
    }
  }
  VertexValues Colours(const PortraitLight& light, float albedo) const {
    return {albedo * ShadesOf(normals_, light).replicate(1, 3), Eigen::VectorXf::Ones(normals_.rows())};
  }

  geometry::Points normals_;
  const PortraitLight light_ = {0.15F, -0.05F, 0.06F, 0.05F, 0.02F};
};

TEST_F(LitBall, HasTheLightItWasLitBy) {
  const PortraitLight found = FitLight(normals_, Colours(light_, 0.6F), PortraitLight{}, {.trust = 1e-6});
  const Eigen::VectorXf expected = ShadesOf(normals_, light_), shades = ShadesOf(normals_, found);
  EXPECT_NEAR(shades.mean(), 0.85, 1e-4);
  EXPECT_TRUE((shades / shades.mean()).isApprox(expected / expected.mean(), 0.01F));
}

TEST_F(LitBall, CountsBrowsAndHighlightsLittle) {
  VertexValues colours = Colours(light_, 0.6F);
  for (Eigen::Index v = 0; v < 40; ++v) colours.values.row(v).setConstant(v % 2 == 0 ? 0.05F : 1.0F);
  const Eigen::VectorXf expected = ShadesOf(normals_, light_);
  const Eigen::VectorXf shades = ShadesOf(normals_, FitLight(normals_, colours, PortraitLight{}, {.trust = 1e-6}));
  EXPECT_TRUE((shades / shades.mean()).isApprox(expected / expected.mean(), 0.03F));
}

TEST_F(LitBall, StaysNearTheStartWherePicturesSayLittle) {
  VertexValues one = Colours(PortraitLight{}, 0.6F);
  one.weights.setZero();
  EXPECT_EQ(FitLight(normals_, one, light_), light_) << "nothing is seen";
  one.weights[7] = 1;
  const Eigen::VectorXf start = ShadesOf(normals_, light_),
                        shades = ShadesOf(normals_, FitLight(normals_, one, light_));
  EXPECT_TRUE((shades / shades[7]).isApprox(start / start[7], 0.02F));
}

TEST_F(LitBall, RefusesSizesThatDisagree) {
  testing::ExpectError([&] { FitLight(normals_.topRows(3), Colours(light_, 1), light_); }, "3 normals");
}

TEST(ShadesOf, IsAmbientLightOfZeros) {
  const geometry::Points up = geometry::Vector3::UnitY().transpose();
  EXPECT_NEAR(ShadesOf(up, PortraitLight{})[0], 0.8 * 0.886227, 1e-5);
  EXPECT_EQ(ShadesOf(up, PortraitLight{-3.0F})[0], kLeastShade);
}

TEST(WithContrast, IsAPowerAboutTheMean) {
  const Eigen::VectorXf shades = Eigen::Vector2f(0.85F, 4 * 0.85F);
  EXPECT_TRUE(WithContrast(shades, 1).isApprox(shades, 1e-5F));
  EXPECT_TRUE(WithContrast(shades, 0.5).isApprox(Eigen::Vector2f(0.85F, 2 * 0.85F), 1e-5F));
}

TEST(DivideByShades, DividesKnownColours) {
  const Sheet sheet = Sheet::Make(4, 6);
  const rig::TexelMap texels = sheet.space.Rasterise(64);
  TexelColours colours{std::vector<Eigen::Vector3f>(size_t(texels.num_texels()), Eigen::Vector3f::Constant(0.4F)),
                       std::vector<float>(size_t(texels.num_texels()), 1.0F)};
  const auto known = size_t(sheet.TexelAt(texels, 1, 1)), unknown = size_t(sheet.TexelAt(texels, 2, 1));
  colours.weights[unknown] = 0;
  DivideByShades(sheet.space, texels, Eigen::VectorXf::Constant(sheet.vertices.rows(), 0.8F), colours);
  EXPECT_NEAR(colours.colours[known].x(), 0.5F, 1e-5F);
  EXPECT_EQ(colours.colours[unknown].x(), 0.4F);
}

}  // namespace
}  // namespace daumier::fitting
