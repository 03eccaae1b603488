#include "faces/ict.h"

#include "core/files.h"
#include "faces/source.h"
#include "tests/faces/template_checks.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;

std::optional<std::filesystem::path> IctArchive() {
  const auto shared = testing::SharedData();
  if (!shared || !std::filesystem::exists(*shared / "ict-facekit.tar.xz")) return std::nullopt;
  return *shared / "ict-facekit.tar.xz";
}

class IctTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (const auto archive = IctArchive()) model_ = new FaceModel(LoadFaceModel({.name = "ict", .path = *archive}));
  }
  static void TearDownTestSuite() {
    delete model_;
    model_ = nullptr;
  }
  void SetUp() override {
    if (model_ == nullptr) GTEST_SKIP() << "ict-facekit.tar.xz is not there; set DAUMIER_SHARED_DATA";
  }

  static FaceModel* model_;
};
FaceModel* IctTest::model_ = nullptr;

TEST_F(IctTest, TemplateIsSound) {
  const FaceTemplate& face = model_->face_template;
  testing::ExpectSoundTopology(face);
  testing::ExpectSoundAnnotation(face);
  testing::ExpectCurvesAreEdgePaths(face);
  testing::ExpectLandmarksOfAFace(face);
}

TEST_F(IctTest, UvIsThatOfTheHead) {
  testing::ExpectUvUnfoldsTheFace(model_->face_template);
}

TEST_F(IctTest, FaceRegionIsFirst) {
  const auto& region = model_->face_template.annotation.regions.at("face");
  for (size_t i = 0; i < region.size(); ++i) ASSERT_EQ(region[i], static_cast<int>(i));
  EXPECT_GT(region.size(), 9000u);
}

TEST_F(IctTest, HeadIsOfHumanSize) {
  const double height_cm = 200 / MillimetresPerCm(model_->face_template);
  EXPECT_GT(height_cm, 15);
  EXPECT_LT(height_cm, 22);
}

TEST_F(IctTest, IdentitiesDifferPlausibly) {
  EXPECT_EQ(model_->identity_controls.size(), 100u);
  Rng rng(4);
  for (int i = 0; i < 5; ++i) {
    const geometry::Points moved = IdentityFace(*model_, DrawIdentity(*model_, rng)) - model_->face_template.neutral;
    const double mean_cm = moved.rowwise().norm().mean();
    EXPECT_GT(mean_cm, 0.1);
    EXPECT_LT(mean_cm, 2.5);
  }
}

TEST_F(IctTest, ExpressionsAreDistinct) {
  ASSERT_EQ(model_->expressions.size(), 25u);
  for (size_t a = 0; a < 25; ++a) {
    const Eigen::VectorXf offset = ExpressionOffset(*model_, model_->expressions[a].weights);
    EXPECT_EQ(offset.isZero(), a == 0) << model_->expressions[a].name;
    EXPECT_LT(offset.cwiseAbs().maxCoeff(), 8) << model_->expressions[a].name;
    for (size_t b = 0; b < a; ++b) {
      const Eigen::VectorXf other = ExpressionOffset(*model_, model_->expressions[b].weights);
      EXPECT_GT((offset - other).cwiseAbs().maxCoeff(), 0.3)
          << model_->expressions[a].name << " " << model_->expressions[b].name;
    }
  }
}

TEST(Ict, TruncatedArchiveIsRefused) {
  const auto archive = IctArchive();
  if (!archive) GTEST_SKIP() << "ict-facekit.tar.xz is not there; set DAUMIER_SHARED_DATA";
  const testing::TempDir directory;
  WriteFileAtomically(directory / "cut.tar.xz", MappedFile(*archive).bytes().substr(0, 600'000));
  ExpectError([&] { LoadIct(directory / "cut.tar.xz"); }, "truncated");
}

TEST(Ict, MissingAndForeignDataAreRefused) {
  const testing::TempDir directory;
  ExpectError([&] { LoadIct(directory / "nowhere"); }, "does not exist");
  ExpectError([&] { LoadIct(directory.path()); }, "generic_neutral_mesh.obj");
  MakeDirectory(directory / "FaceXModel");
  WriteFileAtomically(directory / "FaceXModel/generic_neutral_mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ExpectError([&] { LoadIct(directory.path()); }, "has 3 vertices, ICT-FaceKit Light has 26719");
}

}  // namespace
}  // namespace daumier::faces
