#include "rig/lid_edges.h"

#include "faces/face_holes.h"
#include "faces/face_model_file.h"
#include "rig/arkit_names.h"
#include "rig/source_shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::rig {
namespace {

TEST(LidEdges, OfLidsWithoutThicknessAreTheHole) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const std::vector<int> hole = faces::FindHoles(face).eye_left;
  const SeamEdges edges = FindLidEdges(face, hole, face.neutral);
  std::set<int> vertices(edges.upper.begin(), edges.upper.end());
  vertices.insert(edges.lower.begin(), edges.lower.end());
  EXPECT_EQ(vertices, std::set<int>(hole.begin(), hole.end()));
  EXPECT_EQ(edges.upper.front(), edges.lower.front());
  EXPECT_EQ(edges.upper.back(), edges.lower.back());
  EXPECT_LT(face.neutral(edges.upper.front(), 0), face.neutral(edges.upper.back(), 0));
}

TEST(LidEdges, OfIctLieInFrontOfTheHole) {
  const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
  const faces::FaceTemplate& face = model.face_template;
  geometry::Points closed = face.neutral;
  const Eigen::VectorXd blink = ArkitShapesOf(model).shapes.col(*FindArkitName("eyeBlinkLeft")).cast<double>();
  Eigen::Map<Eigen::VectorXd>(closed.data(), closed.size()) += blink;
  const std::vector<int> hole = faces::FindHoles(face).eye_left;
  const SeamEdges edges = FindLidEdges(face, hole, closed);
  const auto depth = [&](const std::vector<int>& vertices) {
    double sum = 0;
    for (const int v : vertices) sum += face.neutral(v, 2);
    return sum / double(vertices.size());
  };
  EXPECT_GT(depth(edges.upper), depth(hole) + 0.1) << "cm";
  for (const int v : edges.upper) EXPECT_EQ(std::ranges::count(hole, v), 0);
}

TEST(LidEdges, NeedALoop) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  testing::ExpectError([&] { FindLidEdges(face, {1, 2, 3}, face.neutral); }, "has 3 vertices, expected 4 or more");
}

}  // namespace
}  // namespace daumier::rig
