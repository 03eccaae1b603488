#include "rig/expression_targets.h"

#include "faces/face_model_file.h"
#include "rig/arkit_names.h"
#include "tests/rig/named_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

Eigen::VectorXf Column(const MorphTargets& targets, std::string_view name) {
  return targets.offsets.col(*FindArkitName(name));
}

TEST(ExpressionTargets, AreTheFiftyTwoNamesInOrder) {
  const faces::FaceModel model = testing::NamedModel();
  const MorphTargets targets = ExpressionTargets(model).On(model.face_template.neutral);
  ASSERT_EQ(targets.num_targets(), kNumArkitNames);
  EXPECT_TRUE(std::ranges::equal(targets.names, ArkitNames()));
  EXPECT_EQ(targets.offsets.rows(), model.face_template.neutral.size());
}

TEST(ExpressionTargets, SomeOfThemAreThoseOfAll) {
  const faces::FaceModel model = testing::NamedModel();
  const ExpressionTargets expressions(model);
  const geometry::Points face = 1.2 * model.face_template.neutral;
  const MorphTargets all = expressions.On(face);
  for (int e = 0; e < kNumArkitNames; ++e) {
    const MorphTargets one = expressions.OnlyOn(face, {e});
    EXPECT_EQ(one.names, all.names);
    for (int other = 0; other < kNumArkitNames; ++other) {
      const Eigen::VectorXf expected = (other == e ? 1.0f : 0.0f) * all.offsets.col(other);
      EXPECT_EQ(one.offsets.col(other), expected) << all.names[size_t(e)] << ", " << all.names[size_t(other)];
    }
  }
  EXPECT_TRUE(expressions.OnlyOn(face, {}).offsets.isZero(0));
  testing::ExpectError([&] { expressions.OnlyOn(face, {52}); }, "52 is no place among 52 expressions");
}

TEST(ExpressionTargets, ThreadsDoNotMatter) {
  const faces::FaceModel model = testing::NamedModel();
  const ExpressionTargets targets(model);
  EXPECT_EQ(targets.On(model.face_template.neutral, 1).offsets, targets.On(model.face_template.neutral, 8).offsets);
}

TEST(ExpressionTargets, SayWhatTheSourceCannotMake) {
  const faces::FaceModel model = testing::NamedModel();
  const ExpressionTargets expressions(model);
  EXPECT_EQ(expressions.warnings().size(), 52u - 6 - 2)
      << "six are made, then mouthClose, and tongueOut is of the tongue";
  EXPECT_NE(expressions.warnings().front().find("eyeLookDownLeft"), std::string::npos);
  const MorphTargets targets = expressions.On(model.face_template.neutral);
  EXPECT_TRUE(Column(targets, "eyeLookDownLeft").isZero(0));
  EXPECT_EQ(Column(targets, "tongueOut"), float(kTongueOpens) * Column(targets, "jawOpen"));
}

TEST(ExpressionTargets, OfIctAreAllButTongueOut) {
  const ExpressionTargets expressions(faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict"));
  EXPECT_TRUE(expressions.warnings().empty());
}

}  // namespace
}  // namespace daumier::rig
