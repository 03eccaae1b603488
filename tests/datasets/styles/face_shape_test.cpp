#include "datasets/styles/face_shape.h"

#include "core/files.h"
#include "faces/face_database.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

using testing::TempDir;

class FaceShapeTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 2);
    SketchesOptions options;
    options.faces = (*folder_ / "faces").string();
    options.turned = {.count = 2, .least = 25, .greatest = 45};
    BuildSketches(options, *folder_ / "sketches");
    sketches_ = new SketchDatabase(*folder_ / "sketches");
  }
  static void TearDownTestSuite() {
    delete sketches_;
    delete folder_;
  }

  static Eigen::Vector2d Landmark(int face, int view, size_t i) {
    const auto point = sketches_->facts(face, view).landmarks[i];
    return {point[0], point[1]};
  }

  static inline TempDir* folder_ = nullptr;
  static inline SketchDatabase* sketches_ = nullptr;
};

TEST_F(FaceShapeTest, MarkedPlacesLieAtTheLandmarks) {
  for (const int face : {0, 3, 9}) {
    const FaceShape shape = ShapeOf(*sketches_, face);
    EXPECT_EQ(shape.view, faces::DrawnView::kFront);
    EXPECT_LT((shape.eyes[0].upper.front() - Landmark(face, 0, 36)).norm(), 1);
    EXPECT_LT((shape.eyes[1].upper.back() - Landmark(face, 0, 42)).norm(), 1);
    EXPECT_LT((shape.mouth.top.front() - Landmark(face, 0, 48)).norm(), 1);
    EXPECT_LT((shape.mouth.top[8] - Landmark(face, 0, 51)).norm(), 1);
    EXPECT_LT((shape.mouth.inner_bottom[8] - Landmark(face, 0, 66)).norm(), 1);
    EXPECT_LT((shape.nose.base[NoseShape::kBaseMiddle] - Landmark(face, 0, 33)).norm(), 1);
    EXPECT_LT((shape.brows[0].upper.front() - Landmark(face, 0, 17)).norm(), 1);
    EXPECT_NEAR(shape.unit, (Landmark(face, 0, 36) - Landmark(face, 0, 45)).norm(), 1e-4);
  }
}

TEST_F(FaceShapeTest, LinesHaveTheirNumbersOfPoints) {
  const FaceShape shape = ShapeOf(*sketches_, 0);
  EXPECT_EQ(shape.outline.size(), size_t(FaceShape::kOutlinePoints));
  EXPECT_EQ(shape.skull.size(), size_t(FaceShape::kSkullPoints));
  EXPECT_EQ(shape.eyes[0].upper.size(), size_t(EyeShape::kPoints));
  EXPECT_EQ(shape.eyes[1].lower.size(), size_t(EyeShape::kPoints));
  EXPECT_EQ(shape.brows[1].lower.size(), size_t(BrowShape::kPoints));
  EXPECT_EQ(shape.mouth.bottom.size(), size_t(MouthShape::kPoints));
  EXPECT_LT(shape.outline.front().x(), shape.outline.back().x());
  const auto lowest = std::max_element(shape.outline.begin(), shape.outline.end(),
                                       [](const auto& a, const auto& b) { return a.y() < b.y(); });
  EXPECT_LT((*lowest - shape.outline[size_t(shape.chin)]).norm(), 8);
}

TEST_F(FaceShapeTest, OpenMouthsAreToldByTheirGap) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  for (int face = 0; face < faces.num_grid_faces(); ++face) {
    const float gap = sketches_->facts(face).gaps_mm[2];
    EXPECT_EQ(ShapeOf(*sketches_, face).mouth.is_open, gap > kClosedLipsMm);
  }
}

TEST_F(FaceShapeTest, TurnedViewsSayWhereTheyLook) {
  ASSERT_EQ(sketches_->num_turned_views(), 2);
  for (int face = 0; face < 4; ++face) {
    for (int view = 1; view < 3; ++view) {
      const double yaw = sketches_->facts(face, view).yaw;
      const FaceShape shape = ShapeOf(*sketches_, face, view);
      EXPECT_EQ(shape.view, yaw < 0 ? faces::DrawnView::kThreeQuarterLeft : faces::DrawnView::kThreeQuarterRight);
      EXPECT_FALSE(shape.nose.contour.empty());
    }
  }
}

TEST_F(FaceShapeTest, MovedPointsMoveAllLines) {
  FaceShape shape = ShapeOf(*sketches_, 0);
  const FaceShape before = shape;
  MovePoints(shape, [](const Eigen::Vector2d& p) { return Eigen::Vector2d(p + Eigen::Vector2d(3, -2)); });
  EXPECT_LT((shape.mouth_middle() - before.mouth_middle() - Eigen::Vector2d(3, -2)).norm(), 1e-9);
  EXPECT_LT((shape.eyes_middle - before.eyes_middle - Eigen::Vector2d(3, -2)).norm(), 1e-9);
  EXPECT_EQ(shape.head().size(), before.head().size());
}

TEST_F(FaceShapeTest, SketchesOfVersionOneSayWhatTheyLack) {
  const auto old = *folder_ / "old";
  std::filesystem::copy(*folder_ / "sketches", old, std::filesystem::copy_options::recursive);
  Manifest manifest = ReadManifest(old, "sketches");
  manifest.details.erase("version");
  WriteManifest(old, manifest);
  const SketchDatabase sketches(old);
  EXPECT_FALSE(sketches.has_facts());
  EXPECT_EQ(sketches.curve_points(0), sketches_->curve_points(0));
  testing::ExpectError([&] { ShapeOf(sketches, 0); }, "lack landmarks");
}

}  // namespace
}  // namespace daumier::datasets
