#include "rig/visemes.h"

#include "rig/arkit_names.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(Visemes, AreFifteenOfExpressionsThatExist) {
  EXPECT_EQ(Visemes().size(), size_t(kNumVisemes));
  EXPECT_EQ(Visemes().front().name, "viseme_sil");
  EXPECT_TRUE(Visemes().front().parts.empty());
  for (const Viseme& viseme : Visemes()) {
    for (const VisemePart& part : viseme.parts) {
      const auto index = FindArkitName(part.expression);
      ASSERT_TRUE(index.has_value()) << part.expression;
      EXPECT_EQ(ArkitNames()[size_t(*index)], part.expression);
      EXPECT_GT(part.weight, 0);
      EXPECT_LE(part.weight, 1);
    }
  }
}

TEST(Visemes, BothSidesMoveAlike) {
  for (const Viseme& viseme : Visemes()) {
    for (const VisemePart& part : viseme.parts) {
      const std::string_view partner = ArkitNames()[size_t(ArkitPartner(*FindArkitName(part.expression)))];
      const auto other = std::ranges::find(viseme.parts, partner, &VisemePart::expression);
      ASSERT_NE(other, viseme.parts.end()) << viseme.name << " lacks " << partner;
      EXPECT_EQ(other->weight, part.weight);
    }
  }
}

TEST(Visemes, AreSumsOfTheColumnsThatTheyName) {
  const MorphTargets expressions{{"mouthFunnel", "jawOpen", "tongueOut"}, Eigen::MatrixXf::Identity(3, 3)};
  const MorphTargets visemes = VisemeTargets(expressions);
  ASSERT_EQ(visemes.num_targets(), kNumVisemes);
  EXPECT_EQ(visemes.names[13], "viseme_O");
  EXPECT_EQ(visemes.offsets.col(13), Eigen::Vector3f(0.6f, 0.45f, 0));  // By hand; the pucker is absent.
  EXPECT_TRUE(visemes.offsets.col(0).isZero());
}

}  // namespace
}  // namespace daumier::rig
