#include "fitting/curve_recovery.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::fitting {
namespace {

constexpr int kPoints = 40;

/// Two curves, a wave above and a line below, of 20 points each: u moves them along y, v along x, about (128, 128).
/// The mean u and v give the curves in their middle place.
faces::BilinearModel WaveAndLine() {
  faces::BilinearModel model;
  model.num_identity = 2, model.num_expression = 2;
  model.core = faces::BilinearModel::Core::Zero(4, 2 * kPoints);
  for (int k = 0; k < kPoints; ++k) {
    const float x = 70.0f + 6 * float(k % 20);
    model.core(0, 2 * k) = x;
    model.core(0, 2 * k + 1) = k < 20 ? 100 + 10 * std::sin(x / 12) : 160;
    model.core(1, 2 * k) = 1;      // u0 v1: along x
    model.core(2, 2 * k + 1) = 1;  // u1 v0: along y
  }
  model.identity_factors.resize(4, 2);
  model.identity_factors << 1, -8, 1, 8, 1, -8, 1, 8;
  model.expression_factors = model.identity_factors;
  return model;
}

const CurveOffsets kCurveOffsets = {0, 20, 40};

std::vector<float> CurvesAt(const faces::BilinearModel& model, float dx, float dy) {
  const Eigen::VectorXf points = faces::Reconstruct(model, Eigen::Vector2f(1, dy), Eigen::Vector2f(1, dx));
  return {points.data(), points.data() + points.size()};
}

std::vector<render::Stroke> StrokesAt(const std::vector<float>& points) {
  std::vector<render::Stroke> strokes(2);
  for (int k = 0; k < kPoints; ++k)
    strokes[size_t(k / 20)].points.push_back({points[2 * size_t(k)], points[2 * size_t(k) + 1]});
  return strokes;
}

double MeanError(const faces::CurveCode& code, const std::vector<float>& truth) {
  double sum = 0;
  for (size_t k = 0; k < kPoints; ++k)
    sum += std::hypot(code.points[Eigen::Index(2 * k)] - truth[2 * k],
                      code.points[Eigen::Index(2 * k + 1)] - truth[2 * k + 1]);
  return sum / kPoints;
}

TEST(RecoverCurves, SnapsAPredictionOntoTheStrokes) {
  const faces::BilinearModel model = WaveAndLine();
  const faces::CurveEncoder encoder(model, {.deviation_px = 1, .rounds = 6});
  const auto truth = CurvesAt(model, 3, -4), predicted = CurvesAt(model, 1, 1);
  const double before =
      MeanError(RecoverCurves(encoder, kCurveOffsets, predicted, StrokesAt(truth), {.snaps = 0}), truth);
  const double after = MeanError(
      RecoverCurves(encoder, kCurveOffsets, predicted, StrokesAt(truth), {.snaps = 4, .reach_px = 16}), truth);
  EXPECT_NEAR(before, std::hypot(2, 5), 0.1) << "without a snap the prediction itself is encoded";
  EXPECT_LT(after, 1.5) << "along themselves curves move little";
}

TEST(RecoverCurves, StrokesOutOfReachOrAcrossChangeNothing) {
  const faces::BilinearModel model = WaveAndLine();
  const faces::CurveEncoder encoder(model, {.deviation_px = 1, .rounds = 6});
  const auto predicted = CurvesAt(model, 0, 0);
  // Below the line, out of reach; and a ladder of verticals that cross both curves.
  std::vector<render::Stroke> strokes = {{0, {{60, 200}, {200, 200}}}};
  for (int i = 0; i < 8; ++i) strokes.push_back({0, {{75.0f + 15 * i, 135}, {75.0f + 15 * i, 190}}});
  const auto code =
      RecoverCurves(encoder, kCurveOffsets, predicted, strokes, {.snaps = 2, .reach_px = 8, .max_angle = 40});
  EXPECT_LT(MeanError(code, predicted), 0.1);
}

TEST(RecoverCurves, AMissingStrokeIsFilledInByTheOthers) {
  const faces::BilinearModel model = WaveAndLine();
  const faces::CurveEncoder encoder(model, {.deviation_px = 1, .rounds = 6});
  const auto truth = CurvesAt(model, 0, -5), predicted = CurvesAt(model, 0, 0);
  auto strokes = StrokesAt(truth);
  strokes.pop_back();
  EXPECT_LT(MeanError(RecoverCurves(encoder, kCurveOffsets, predicted, strokes, {.snaps = 4, .reach_px = 16}), truth),
            1.5);
}

TEST(RecoverCurves, WithoutAnyStrokeThePredictionItselfIsEncoded) {
  const faces::BilinearModel model = WaveAndLine();
  const faces::CurveEncoder encoder(model, {.deviation_px = 1, .rounds = 6});
  const auto predicted = CurvesAt(model, 2, -3);
  const auto code = RecoverCurves(encoder, kCurveOffsets, predicted, {});
  EXPECT_EQ(code.numbers(), RecoverCurves(encoder, kCurveOffsets, predicted, {}, {.snaps = 0}).numbers());
  EXPECT_EQ(code.points, faces::Reconstruct(model, code.u, code.v));
}

TEST(FollowStrokes, WhatTheModelLeavesOutOfItsPointsMovesThemOnTheCanvas) {
  const faces::BilinearModel model = WaveAndLine();
  const faces::CurveEncoder encoder(model, {.deviation_px = 1, .rounds = 6});
  faces::CurveCode start{Eigen::Vector2f(1, 0), Eigen::Vector2f(1, 0), {}};
  start.points = faces::Reconstruct(model, start.u, start.v);
  auto drawn = CurvesAt(model, 0, -4);
  const auto expected = FollowStrokes(encoder, kCurveOffsets, start, StrokesAt(drawn));
  for (float& coordinate : drawn) coordinate += 8;
  const auto moved =
      FollowStrokes(encoder, kCurveOffsets, start, StrokesAt(drawn), {}, Eigen::VectorXf::Constant(2 * kPoints, 8));
  EXPECT_LT((moved.points - expected.points).cwiseAbs().maxCoeff(), 1e-2);
  testing::ExpectError([&] { FollowStrokes(encoder, kCurveOffsets, start, {}, {}, Eigen::VectorXf::Zero(3)); },
                       "moved by 3");
}

TEST(FollowStrokes, TheStartIsReturnedWhereNoStrokeIsWithinReach) {
  const faces::BilinearModel model = WaveAndLine();
  const faces::CurveEncoder encoder(model);
  faces::CurveCode start{Eigen::Vector2f(1, 3), Eigen::Vector2f(1, -2), {}};
  start.points = faces::Reconstruct(model, start.u, start.v);
  const auto code = FollowStrokes(encoder, kCurveOffsets, start, {{0, {{60, 240}, {200, 240}}}});
  EXPECT_EQ(code.numbers(), start.numbers());
  EXPECT_EQ(code.points, start.points);
}

TEST(RecoverCurves, StrokesOutsideOfTheCanvasAreNoTrouble) {
  const faces::BilinearModel model = WaveAndLine();
  const faces::CurveEncoder encoder(model);
  const auto predicted = CurvesAt(model, 0, 0);
  const std::vector<render::Stroke> strokes = {{0, {{-300, -20}, {900, 700}}}, {0, {{5, 5}}}, {0, {}}};
  EXPECT_TRUE(RecoverCurves(encoder, kCurveOffsets, predicted, strokes).points.allFinite());
}

TEST(RecoverCurves, CurvesOfAnotherModelAreRefused) {
  const faces::BilinearModel model = WaveAndLine();
  const faces::CurveEncoder encoder(model);
  testing::ExpectError(
      [&] {
        RecoverCurves(encoder, {0, 7}, CurvesAt(model, 0, 0), {});
      },
      "curves of 7 points for a model of 40");
}

TEST(PlaceOnCurves, UndoesATurnAScaleAndAShiftAndLeavesADrawingThatIsFarAway) {
  // Two arcs of 40 points, drawn once more as another hand places them.
  std::vector<float> curves;
  for (int arc = 0; arc < 2; ++arc) {
    for (int i = 0; i < 40; ++i) {
      const double angle = 0.07 * i + 2.5 * arc;
      curves.push_back(float(128 + (40 + 20 * arc) * std::cos(angle)));
      curves.push_back(float(128 + (60 - 10 * arc) * std::sin(angle)));
    }
  }
  const CurveOffsets offsets{0, 40, 80};
  auto drawn = CurveStrokes(offsets, curves);
  for (auto& stroke : drawn) {
    for (auto& [x, y] : stroke.points) {
      const float dx = x - 128, dy = y - 128;
      x = 131 + 1.04f * (dx * std::cos(0.03f) - dy * std::sin(0.03f));
      y = 126 + 1.04f * (dx * std::sin(0.03f) + dy * std::cos(0.03f));
    }
  }
  const auto distance = [&](const std::vector<render::Stroke>& strokes) {
    double most = 0;
    for (size_t arc = 0; arc < 2; ++arc) {
      for (size_t i = 0; i < 40; ++i) {
        const auto& [x, y] = strokes[arc].points[i];
        most =
            std::max(most, std::hypot(double(x) - curves[80 * arc + 2 * i], double(y) - curves[80 * arc + 2 * i + 1]));
      }
    }
    return most;
  };
  // Nearest points carry little information on a move along a curve, so that it comes back slowly.
  EXPECT_LT(distance(PlaceOnCurves(drawn, offsets, curves, {}, 20)), 0.3 * distance(drawn));
  EXPECT_EQ(distance(PlaceOnCurves(drawn, offsets, curves, {}, 0)), distance(drawn));
  for (auto& stroke : drawn)
    for (auto& point : stroke.points) point[0] += 500;
  EXPECT_EQ(distance(PlaceOnCurves(drawn, offsets, curves, {}, 20)), distance(drawn));
}

}  // namespace
}  // namespace daumier::fitting
