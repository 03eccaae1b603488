#include "faces/model_frame.h"

#include "core/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(ModelFrame, ScalesThenShifts) {
  const ModelFrame frame{.scale = 0.5, .offset = {1, 2, 3}};
  geometry::Points points(2, 3);
  points << 2, 4, -6, 0, 0, 0;
  geometry::Points expected(2, 3);
  expected << 2, 4, 0, 1, 2, 3;
  EXPECT_EQ(frame.FromCm(points), expected);
}

TEST(ModelFrame, ToCmUndoesFromCm) {
  Rng rng(3);
  const ModelFrame frame{.scale = 0.0993, .offset = {0.1, -0.4, 0.7}};
  geometry::Points points(50, 3);
  for (double& coordinate : points.reshaped()) coordinate = rng.Uniform(-20, 20);
  EXPECT_LT((frame.ToCm(frame.FromCm(points)) - points).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(HeadFrame, TheHeadStandsLikeTheReferencesTemplate) {
  FaceTemplate face = testing::SyntheticFace();
  face.neutral.rowwise() += Eigen::RowVector3d(3, -40, 8);
  const geometry::Points model = HeadFrame(face, 2.1).FromCm(face.neutral);
  EXPECT_NEAR(model(face.annotation.landmarks[8], 1), -0.71, 1e-12);
  EXPECT_NEAR(model.col(1).maxCoeff(), -0.71 + 2.1, 1e-12);
  EXPECT_NEAR(model.col(2).maxCoeff(), 0.63, 1e-12);
  EXPECT_NEAR(model.col(0).maxCoeff() + model.col(0).minCoeff(), 0, 1e-12);
}

TEST(HeadFrame, AnotherHeightIsAScaledCopy) {
  const FaceTemplate face = testing::SyntheticFace();
  const geometry::Points one = HeadFrame(face, 2.1).FromCm(face.neutral);
  const geometry::Points two = HeadFrame(face, 4.2).FromCm(face.neutral);
  EXPECT_LT((two - 2 * one).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(HeadFrame, HeadsWithoutHeightAreRefused) {
  FaceTemplate face = testing::SyntheticFace();
  testing::ExpectError([&] { HeadFrame(face, 0); }, "0 units high");
  face.neutral.col(1).setZero();
  testing::ExpectError([&] { HeadFrame(face, 2.1); }, "highest vertex");
}

TEST(ModelFrameJson, GivesTheSameBitsBack) {
  const ModelFrame frame{.scale = 0.1 / 3, .offset = {1.0 / 7, -2.0 / 3, 1e-17}};
  const ModelFrame back = ModelFrameFromJson(Json::parse(ModelFrameToJson(frame).dump()));
  EXPECT_EQ(back.scale, frame.scale);
  EXPECT_EQ(back.offset, frame.offset);
}

TEST(ModelFrameJson, MalformedOnesAreRefused) {
  Json json = ModelFrameToJson({});
  json["offset"] = {1, 2};
  testing::ExpectError([&] { ModelFrameFromJson(json); }, "offset has 2 numbers");
  json = ModelFrameToJson({});
  json["scale"] = 0;
  testing::ExpectError([&] { ModelFrameFromJson(json); }, "scale is 0");
  json.erase("scale");
  EXPECT_THROW(ModelFrameFromJson(json), Json::exception);
}

}  // namespace
}  // namespace daumier::faces
