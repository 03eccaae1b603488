#include "faces/import/facescape.h"

#include "tests/faces/import/foreign_face.h"
#include "tests/faces/import/foreign_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::BytesOf;
using testing::ExpectError;
using testing::ForeignMesh;
using testing::Npy;

constexpr int kNumExpressions = 3, kIdentities = 2;

/// The core C(m, e, k) whose face of the mean identity (2, 1) in expression e is the small head (mm) + 10 e in entry e:
/// C_e1 = 5 e in entry e, and C_e0 half of what is left.
std::map<std::string, std::string> FaceScapeArrays() {
  const geometry::PolygonMesh mesh = ForeignMesh(0, 0.1);
  const auto num_coordinates = mesh.vertices.size();
  std::vector<double> core;
  for (Eigen::Index m = 0; m < num_coordinates; ++m) {
    for (int e = 0; e < kNumExpressions; ++e) {
      const double lift = m == e ? 10.0 * e : 0, second = 0.5 * lift + (m == 7 ? 3 : 0);
      core.push_back((mesh.vertices.data()[m] + lift - second) / 2);
      core.push_back(second);
    }
  }
  const geometry::Triangles triangles = geometry::Triangulate(mesh);
  std::vector<int64_t> corners;
  for (Eigen::Index k = 0; k < triangles.size(); ++k) corners.push_back(triangles.data()[k] + 1);
  return {{"shape_bm_core",
           Npy("<f8", fmt::format("{}, {}, {}", num_coordinates, kNumExpressions, kIdentities), BytesOf(core))},
          {"id_mean", Npy("<f8", "2,", BytesOf<double>({2, 1}))},
          {"id_var", Npy("<f8", "2,", BytesOf<double>({4, 9}))},
          {"fv_indices", Npy("<i8", fmt::format("{}, 3", triangles.rows()), BytesOf(corners))}};
}

TEST(FaceScape, CoreIsLinearisedAtTheMeanIdentity) {
  const testing::TempDir folder;
  testing::WriteNpz(folder / "fs.npz", FaceScapeArrays());
  const FaceModel model = LoadFaceScape(folder / "fs.npz", testing::ForeignAnnotation());
  EXPECT_LT((model.face_template.neutral - ForeignMesh().vertices).cwiseAbs().maxCoeff(), 1e-6);
  ASSERT_EQ(model.identity_shapes.cols(), kIdentities);
  EXPECT_NEAR(model.identity_shapes(7, 1), 0.9, 1e-6);  // 3 mm by a standard deviation of 3.
  ASSERT_EQ(model.expressions.size(), 3u);
  EXPECT_EQ(model.expressions[2].name, "shape_02");
  const Eigen::VectorXf offset = ExpressionOffset(model, model.expressions[2].weights);
  EXPECT_NEAR(offset[2], 2, 1e-5);
  EXPECT_NEAR(offset.norm(), 2, 1e-4);
}

TEST(FaceScape, WhatDoesNotFitIsRefused) {
  const testing::TempDir folder;
  const auto path = folder / "fs.npz";
  const auto refused = [&](const std::string& array, const std::string& bytes, const std::string& part) {
    auto arrays = FaceScapeArrays();
    arrays[array] = bytes;
    testing::WriteNpz(path, arrays);
    ExpectError([&] { LoadFaceScape(path, testing::ForeignAnnotation()); }, part);
  };
  refused("id_mean", Npy("<f8", "3,", BytesOf<double>({1, 2, 3})), "id_mean has the shape (3)");
  refused("id_var", Npy("<f8", "2,", BytesOf<double>({1, -1})), "id_var is negative");
  refused("shape_bm_core", Npy("<f8", "2, 2", BytesOf<double>({1, 2, 3, 4})), "expected (3V, expressions, identities)");
  refused("fv_indices", Npy("<i8", "1, 3", BytesOf<int64_t>({0, 1, 2})), "corner 0");
  auto arrays = FaceScapeArrays();
  arrays.erase("id_var");
  testing::WriteNpz(folder / "less.npz", arrays);
  ExpectError([&] { LoadFaceScape(folder / "less.npz", testing::ForeignAnnotation()); }, "has no array 'id_var'");
}

}  // namespace
}  // namespace daumier::faces
