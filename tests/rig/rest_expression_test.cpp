#include "rig/rest_expression.h"

#include "faces/face_model_file.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::rig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Landmarks at the origin but for those of a mouth of width 4 and eyes 8 apart; the inner lips are `gap` apart.
geometry::Points MouthFace(double gap, double rise) {
  geometry::Points face = geometry::Points::Zero(68, 3);
  face.row(36) << -4, 6, 0;
  face.row(45) << 4, 6, 0;
  face.row(48) << -2, rise, 0;
  face.row(54) << 2, rise, 0;
  face.row(51) << 0, 0.5, 1;
  face.row(57) << 0, -0.5, 1;
  face.row(60) << -1.5, rise, 0;
  face.row(64) << 1.5, rise, 0;
  for (const auto& [upper, lower] : {std::pair(61, 67), std::pair(62, 66), std::pair(63, 65)}) {
    face(upper, 1) = 0.5 * gap;
    face(lower, 1) = -0.5 * gap;
  }
  return face;
}

std::array<int, 68> LandmarksInOrder() {
  std::array<int, 68> landmarks{};
  for (int l = 0; l < 68; ++l) landmarks[size_t(l)] = l;
  return landmarks;
}

TEST(MeasureRest, IsWhatIsWorkedOutByHand) {
  const RestExpression rest = MeasureRest(MouthFace(0.6, 0.1), LandmarksInOrder());
  EXPECT_NEAR(rest.lip_gap, 0.6 / 3, 1e-12);
  EXPECT_NEAR(rest.corner_rise, 0.1 / 4, 1e-12);
  EXPECT_NEAR(rest.mouth_width, 4.0 / 8, 1e-12);
  const RestExpression larger = MeasureRest(7 * MouthFace(0.6, 0.1), LandmarksInOrder());
  EXPECT_NEAR(larger.lip_gap, rest.lip_gap, 1e-12);
  EXPECT_NEAR(larger.corner_rise, rest.corner_rise, 1e-12);
}

TEST(WarningsOf, NameOpenAndSmilingMouths) {
  EXPECT_EQ(WarningsOf({.lip_gap = 0.1, .corner_rise = 0.1, .mouth_width = 0.6}), std::vector<std::string>());
  EXPECT_EQ(WarningsOf({.lip_gap = 0.1, .corner_rise = -0.1, .mouth_width = 0.8}), std::vector<std::string>());
  EXPECT_THAT(
      WarningsOf({.lip_gap = 0.2, .corner_rise = 0.04, .mouth_width = 0.7}),
      ElementsAre(HasSubstr("open at rest (the lips are 0.20 of its width apart"), HasSubstr("seems to smile")));
}

/// On the shipped model, whose persons are neutral by definition.
TEST(WarningsOf, OfPersonsAreFewAndOfGrinsAndOpenMouthsAreThere) {
  const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
  const auto& landmarks = model.face_template.annotation.landmarks;
  Rng rng(1);
  int num_warned = 0;
  for (int i = 0; i < 200; ++i)
    num_warned +=
        int(WarningsOf(MeasureRest(faces::IdentityFace(model, faces::DrawIdentity(model, rng)), landmarks)).size());
  EXPECT_LE(num_warned, 1);
  const auto warnings = [&](const char* name) {
    const auto& expression = *std::ranges::find(model.expressions, name, &faces::Expression::name);
    const Eigen::VectorXd offset = faces::ExpressionOffset(model, expression.weights).cast<double>();
    return WarningsOf(
        MeasureRest(model.face_template.neutral +
                        Eigen::Map<const geometry::Points>(offset.data(), model.face_template.num_vertices(), 3),
                    landmarks));
  };
  EXPECT_EQ(warnings("neutral"), std::vector<std::string>());
  EXPECT_THAT(warnings("smile"), ElementsAre(HasSubstr("seems to smile")));
  EXPECT_THAT(warnings("mouth_open"), ElementsAre(HasSubstr("open at rest")));
  EXPECT_THAT(warnings("gleeful"), ElementsAre(HasSubstr("open at rest"), HasSubstr("seems to smile")));
}

}  // namespace
}  // namespace daumier::rig
