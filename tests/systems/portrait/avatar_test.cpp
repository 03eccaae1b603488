#include "systems/portrait/avatar.h"

#include "core/files.h"
#include "faces/face_model_file.h"
#include "rig/arkit_names.h"
#include "systems/portrait/landmark_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace daumier::portrait {
namespace {

using testing::SourceRoot;

const faces::FaceModel& Model() {
  static const faces::FaceModel model = faces::ReadFaceModelWeights(SourceRoot() / "weights/face-ict");
  return model;
}

AvatarMaker MakerWith(bool keep_expression, const PortraitPredictOptions& options = {}) {
  AvatarOptions avatar;
  avatar.texture.size = 128;
  avatar.keep_expression = keep_expression;
  const auto open = [&] { return OpenPortraits(SourceRoot() / "weights/portrait", Device(), ToJson(options)); };
  return {open, Model(), avatar};
}

render::Image Woman() {
  return render::ReadImage(SourceRoot() / "docs/examples/portraits/woman.jpg");
}

TEST(AvatarMaker, MakesATexturedHeadWithAllTargets) {
  const Avatar avatar = MakerWith(false).Make(Woman());
  EXPECT_EQ(avatar.head.targets.num_targets(), rig::kNumArkitNames);
  EXPECT_EQ(avatar.head.targets.offsets.rows(), 3 * avatar.head.mesh.vertices.rows());
  ASSERT_EQ(avatar.head.eyes.size(), 2u);
  EXPECT_LT(avatar.head.eyes[0].centre.x(), avatar.head.eyes[1].centre.x());
  EXPECT_TRUE(avatar.head.mesh.has_uv());
  ASSERT_NE(avatar.texture, nullptr);
  EXPECT_EQ(avatar.texture->width, 128);
  EXPECT_NEAR(avatar.painted.seen + avatar.painted.mirrored + avatar.painted.filled, 1, 1e-6);
  EXPECT_GT(avatar.painted.seen, 0.1);
  EXPECT_FALSE(avatar.face.pictures.empty());
}

TEST(AvatarMaker, RestsWithoutTheExpressionOfThePictureUnlessItIsKept) {
  const Avatar neutral = MakerWith(false).Make(Woman()), kept = MakerWith(true).Make(Woman());
  ASSERT_GT(neutral.face.expression.norm(), 0);
  const Eigen::VectorXf offset =
      Model().expression_shapes * neutral.face.expression.head(Model().expression_shapes.cols());
  const geometry::Points difference = kept.face.vertices - neutral.face.vertices;
  EXPECT_EQ(difference.norm(), 0) << "the face itself is the same";
  using Flat = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>;
  const double shown = Flat(offset.data(), offset.size() / 3, 3).rowwise().norm().maxCoeff();
  const double moved = (kept.head.mesh.vertices - neutral.head.mesh.vertices).rowwise().norm().maxCoeff();
  EXPECT_NEAR(moved, shown, 0.3);
}

TEST(AvatarMaker, TakesGivenLandmarks) {
  const PortraitReading found =
      OpenPortraits(SourceRoot() / "weights/portrait", Device(), Json::object())->Read(Woman());
  const testing::TempDir folder;
  WriteFileAtomically(folder.path() / "woman.pts", LandmarksAsPts(found.landmarks));
  const Avatar avatar = MakerWith(false, {.landmarks = (folder.path() / "woman.pts").string()}).Make(Woman());
  EXPECT_GT(avatar.painted.seen, 0.1) << "the picture is parsed, too";
  const auto centred = [](const geometry::Points& face) -> geometry::Points {
    return face.rowwise() - face.colwise().mean();
  };
  EXPECT_LT((centred(avatar.face.vertices) - centred(found.face.vertices)).rowwise().norm().maxCoeff(), 1)
      << "the same landmarks, but for their confidences";
}

TEST(AvatarMaker, RigsTheEditedFaceWithTheTextureOfThePicture) {
  const AvatarMaker maker = MakerWith(false);
  const Avatar plain = maker.Make(Woman());
  const Avatar larger = maker.Make(Woman(), [](const geometry::Points& face) { return geometry::Points(1.1 * face); });
  EXPECT_LT((larger.neutral - 1.1 * plain.neutral).norm(), 1e-9);
  EXPECT_GT(larger.head.mesh.vertices.col(1).maxCoeff(), 1.05 * plain.head.mesh.vertices.col(1).maxCoeff());
  EXPECT_EQ(*larger.texture, *plain.texture);
}

TEST(AvatarMaker, ReadsTheFaceInItsStyle) {
  const auto maker_with = [](const std::string& style) {
    AvatarOptions avatar;
    avatar.texture.size = 128;
    avatar.style = style;
    const auto open = [] { return OpenPortraits(SourceRoot() / "weights/portrait", Device(), Json::object()); };
    return AvatarMaker(open, Model(), avatar);
  };
  const Avatar plain = maker_with("none").Make(Woman()), toon = maker_with("toon").Make(Woman());
  EXPECT_NE(toon.picture, plain.picture);
  const auto opening = [](const Avatar& avatar) {  // Of the right eye, pixels.
    const std::vector<float>& landmarks = avatar.found.landmarks;
    return std::hypot(landmarks[2 * 41] - landmarks[2 * 37], landmarks[2 * 41 + 1] - landmarks[2 * 37 + 1]);
  };
  EXPECT_GT(opening(toon), 1.15 * opening(plain));
  testing::ExpectError([&] { maker_with("oil"); }, "there is no style 'oil'");
  testing::ExpectError([&] { maker_with("nowhere.onnx"); }, "nowhere.onnx");
}

TEST(AvatarMaker, TakesAGivenMask) {
  const testing::TempDir folder;
  render::Image mask(224, 224, 1, 0);
  for (int row = 20; row < 224; ++row)
    for (int column = 40; column < 190; ++column) mask.at(row, column) = 255;
  render::WriteImage(folder.path() / "mask.png", mask);
  const Avatar avatar = MakerWith(false, {.mask = (folder.path() / "mask.png").string()}).Make(Woman());
  ASSERT_TRUE(avatar.found.mask);
  EXPECT_EQ(avatar.found.mask->at(100, 20), uint8_t(PictureClass::kBackground)) << "black is background";
  EXPECT_NE(avatar.found.mask->at(150, 60), uint8_t(PictureClass::kBackground)) << "white is the head";
}

TEST(PortraitReading, IsParsedBeyondTheCropOfTheFace) {
  const render::Image picture = Woman();
  const PortraitReading reading =
      OpenPortraits(SourceRoot() / "weights/portrait", Device(), Json::object())->Read(picture);
  ASSERT_TRUE(reading.mask);
  double top = picture.height;
  for (size_t i = 1; i < reading.landmarks.size(); i += 2) top = std::min(top, double(reading.landmarks[i]));
  double bottom = 0;
  for (size_t i = 1; i < reading.landmarks.size(); i += 2) bottom = std::max(bottom, double(reading.landmarks[i]));
  // The crown, higher than a quarter of the landmarks' box, where the crop of the face ends.
  const int row = int(top - 0.4 * (bottom - top)), column = int(reading.landmarks[2 * 27]);
  ASSERT_GE(row, 0);
  EXPECT_NE(reading.mask->at(row, column), uint8_t(PictureClass::kBackground));
}

TEST(AvatarMaker, RefusesAPictureWithoutAFace) {
  const AvatarMaker maker = MakerWith(false);
  const render::Image blank(64, 64, 3, 200);
  testing::ExpectError([&] { maker.Make(blank); }, "no face found");
}

}  // namespace
}  // namespace daumier::portrait
