#include "faces/import/flame.h"

#include "geometry/triangulate.h"
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

/// The small head as FLAME's arrays, in metres; direction s moves vertex s along x by 1 cm.
std::map<std::string, std::string> FlameArrays(int num_directions) {
  const geometry::Points vertices = ForeignMesh(0, 100).vertices;
  const geometry::Triangles triangles = geometry::Triangulate(ForeignMesh());
  const auto num_vertices = vertices.rows();
  std::vector<double> directions(3 * num_vertices * num_directions);
  for (int s = 0; s < num_directions; ++s) directions[3 * s * num_directions + s] = 0.01;
  return {{"v_template", Npy("<f8", fmt::format("{}, 3", num_vertices),
                             BytesOf(std::vector<double>(vertices.data(), vertices.data() + vertices.size())))},
          {"f", Npy("<u4", fmt::format("{}, 3", triangles.rows()),
                    BytesOf(std::vector<int>(triangles.data(), triangles.data() + triangles.size())))},
          {"shapedirs", Npy("<f8", fmt::format("{}, 3, {}", num_vertices, num_directions), BytesOf(directions))},
          {"J_regressor", Npy("|O", "1,", "pickle")}};
}

TEST(Flame, First300DirectionsAreIdentityTheRestExpression) {
  const testing::TempDir folder;
  testing::WriteNpz(folder / "flame.npz", FlameArrays(305));
  const FaceModel model = LoadFlame(folder / "flame.npz", testing::ForeignAnnotation());
  EXPECT_LT((model.face_template.neutral - ForeignMesh().vertices).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(testing::LowestFirst(model.face_template.triangles),
            testing::LowestFirst(geometry::Triangulate(ForeignMesh())));
  ASSERT_EQ(model.identity_shapes.cols(), 300);
  ASSERT_EQ(model.expression_shapes.cols(), 5);
  EXPECT_NEAR(model.identity_shapes(3 * 299, 299), 1, 1e-5);
  EXPECT_NEAR(model.expression_shapes(3 * 302, 2), 1, 1e-5);
  EXPECT_EQ(model.expressions.size(), 11u);
  EXPECT_EQ(model.face_template.provenance.at("name"), "FLAME");
}

TEST(Flame, ShortModelsHaveNoExpression) {
  const testing::TempDir folder;
  testing::WriteNpz(folder / "flame.npz", FlameArrays(10));
  const FaceModel model = LoadFlame(folder / "flame.npz", testing::ForeignAnnotation());
  EXPECT_EQ(model.identity_shapes.cols(), 10);
  EXPECT_EQ(model.expressions.size(), 1u);
}

TEST(Flame, WhatDoesNotFitIsRefused) {
  const testing::TempDir folder;
  const auto path = folder / "flame.npz";
  const auto refused = [&](const std::string& array, const std::string& bytes, const std::string& part) {
    auto arrays = FlameArrays(2);
    arrays[array] = bytes;
    testing::WriteNpz(path, arrays);
    ExpectError([&] { LoadFlame(path, testing::ForeignAnnotation()); }, part);
  };
  refused("shapedirs", Npy("|O", "1,", "pickle"), "shapedirs: holds Python objects");
  refused("shapedirs", Npy("<f4", "5, 3, 1", std::string(60, '\0')), "shapedirs has the shape (5, 3, 1)");
  refused("v_template", Npy("<f4", "5, 2", std::string(40, '\0')), "v_template has the shape (5, 2)");
  refused("f", Npy("<i4", "1, 3", BytesOf<int>({0, 1, 1000000})), "corner 1000000");
  EXPECT_THROW(LoadFlame("generic_model.pkl", testing::ForeignAnnotation()), UsageError);
  ExpectError([&] { LoadFlame(folder / "none.npz", testing::ForeignAnnotation()); }, "does not exist");
}

}  // namespace
}  // namespace daumier::faces
