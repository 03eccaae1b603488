#include "systems/sketch/drawing_parser.h"

#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/ideal_parser_network.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numbers>

namespace daumier::sketch {
namespace {

DrawingParser IdealParser(const DrawingParserOptions& options = {}) {
  return {ParserNetworkOptions(), std::make_shared<testing::IdealParserNetwork>(ParserNetworkOptions()), options};
}

/// A rectangle on a sheet.
std::vector<render::Stroke> Rectangle(float left, float top, float width, float height) {
  const float right = left + width, bottom = top + height;
  return {{0, {{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}}}};
}

TEST(DrawingParser, PointsAreWhereTheyAreOnASheetOfAnySize) {
  for (const float scale : {0.3f, 1.0f, 12.0f}) {
    const ParsedDrawing parsed = IdealParser().Parse(Rectangle(40 * scale, 70 * scale, 100 * scale, 140 * scale));
    const auto shares = testing::PlainPointShares();
    for (size_t i = 0; i < shares.size(); ++i) {
      const Eigen::Vector2d expected =
          scale * (Eigen::Vector2d(40, 70) + shares[i].cwiseProduct(Eigen::Vector2d(100, 140)));
      EXPECT_LT((parsed.points[i] - expected).norm(), 2 * scale) << faces::kFacePointNames[i];
      EXPECT_GT(parsed.confidences[i], 0.9);
    }
  }
}

TEST(DrawingParser, StatesAndLabelsAreThoseOfTheNetwork) {
  const ParsedDrawing parsed = IdealParser().Parse(Rectangle(0, 0, 50, 70));
  EXPECT_GT(parsed.mouth[size_t(faces::MouthState::kClosed)], 0.99);
  EXPECT_GT(parsed.eyes[0][size_t(faces::EyeState::kOpen)], 0.99);
  EXPECT_GT(parsed.eyes[1][size_t(faces::EyeState::kOpen)], 0.99);
  EXPECT_GT(parsed.view[size_t(faces::DrawnView::kFront)], 0.99);
  ASSERT_EQ(parsed.labels.size(), parsed.strokes.size());
  for (size_t s = 0; s < parsed.strokes.size(); ++s) {
    ASSERT_EQ(parsed.labels[s].size(), parsed.strokes[s].points.size());
    for (const faces::LineLabel label : parsed.labels[s]) EXPECT_EQ(label, faces::LineLabel::kSilhouette);
  }
}

TEST(DrawingParser, StrokesGetPointsAtMostAStepApart) {
  const ParsedDrawing parsed = IdealParser().Parse(Rectangle(0, 0, 100, 140));
  const double step = ParsedDrawing::kLabelStep / FrameOfWhole(Rectangle(0, 0, 100, 140)).scale;
  const auto& points = parsed.strokes.at(0).points;
  for (size_t i = 1; i < points.size(); ++i)
    EXPECT_LE(std::hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]), step + 1e-4);
}

TEST(DrawingParser, TheMirrorImageChangesNothingOfASymmetricFace) {
  const auto strokes = Rectangle(10, 10, 100, 140);
  const ParsedDrawing with = IdealParser().Parse(strokes), without = IdealParser({.mirror = false}).Parse(strokes);
  for (size_t i = 0; i < with.points.size(); ++i) EXPECT_LT((with.points[i] - without.points[i]).norm(), 1.5);
}

/// The ideal parser of drawings whose ink is mostly above; of others its maps are nearly flat.
class UprightNetwork : public testing::IdealParserNetwork {
 public:
  using IdealParserNetwork::IdealParserNetwork;
  NamedArrays Run(const NamedArrays& inputs) const override {
    const FloatArray& pictures = inputs.at("pictures");
    NamedArrays outputs = IdealParserNetwork::Run(inputs);
    FloatArray& maps = outputs.at("heat_maps");
    const int64_t side = pictures.shape[2];
    for (int64_t row = 0; row < pictures.shape[0]; ++row) {
      double moment = 0;
      for (int64_t i = 0; i < pictures.row_size(); ++i)
        moment += pictures.row(row)[i] * (double(i / side) + 0.5 - 0.5 * double(side));
      if (moment <= 0) continue;
      for (int64_t i = 0; i < maps.row_size(); ++i) maps.row(row)[i] *= 0.02f;
    }
    return outputs;
  }
};

