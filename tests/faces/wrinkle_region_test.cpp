#include "faces/wrinkle_region.h"

#include "geometry/normals.h"
#include "geometry/topology.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::faces {
namespace {

bool Holds(const std::vector<int>& sorted, int vertex) {
  return std::binary_search(sorted.begin(), sorted.end(), vertex);
}

TEST(WrinkleRegion, IsTheAnnotationsOwnWhereItHasOne) {
  FaceTemplate face = testing::SyntheticFace();
  face.annotation.regions["wrinkles"] = {3, 5, 8};
  EXPECT_EQ(WrinkleRegion(face, View::kFrontal, 3), (std::vector<int>{3, 5, 8}));
}

TEST(WrinkleRegion, FacesTheViewerAndIsPartOfTheFace) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto frontal = WrinkleRegion(face, View::kFrontal, 3), side = WrinkleRegion(face, View::kSide, 3);
  ASSERT_FALSE(frontal.empty());
  ASSERT_FALSE(side.empty());
  EXPECT_TRUE(std::is_sorted(frontal.begin(), frontal.end()));
  const geometry::Points normals = geometry::VertexNormals({face.neutral, face.triangles});
  const double cosine = std::cos(65 * 3.14159265358979 / 180);
  for (const int vertex : frontal) {
    EXPECT_GE(normals(vertex, 2), cosine);
    EXPECT_TRUE(Holds(face.annotation.regions.at("face"), vertex));
  }
  for (const int vertex : side) EXPECT_LE(normals(vertex, 0), -cosine);
}

TEST(WrinkleRegion, KeepsClearOfFeaturesAndCurves) {
  const FaceTemplate face = testing::SyntheticFace();
  const double cm = 20 / MillimetresPerCm(face);
  const auto region = WrinkleRegion(face, View::kFrontal, 20);
  for (const int vertex : region) {
    for (const char* part : {"eyes", "mouth", "nose", "ears"})
      EXPECT_FALSE(Holds(face.annotation.regions.at(part), vertex)) << part;
    for (const FeatureCurve& curve : face.annotation.curves) {
      if (curve.view != View::kFrontal) continue;
      for (const int other : curve.vertices)
        EXPECT_GE((face.neutral.row(vertex) - face.neutral.row(other)).norm(), cm) << curve.name;
    }
  }
  EXPECT_LT(region.size(), WrinkleRegion(face, View::kFrontal, 0).size());
}

TEST(WrinkleRegion, EndsAtTheSilhouette) {
  // A ring of edges around the nose, annotated as a silhouette, leaves only what it encloses.
  FaceTemplate face = testing::SyntheticFace();
  const auto all = WrinkleRegion(face, View::kFrontal, 0);
  const int tip = face.annotation.landmarks[30];
  const auto neighbours = geometry::VertexNeighbours(face.triangles, face.num_vertices());
  const auto rings = geometry::RingsFrom(neighbours, {tip});
  std::vector<int> barrier;
  for (int v = 0; v < face.num_vertices(); ++v)
    if (rings[size_t(v)] == 5) barrier.push_back(v);
  face.annotation.curves.push_back({"ring", "silhouette", View::kFrontal, false, barrier});
  const auto inner = WrinkleRegion(face, View::kFrontal, 0);
  ASSERT_FALSE(inner.empty());
  EXPECT_LT(inner.size(), all.size());
  for (const int vertex : inner) EXPECT_LT(rings[size_t(vertex)], 5);
}

TEST(WrinkleRegion, AFaceWithoutRegionsIsRefused) {
  FaceTemplate face = testing::SyntheticFace();
  face.annotation.regions.erase("face");
  testing::ExpectError([&] { WrinkleRegion(face, View::kFrontal, 3); }, "face");
}

}  // namespace
}  // namespace daumier::faces
