#include "benchmark/shape_model.h"

#include "geometry/alignment.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace daumier::benchmark {
namespace {

class KitShapeModel : public ::testing::Test {
 protected:
  KitShapeModel() {
    faces_.resize(30, 3 * face_model_.face_template.num_vertices());
    Rng rng(3);
    for (Eigen::Index row = 0; row < faces_.rows(); ++row) {
      const geometry::Points face = faces::IdentityFace(face_model_, faces::DrawIdentity(face_model_, rng));
      faces_.row(row) = Eigen::Map<const Eigen::RowVectorXd>(face.data(), face.size()).cast<float>();
    }
  }
  const faces::FaceModel face_model_ = testing::SyntheticModel();
  eval::FaceRows faces_;
};

TEST_F(KitShapeModel, AgreesWithItselfOnSomeVertices) {
  const ShapeModel model(face_model_.face_template, faces_, 8);
  ASSERT_EQ(model.num_numbers(), 8);
  Eigen::VectorXd code = Eigen::VectorXd::LinSpaced(8, -1, 1);
  const std::vector<int> some = {3, 100, 7};
  const geometry::Points all = model.Vertices(code);
  const Eigen::VectorXd positions = model.Positions(code, some);
  for (size_t i = 0; i < some.size(); ++i)
    EXPECT_LT((positions.segment<3>(Eigen::Index(3 * i)) - all.row(some[i]).transpose()).norm(), 1e-12);
  Eigen::VectorXd moved = code;
  moved[2] += 0.5;
  EXPECT_LT((model.Positions(moved, some) - positions - 0.5 * model.Derivative(code, some).col(2)).norm(), 1e-12);
}

/// Faces and their mirror images have a symmetric mean.
TEST_F(KitShapeModel, HasASymmetricMean) {
  const ShapeModel model(face_model_.face_template, faces_, 8);
  const geometry::Points mean = model.Vertices(Eigen::VectorXd::Zero(8));
  const std::vector<int>& mirror = face_model_.face_template.annotation.mirror;
  for (size_t v = 0; v < mirror.size(); ++v) EXPECT_NEAR(mean(Eigen::Index(v), 0), -mean(mirror[v], 0), 1e-4);
}

/// The synthetic model has 12 identity shapes, of which mirror images make at most 24.
TEST_F(KitShapeModel, OfAllComponentsRebuildsAFace) {
  const ShapeModel model(face_model_.face_template, faces_, 24);
  std::vector<int> all(size_t(face_model_.face_template.num_vertices()));
  for (size_t v = 0; v < all.size(); ++v) all[v] = int(v);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.num_numbers());
  const Eigen::MatrixXd rows = model.Derivative(zero, all);
  const Eigen::VectorXd offset = faces_.row(4).transpose().cast<double>() - model.Positions(zero, all);
  const Eigen::MatrixXd gram =
      rows.transpose() * rows + 1e-9 * Eigen::MatrixXd::Identity(model.num_numbers(), model.num_numbers());
  const Eigen::VectorXd code = gram.ldlt().solve(rows.transpose() * offset);
  EXPECT_LT((rows * code - offset).cwiseAbs().maxCoeff(), 0.01);
}

TEST_F(KitShapeModel, IsFittedToPlacesInAnyFrame) {
  const ShapeModel model(face_model_.face_template, faces_, 8);
  const auto& landmarks = face_model_.face_template.annotation.landmarks;
  const std::vector<int> vertices(landmarks.begin(), landmarks.end());
  const Eigen::VectorXd code = Eigen::VectorXd::LinSpaced(8, -1, 1);
  const geometry::Points places = model.Vertices(code)(vertices, Eigen::all);
  const Eigen::VectorXd found = FitShapeToPlaces(model, vertices, places, 1e-3);
  const auto distance = [&](const Eigen::VectorXd& other) {
    return (model.Vertices(other)(vertices, Eigen::all) - places).rowwise().norm().mean();
  };
  EXPECT_LT(distance(found), 0.7 * distance(Eigen::VectorXd::Zero(8)));  // The similarity takes a part, too.
  const geometry::Similarity moved{
      3, Eigen::AngleAxisd(1, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix(), {1, 2, 3}};
  EXPECT_LT((FitShapeToPlaces(model, vertices, moved.Apply(places), 1e-3) - found).norm(), 1e-6);
  EXPECT_LT(FitShapeToPlaces(model, vertices, places, 1e6).norm(), 1e-6) << "the prior alone";
  testing::ExpectError([&] { FitShapeToPlaces(model, {1, 2}, places, 1); }, "68 places of 2 vertices");
}

TEST_F(KitShapeModel, RefusesOneFaceAndOtherCodes) {
  testing::ExpectError([&] { ShapeModel(face_model_.face_template, faces_.topRows(1), 3); }, "expected two or more");
  const ShapeModel model(face_model_.face_template, faces_, 3);
  testing::ExpectError([&] { model.Vertices(Eigen::VectorXd::Zero(4)); }, "a code of 4 numbers, expected 3");
}

}  // namespace
}  // namespace daumier::benchmark