TEST(DrawingParser, AFaceThatIsUpsideDownIsTurned) {
  const auto network = std::make_shared<UprightNetwork>(ParserNetworkOptions());
  std::vector<render::Stroke> strokes = Rectangle(40, 70, 100, 140);
  strokes.push_back({0, {{40, 205}, {140, 205}}});
  strokes.push_back({0, {{40, 200}, {140, 200}}});
  const ParsedDrawing parsed = DrawingParser(ParserNetworkOptions(), network).Parse(strokes);
  EXPECT_GT(parsed.confidence(), 0.9);
  EXPECT_NEAR(std::abs(parsed.frame.turn_degrees), 180, 1);
  const auto shares = testing::PlainPointShares();
  for (size_t i = 0; i < shares.size(); ++i) {
    const Eigen::Vector2d expected(140 - 100 * shares[i].x(), 210 - 140 * shares[i].y());
    EXPECT_LT((parsed.points[i] - expected).norm(), 3) << faces::kFacePointNames[i];
  }
  const ParsedDrawing as_it_is = DrawingParser(ParserNetworkOptions(), network, {.turn = false}).Parse(strokes);
  EXPECT_LT(as_it_is.confidence(), 0.5);
}

TEST(DrawingParser, IsTheSameFromAnyThread) {
  const DrawingParser parser = IdealParser();
  const auto strokes = Rectangle(10, 10, 100, 140);
  testing::ExpectTheSameFromThreads(1, [&] { return parser.Parse(strokes).points; });
}

TEST(DrawingParser, ADrawingWithoutLinesIsRefused) {
  testing::ExpectError([] { IdealParser().Parse({}); }, "drawing");
}

TEST(FrameOfPoints, IsUprightAndCentred) {
  std::array<Eigen::Vector2d, faces::kNumFacePoints> points = testing::PlainPointShares();
  const Eigen::Rotation2Dd turn(0.3);
  for (Eigen::Vector2d& point : points) point = turn * (100 * point) + Eigen::Vector2d(7, 9);
  const render::Placement frame = FrameOfPoints(points);
  EXPECT_NEAR(frame.turn_degrees, -0.3 * 180 / std::numbers::pi, 1e-6);
  const auto at = [&](faces::FacePoint point) { return render::ToCanvas(frame, points[size_t(point)]); };
  const Eigen::Vector2d right = at(faces::FacePoint::kEyeRightCentre), left = at(faces::FacePoint::kEyeLeftCentre);
  EXPECT_NEAR(right.y(), left.y(), 1e-6);
  EXPECT_NEAR(0.5 * (right.x() + left.x()), 128, 1e-6);
  // 60 from the eyes to the chin and 0.45 of that above them; the points are 90 wide.
  const double height = 1.45 * 60, width = 90, longer = std::max(height, width);
  EXPECT_NEAR(frame.scale, kFaceShare * 256 / longer, 1e-6);
}

TEST(FrameOfWhole, HasTheLongerSide) {
  const render::Placement frame = FrameOfWhole(Rectangle(10, 20, 50, 100));
  EXPECT_NEAR(frame.scale, kWholeShare * 256 / 100, 1e-6);
  EXPECT_NEAR(render::ToCanvas(frame, {35, 70}).x(), 128, 1e-4);
  EXPECT_NEAR(render::ToCanvas(frame, {35, 70}).y(), 128, 1e-4);
  for (const double turn : {90.0, 180.0, 270.0}) {
    const render::Placement turned = FrameOfWhole(Rectangle(10, 20, 50, 100), turn);
    EXPECT_NEAR(turned.scale, frame.scale, 1e-6);
    EXPECT_LT((render::ToCanvas(turned, {35, 70}) - Eigen::Vector2d(128, 128)).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace daumier::sketch
