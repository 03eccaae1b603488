#include "fitting/texture_surface.h"

#include "tests/fitting/small_atlas.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

/// A sheet of which each half may be seen or not.
class CompletedSheet : public ::testing::Test {
 protected:
  TexelColours Seen(const std::function<float(double, double)>& weight,
                    const std::function<Eigen::Vector3f(double, double)>& colour) const {
    TexelColours seen{std::vector<Eigen::Vector3f>(size_t(texels_.num_texels()), Eigen::Vector3f::Zero()),
                      std::vector<float>(size_t(texels_.num_texels()), 0.0F)};
    for (int i = 0; i < texels_.num_texels(); ++i) {
      if (texels_.triangles[size_t(i)] < 0) continue;
      const double x = ((i % texels_.size + 0.5) / texels_.size - 0.5) / 0.4 * sheet_.half;
      const double y = (0.5 - (i / texels_.size + 0.5) / texels_.size) / 0.4 * sheet_.half;
      seen.weights[size_t(i)] = weight(x, y);
      if (seen.weights[size_t(i)] > 0) seen.colours[size_t(i)] = colour(x, y);
    }
    return seen;
  }
  TextureGuide Guide(float scalp) const {
    const Eigen::Index n = sheet_.vertices.rows();
    return {sheet_.mirror,
            Eigen::VectorXf::Constant(n, scalp),
            Eigen::VectorXf::Ones(n),
            Eigen::VectorXf::Zero(n),
            Eigen::VectorXf::Zero(n),
            Eigen::VectorXf::Zero(n)};
  }
  SurfaceTexture Complete(const TexelColours& skin, const TexelColours* hair, float scalp, TextureFill fill,
                          const Eigen::MatrixXf& albedo = {}) const {
    const TextureGuide guide = Guide(scalp);
    return CompleteSurface(sheet_.space, texels_, FindMirroredCorners(sheet_.space, guide.mirror), guide,
                           SurfaceFill(sheet_.space.triangles, int(sheet_.vertices.rows())), skin, hair, albedo, fill);
  }
  size_t At(double x, double y) const { return size_t(sheet_.TexelAt(texels_, x, y)); }

  const Sheet sheet_ = Sheet::Make(12, 6);
  const rig::TexelMap texels_ = sheet_.space.Rasterise(96);
};

Eigen::Vector3f Reddish(double, double y) {
  return {0.7F + 0.02F * float(y), 0.4F, 0.3F};
}
float LeftHalf(double x, double) {
  return x < 0 ? 1.0F : 0.0F;
}

TEST_F(CompletedSheet, KeepsWhatIsSeen) {
  const auto texture = Complete(Seen(LeftHalf, Reddish), nullptr, 0, TextureFill::kSmooth);
  EXPECT_TRUE(texture.colours[At(-3, 2)].isApprox(Reddish(-3, 2), 0.01F));
  EXPECT_EQ(texture.seen[At(-3, 2)], 1);
  EXPECT_EQ(texture.mirrored[At(-3, 2)], 0);
}

TEST_F(CompletedSheet, TakesTheOtherSideWhereThatIsSeen) {
  const auto texture = Complete(Seen(LeftHalf, Reddish), nullptr, 0, TextureFill::kMirrored);
  EXPECT_TRUE(texture.colours[At(3, 4)].isApprox(Reddish(3, 4), 0.02F));
  EXPECT_NEAR(texture.mirrored[At(3, 4)], 1, 1e-5);
  EXPECT_EQ(texture.seen[At(3, 4)], 0);
}

TEST_F(CompletedSheet, MatchesTheToneOfMirrorImages) {
  // The right side is darker by 0.1 and seen in its lower half alone.
  const auto colour = [](double x, double y) -> Eigen::Vector3f {
    return Reddish(x, y) - Eigen::Vector3f::Constant(x > 0 ? 0.1F : 0);
  };
  const auto seen = Seen([](double x, double y) { return x < 0 || y < 0 ? 1.0F : 0.0F; }, colour);
  const auto texture = Complete(seen, nullptr, 0, TextureFill::kSmooth);
  // Harmonic between -0.1 and 0.1 on the two sides: 0.1 (2 / pi) atan(x / y) above an endless sheet's lower half.
  EXPECT_NEAR(texture.colours[At(3, 1)][0], Reddish(3, 1)[0] - 0.08F, 0.04);
}

