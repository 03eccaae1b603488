#include "faces/controls/soft_region.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::faces {
namespace {

using geometry::Vector3;

TEST(SoftRegion, IsAHalfOneRadiusFromASinglePoint) {
  FaceTemplate face = testing::SyntheticFace();
  const double span = EyeSpan(face);
  const int tip = face.annotation.landmarks[30];
  const SoftRegion region{{{{30}}}, Vector3(0.2, 0.4, 0.8)};
  const Vector3 centre = face.neutral.row(tip);
  // Vertices are put where the weight is known: 1, 2^-1, 2^-1, 2^-4.
  const int a = 0, b = 1, c = 2;
  face.neutral.row(a) = (centre + span * Vector3(0.2, 0, 0)).transpose();
  face.neutral.row(b) = (centre + span * Vector3(0, -0.4, 0)).transpose();
  face.neutral.row(c) = (centre + span * Vector3(0, 0, 1.6)).transpose();
  const Eigen::VectorXd weights = WeightsOf(region, face);
  EXPECT_NEAR(weights[tip], 1, 1e-12);
  EXPECT_NEAR(weights[a], 0.5, 1e-12);
  EXPECT_NEAR(weights[b], 0.5, 1e-12);
  EXPECT_NEAR(weights[c], 1.0 / 16, 1e-12);
}

TEST(SoftRegion, ARampRisesFromZeroToOneAlongItsDirection) {
  const FaceTemplate face = testing::SyntheticFace();
  const double span = EyeSpan(face);
  const Anchor chin{{8}};
  const SoftRegion region{.ramps = {{{chin}, {0, 1, 0}, 1.0}}};
  const Eigen::VectorXd weights = WeightsOf(region, face);
  const double start = PositionOf(chin, face, face.neutral).y();
  for (int v = 0; v < face.num_vertices(); ++v) {
    const double t = (face.neutral(v, 1) - start) / span;
    if (t <= 0) {
      EXPECT_EQ(weights[v], 0);
    } else if (t >= 1) {
      EXPECT_EQ(weights[v], 1);
    } else {
      EXPECT_NEAR(weights[v], 10 * std::pow(t, 3) - 15 * std::pow(t, 4) + 6 * std::pow(t, 5), 1e-12);
    }
  }
}

TEST(SoftRegion, InfiniteRadiiMakeASlab) {
  const FaceTemplate face = testing::SyntheticFace();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const SoftRegion slab{{{{30}}}, Vector3(kInfinity, 0.3, kInfinity)};
  const Eigen::VectorXd weights = WeightsOf(slab, face);
  const double height = face.neutral(face.annotation.landmarks[30], 1), span = EyeSpan(face);
  for (int v = 0; v < face.num_vertices(); v += 7)
    EXPECT_NEAR(weights[v], std::exp2(-std::pow((face.neutral(v, 1) - height) / (0.3 * span), 2)), 1e-12);
}

TEST(SoftRegion, TheMirroredRegionHasTheMirroredWeights) {
  const FaceTemplate face = testing::SyntheticFace();
  const SoftRegion left{{{{45}, {0.1, -0.05, 0}}, {{54}}}, {0.2, 0.2, 0.3}, {{{{{27}, {0.1, 0, 0}}}, {1, 0, 0}, 0.3}}};
  const Eigen::VectorXd of_left = WeightsOf(left, face), of_right = WeightsOf(Mirrored(left), face);
  EXPECT_LT((of_left - of_right(face.annotation.mirror)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(of_left.maxCoeff(), 0.5);
}

TEST(SoftRegion, AnAnnotatedRegionIsSmoothedAndHasToExist) {
  FaceTemplate face = testing::SyntheticFace();
  const SoftRegion ears{.annotated = "ears"};
  const Eigen::VectorXd weights = WeightsOf(ears, face);
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_LE(weights.maxCoeff(), 1);
  EXPECT_GT(weights(face.annotation.regions.at("ears")).mean(), 0.3);
  face.annotation.regions.erase("ears");
  testing::ExpectError([&] { WeightsOf(ears, face); }, "ears");
}

TEST(SoftRegion, AnAnchorIsAMeanOfLandmarksWithAnOffsetInEyeSpans) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto& landmarks = face.annotation.landmarks;
  const Vector3 expected = (face.neutral.row(landmarks[8]) + face.neutral.row(face.annotation.hairline_vertex)) / 2;
  const Anchor anchor{{8, kHairlineAnchor}, {0.1, 0, 0}};
  EXPECT_LT((PositionOf(anchor, face, face.neutral) - expected - Vector3(0.1 * EyeSpan(face), 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace daumier::faces
