#include "faces/part_exaggeration.h"

#include "geometry/alignment.h"
#include "geometry/flips.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using geometry::Points;

struct PartsOfSubject {
  FaceTemplate face = testing::SyntheticFace();
  FaceParts parts = MakeFaceParts(face, 2);

  Eigen::Index part(const std::string& name) const {
    return std::find(parts.names.begin(), parts.names.end(), name) - parts.names.begin();
  }
  PartStrengths None() const {
    const auto count = static_cast<Eigen::Index>(parts.names.size());
    return {Eigen::VectorXd::Zero(count), Points::Zero(count, 3), {}};
  }
  Points Apply(const PartStrengths& strengths) const {
    return ExaggerateParts(face, parts, face.neutral, strengths, {});
  }
};

TEST(PartExaggeration, NoStrengthReturnsTheInput) {
  const PartsOfSubject subject;
  EXPECT_LT((subject.Apply(subject.None()) - subject.face.neutral).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PartExaggeration, AStretchedPartGrowsInThatDirection) {
  const PartsOfSubject subject;
  PartStrengths strengths = subject.None();
  strengths.log_stretches(subject.part("nose"), 2) = std::log(1.8);
  const Points result = subject.Apply(strengths);
  const auto depth = [&](const Points& points) {  // Of the nose's tip before its root.
    const auto& landmarks = subject.face.annotation.landmarks;
    return points(landmarks[30], 2) - points(landmarks[27], 2);
  };
  EXPECT_GT(depth(result), 1.3 * depth(subject.face.neutral));
}

TEST(PartExaggeration, ABumpMovesTheVerticesNearIt) {
  const PartsOfSubject subject;
  PartStrengths strengths = subject.None();
  const int top = subject.face.annotation.hairline_vertex, chin = subject.face.annotation.landmarks[8];
  strengths.bumps.push_back({.vertex = top, .radius = 1.5, .offset = {0, 0, 1}});
  const Points moves = subject.Apply(strengths) - subject.face.neutral;
  EXPECT_NEAR(moves(top, 2), 1, 0.15) << "cm; the alignment absorbs a little";
  EXPECT_LT(moves.row(chin).norm(), 0.15);
}

TEST(PartExaggeration, TheResultLiesOnTheFaceItCameFrom) {
  const PartsOfSubject subject;
  Rng rng = Stream(4, "parts");
  const Points result = subject.Apply(DrawPartStrengths(subject.face, subject.parts, 0.2, {}, rng));
  Eigen::VectorXd in_face = Eigen::VectorXd::Zero(result.rows());
  for (const int v : subject.face.annotation.regions.at("face")) in_face[v] = 1;
  const geometry::Similarity rest = geometry::AlignSimilarity(result, subject.face.neutral, in_face);
  EXPECT_NEAR(rest.scale, 1, 1e-9);
  EXPECT_LT(rest.translation.norm(), 1e-8);
}

TEST(PartExaggeration, CurvatureOfOnePartLeavesTheOthersAlone) {
  const PartsOfSubject subject;
  PartStrengths strengths = subject.None();
  strengths.gammas[subject.part("chin")] = 0.4;
  const Points result = subject.Apply(strengths);
  const Eigen::VectorXd moves = (result - subject.face.neutral).rowwise().norm();
  const auto& landmarks = subject.face.annotation.landmarks;
  EXPECT_GT(moves[landmarks[8]], 5 * moves[subject.face.annotation.hairline_vertex]);
  EXPECT_GT(moves[landmarks[8]], 0.02);
}

TEST(PartExaggeration, EqualStrengthsOnBothSidesKeepSymmetry) {
  const PartsOfSubject subject;
  Rng rng = Stream(3, "parts");
  const PartStrengths strengths =
      DrawPartStrengths(subject.face, subject.parts, 0.2, {.asymmetry = 0, .num_lumps = 0}, rng);
  const Points result = subject.Apply(strengths);
  double largest = 0;
  for (int v = 0; v < result.rows(); ++v) {
    const geometry::Vector3 other = result.row(subject.face.annotation.mirror[v]);
    largest =
        std::max(largest, (result.row(v).transpose() - geometry::Vector3(-other.x(), other.y(), other.z())).norm());
  }
  EXPECT_LT(largest, 1e-6) << "cm";
}

TEST(PartExaggeration, DrawsAreZeroWithoutGammaAndBoundedWithIt) {
  const PartsOfSubject subject;
  Rng rng = Stream(3, "parts");
  const PartStrengths none = DrawPartStrengths(subject.face, subject.parts, 0.0, {}, rng);
  EXPECT_EQ(none.gammas.cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(none.log_stretches.cwiseAbs().maxCoeff(), 0);
  const PartExaggerationOptions options;
  double largest = 0;
  for (int draw = 0; draw < 50; ++draw) {
    const PartStrengths strengths = DrawPartStrengths(subject.face, subject.parts, 0.2, options, rng);
    EXPECT_LE(strengths.gammas.maxCoeff(), 2 * options.curvature * 0.2);
    EXPECT_EQ(strengths.gammas[subject.part("mouth")], 0);
    EXPECT_EQ(strengths.gammas[subject.part("eye_left")], 0);
    EXPECT_EQ(strengths.gammas[subject.part("jaw_left")], strengths.gammas[subject.part("jaw_right")]);
    largest = std::max(largest, strengths.log_stretches.cwiseAbs().maxCoeff());
  }
  EXPECT_LE(largest, 2 * options.stretch * 0.2 * (1 + options.asymmetry));
  EXPECT_GT(largest, options.stretch * 0.2);
}

TEST(PartExaggeration, NoTriangleFlips) {
  const PartsOfSubject subject;
  for (int draw = 0; draw < 10; ++draw) {
    Rng rng = Stream(5, "parts", draw);
    const Points result = subject.Apply(DrawPartStrengths(subject.face, subject.parts, 0.24, {}, rng));
    EXPECT_EQ(geometry::CountFlippedTriangles(subject.face.neutral, result, subject.face.triangles), 0);
  }
}

TEST(PartExaggeration, RefusesStrengthsOfOtherParts) {
  const PartsOfSubject subject;
  const PartStrengths few{Eigen::VectorXd::Zero(2), Points::Zero(2, 3), {}};
  testing::ExpectError([&] { subject.Apply(few); }, "strengths of 2 and 2 parts, the face has 14");
}

}  // namespace
}  // namespace daumier::faces
