// The synthetic face that other tests use has the properties that its header promises.
#include "tests/support/synthetic_face.h"
#include "tests/support/synthetic_model.h"

#include "geometry/submesh.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::testing {
namespace {

TEST(SyntheticFace, IsASphereWithFourHoles) {
  const faces::FaceTemplate face = SyntheticFace();
  EXPECT_GT(face.num_vertices(), 600);
  EXPECT_LT(face.num_vertices(), 1000);
  EXPECT_EQ(geometry::EulerCharacteristic(face.triangles), -2);
  const auto loops = geometry::BoundaryLoops(face.triangles, face.num_vertices());
  ASSERT_EQ(loops.size(), 4u);
  EXPECT_EQ(loops[0].size(), 36u);
  EXPECT_EQ(loops[1].size(), 16u);
  EXPECT_EQ(loops[2].size(), 12u);
  EXPECT_EQ(loops[3].size(), 12u);
}

TEST(SyntheticFace, IsExactlySymmetric) {
  const faces::FaceTemplate face = SyntheticFace();
  const auto& mirror = face.annotation.mirror;
  EXPECT_EQ(geometry::FindMirror(face.neutral, 1e-12), mirror);
  std::set<std::set<int>> triangles;
  for (const auto& t : face.triangles.rowwise()) triangles.insert({t[0], t[1], t[2]});
  for (const auto& t : face.triangles.rowwise())
    EXPECT_TRUE(triangles.contains({mirror[t[0]], mirror[t[1]], mirror[t[2]]}));
}

TEST(SyntheticFace, ClosesEyesAndMouthAndLeavesTheNeckOpen) {
  const faces::FaceTemplate face = SyntheticFace();
  geometry::Triangles all(face.triangles.rows() + face.closing_triangles.rows(), 3);
  all << face.triangles, face.closing_triangles;
  EXPECT_EQ(geometry::BoundaryLoops(all, face.num_vertices()).size(), 1u);
  EXPECT_EQ(face.num_eye_closing_triangles, 20);
  EXPECT_EQ(face.closing_triangles.rows(), 34);
}

TEST(SyntheticFace, AnnotationIsComplete) {
  const faces::FaceTemplate face = SyntheticFace();
  const faces::Annotation& annotation = face.annotation;
  EXPECT_EQ(std::set<int>(annotation.landmarks.begin(), annotation.landmarks.end()).size(), 68u);
  EXPECT_GE(*std::min_element(annotation.landmarks.begin(), annotation.landmarks.end()), 0);
  for (const char* name : {"face", "eyes", "mouth", "neck_border", "ears", "nose"}) {
    const auto& region = annotation.regions.at(name);
    EXPECT_FALSE(region.empty()) << name;
    EXPECT_TRUE(std::is_sorted(region.begin(), region.end())) << name;
  }
  const geometry::Adjacency neighbours = geometry::VertexNeighbours(face.triangles, face.num_vertices());
  std::set<std::string> names, kinds;
  for (const faces::FeatureCurve& curve : annotation.curves) {
    EXPECT_TRUE(names.insert(curve.name).second) << curve.name;
    kinds.insert(curve.kind);
    for (size_t k = 0; k < curve.vertices.size() - (curve.closed ? 0 : 1); ++k) {
      const auto around = neighbours[curve.vertices[k]];
      EXPECT_NE(std::find(around.begin(), around.end(), curve.vertices[(k + 1) % curve.vertices.size()]), around.end())
          << curve.name;
    }
  }
  EXPECT_EQ(kinds.size(), 10u);
}

TEST(SyntheticFace, ModelHasMovingShapes) {
  const faces::FaceModel model = SyntheticModel();
  EXPECT_EQ(model.identity_shapes.cols(), 12);
  EXPECT_EQ(model.expression_shapes.cols(), 7);
  EXPECT_EQ(model.expressions.size(), 8u);
  EXPECT_EQ(model.expressions[0].name, "neutral");
  EXPECT_GT(model.identity_shapes.colwise().norm().minCoeff(), 0.1f);
  EXPECT_GT(model.expression_shapes.colwise().norm().minCoeff(), 0.1f);
}

}  // namespace
}  // namespace daumier::testing
