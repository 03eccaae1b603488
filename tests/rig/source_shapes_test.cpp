#include "rig/source_shapes.h"

#include "rig/arkit_names.h"
#include "tests/rig/named_model.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(SourceShapes, AreFoundByNameAndSummed) {
  const faces::FaceModel model = testing::NamedModel();
  const SourceShapes source = ArkitShapesOf(model);
  EXPECT_EQ(source.shapes.col(*FindArkitName("jawOpen")), model.expression_shapes.col(0));
  EXPECT_EQ(source.shapes.col(*FindArkitName("mouthSmileRight")), model.expression_shapes.col(2));
  EXPECT_EQ(source.shapes.col(*FindArkitName("browInnerUp")), 2 * model.expression_shapes.col(5));
}

TEST(SourceShapes, AreFoundInOtherSpellings) {
  faces::FaceModel model = testing::NamedModel();
  model.expression_shape_names[0] = "JawOpen";
  model.expression_shape_names[3] = "eyeBlinkLeft";
  const SourceShapes source = ArkitShapesOf(model);
  EXPECT_EQ(source.shapes.col(*FindArkitName("jawOpen")), model.expression_shapes.col(0));
  EXPECT_EQ(source.shapes.col(*FindArkitName("eyeBlinkLeft")), model.expression_shapes.col(3));
}

TEST(SourceShapes, OfAModelWithoutNamesAreRefused) {
  testing::ExpectError([] { ArkitShapesOf(testing::SyntheticModel()); },
                       "no expression shape with a name of ARKit (found 7 shapes)");
}

}  // namespace
}  // namespace daumier::rig
