#include "faces/face_parts.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

int IndexOf(const FaceParts& parts, const std::string& name) {
  return static_cast<int>(std::find(parts.names.begin(), parts.names.end(), name) - parts.names.begin());
}

TEST(FaceParts, LandmarksLieInTheirParts) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceParts parts = MakeFaceParts(face, 1);
  const auto strongest = [&](int vertex) {
    Eigen::Index part = 0;
    parts.weights.row(vertex).maxCoeff(&part);
    return parts.names[part];
  };
  const auto at = [&](int landmark) { return strongest(face.annotation.landmarks[landmark]); };
  EXPECT_EQ(at(30), "nose");
  EXPECT_EQ(at(8), "chin");
  EXPECT_EQ(at(51), "mouth");
  EXPECT_EQ(at(12), "jaw_left");
  EXPECT_EQ(at(4), "jaw_right");
  EXPECT_EQ(at(24), "brow_left");
  EXPECT_EQ(at(37), "eye_right");
  EXPECT_EQ(strongest(face.annotation.hairline_vertex), "forehead");
}

TEST(FaceParts, WeightsAreSymmetricAndSumToOneInsideTheFace) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceParts parts = MakeFaceParts(face, 2);
  EXPECT_GE(parts.weights.minCoeff(), 0);
  EXPECT_LE(parts.weights.rowwise().sum().maxCoeff(), 1 + 1e-12);
  EXPECT_NEAR(parts.weights.row(face.annotation.landmarks[30]).sum(), 1, 1e-12);
  for (const int v : face.annotation.regions.at("neck_border")) EXPECT_LT(parts.weights.row(v).sum(), 0.5);
  for (int v = 0; v < face.num_vertices(); ++v) {
    for (size_t p = 0; p < parts.names.size(); ++p)
      EXPECT_EQ(parts.weights(v, p), parts.weights(face.annotation.mirror[v], parts.mirror[p]));
  }
}

TEST(FaceParts, EveryPartHasAMirrorAndSomeSurface) {
  const FaceParts parts = MakeFaceParts(testing::SyntheticFace(), 1);
  ASSERT_EQ(parts.names, FacePartNames());
  for (size_t p = 0; p < parts.names.size(); ++p) {
    EXPECT_EQ(parts.mirror[parts.mirror[p]], static_cast<int>(p));
    EXPECT_GT(parts.weights.col(Eigen::Index(p)).sum(), 1) << parts.names[p];
  }
  EXPECT_EQ(parts.mirror[IndexOf(parts, "jaw_left")], IndexOf(parts, "jaw_right"));
  EXPECT_EQ(parts.mirror[IndexOf(parts, "chin")], IndexOf(parts, "chin"));
}

TEST(FaceParts, NamesTheRegionThatIsMissing) {
  FaceTemplate face = testing::SyntheticFace();
  face.annotation.regions.erase("nose");
  testing::ExpectError([&] { MakeFaceParts(face, 1); }, "a division into parts needs the region 'nose'");
}

}  // namespace
}  // namespace daumier::faces