TEST_F(CompletedSheet, ContinuesSmoothlyWhatNoSideShows) {
  const auto seen = Seen([](double, double y) { return y < -2 ? 1.0F : 0.0F; },
                         [](double, double) { return Eigen::Vector3f(0.6F, 0.5F, 0.4F); });
  const auto texture = Complete(seen, nullptr, 0, TextureFill::kSmooth);
  EXPECT_TRUE(texture.colours[At(0, 5)].isApprox(Eigen::Vector3f(0.6F, 0.5F, 0.4F), 0.01F));
  EXPECT_EQ(texture.seen[At(0, 5)] + texture.mirrored[At(0, 5)], 0);
}

TEST_F(CompletedSheet, WithoutFillHasTheMedianThere) {
  const auto seen = Seen(LeftHalf, [](double, double) { return Eigen::Vector3f(0.6F, 0.5F, 0.4F); });
  const auto texture = Complete(seen, nullptr, 0, TextureFill::kNone);
  EXPECT_TRUE(texture.colours[At(4, 1)].isApprox(Eigen::Vector3f(0.6F, 0.5F, 0.4F), 1e-4F));
  EXPECT_EQ(texture.mirrored[At(4, 1)], 0);
}

TEST_F(CompletedSheet, OfAScalpHasTheHairThatIsSeen) {
  const auto skin = Seen([](double, double y) { return y < -3 ? 1.0F : 0.0F; }, Reddish);
  const auto hair = Seen([](double, double y) { return y > -3 && y < 0 ? 1.0F : 0.0F; },
                         [](double, double) { return Eigen::Vector3f(0.1F, 0.1F, 0.1F); });
  const auto on_scalp = Complete(skin, &hair, 1, TextureFill::kSmooth),
             bald = Complete(skin, nullptr, 1, TextureFill::kSmooth);
  EXPECT_NEAR(on_scalp.colours[At(0, 5)][0], 0.1, 0.02);
  EXPECT_NEAR(on_scalp.colours[At(0, -1)][0], 0.1, 0.01);
  EXPECT_GT(bald.colours[At(0, 5)][0], 0.5) << "skin where the picture shows no hair";
}

TEST_F(CompletedSheet, HasTheShapeOfAnExpectedAlbedoWhereNothingIsSeen) {
  const auto seen = Seen([](double, double y) { return y < -2 ? 1.0F : 0.0F; },
                         [](double, double) { return Eigen::Vector3f(0.3F, 0.3F, 0.3F); });
  Eigen::MatrixXf albedo = Eigen::MatrixXf::Constant(sheet_.vertices.rows(), 3, 0.6F);
  for (Eigen::Index v = 0; v < albedo.rows(); ++v)
    if (sheet_.vertices(v, 1) > 3) albedo(v, 0) = 0.8F;
  const auto texture = Complete(seen, nullptr, 0, TextureFill::kSmooth, albedo);
  EXPECT_NEAR(texture.colours[At(0, 5.5)][0], 0.4F, 0.02F) << "half as bright as expected, as what is seen";
  EXPECT_NEAR(texture.colours[At(0, 5.5)][1], 0.3F, 0.02F);
}

TEST(MedianColour, IsThatOfKnownVertices) {
  VertexValues values{Eigen::MatrixXf::Zero(4, 3), Eigen::VectorXf::Ones(4)};
  values.values.col(0) << 0.1F, 0.3F, 0.9F, 7;
  values.weights[3] = 0;
  EXPECT_EQ(MedianColour(values, Eigen::Vector3f::Ones()), Eigen::Vector3f(0.3F, 0, 0));
  values.weights.setZero();
  EXPECT_EQ(MedianColour(values, Eigen::Vector3f::Ones()), Eigen::Vector3f::Ones());
}

TEST(InlierMeasure, IsOneAtTheMedianAndSmallFarAway) {
  VertexValues known{Eigen::MatrixXf::Constant(9, 3, 0.5F), Eigen::VectorXf::Ones(9)};
  const InlierMeasure measure(known);
  EXPECT_EQ(measure(Eigen::Vector3f::Constant(0.5F)), 1);
  EXPECT_NEAR(measure({0.62F, 0.5F, 0.5F}), 0.25F, 1e-4) << "a deviation away";
  known.weights.setZero();
  EXPECT_EQ(InlierMeasure(known)(Eigen::Vector3f::Zero()), 1);
}

TEST_F(CompletedSheet, OfNothingSeenIsPlainSkin) {
  const auto none = Seen([](double, double) { return 0.0F; }, Reddish);
  const auto texture = Complete(none, nullptr, 0, TextureFill::kSmooth);
  EXPECT_GT(texture.colours[At(0, 0)].minCoeff(), 0.4F);
  testing::ExpectError([&] { Complete({}, nullptr, 0, TextureFill::kSmooth); }, "0 weights");
}

}  // namespace
}  // namespace daumier::fitting
