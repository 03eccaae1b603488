#include "datasets/read/stroke_deformation.h"

#include "datasets/read/stroke_arc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using render::Stroke;

/// A part of a circle around the middle of the canvas, of 21 points.
Stroke Arc(double length_px, double angle) {
  Stroke stroke;
  for (int i = 0; i <= 20; ++i) {
    const double at = angle * i / 20;
    stroke.points.push_back(ToPoint(Vector2d(128, 128) + length_px / angle * Vector2d(std::cos(at), std::sin(at))));
  }
  return stroke;
}

Stroke FaceOval() {
  Stroke stroke;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    stroke.points.push_back(ToPoint(Vector2d(128 + 50 * std::cos(angle), 120 + 70 * std::sin(angle))));
  }
  stroke.points.push_back(stroke.points.front());
  return stroke;
}

double MeanMove(const Stroke& stroke, double shift_px, int num_seeds) {
  double sum = 0;
  for (int seed = 0; seed < num_seeds; ++seed) {
    Rng rng(seed);
    const Stroke deformed = DeformStroke(stroke, shift_px, rng);
    for (size_t i = 0; i < stroke.points.size(); ++i)
      sum += (ToVector(deformed.points[i]) - ToVector(stroke.points[i])).norm();
  }
  return sum / (num_seeds * double(stroke.points.size()));
}

TEST(DeformStroke, TurnsAndScalesAShortLineAboutOneEnd) {
  // Two handles, the ends: a similarity. The free end moves by 3 |N| along each axis, to all four sides alike.
  const Stroke line{4, {{100, 50}, {110, 50}, {120, 50}}};
  constexpr int kSeeds = 4000;
  double sum = 0;
  int num_to_the_right = 0, num_downwards = 0, num_first = 0;
  Rng rng(1);
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Stroke bent = DeformStroke(line, 3, rng);
    ASSERT_EQ(bent.points.size(), 3u);
    EXPECT_EQ(bent.kind, 4);
    const Vector2d first = ToVector(bent.points[0]) - Vector2d(100, 50),
                   last = ToVector(bent.points[2]) - Vector2d(120, 50);
    EXPECT_LT(std::min(first.norm(), last.norm()), 1e-4);
    EXPECT_LT((ToVector(bent.points[1]) - Vector2d(110, 50) - (first + last) / 2).norm(), 1e-4);
    sum += std::abs((first + last).x());
    num_to_the_right += (first + last).x() > 0;
    num_downwards += (first + last).y() > 0;
    num_first += first.norm() > last.norm();
  }
  EXPECT_NEAR(sum / kSeeds, 3 * std::sqrt(2 / std::numbers::pi), 0.12);
  for (const int count : {num_to_the_right, num_downwards, num_first}) EXPECT_NEAR(count, kSeeds / 2, 130);
}

TEST(DeformStroke, SignsAreOneForTheStroke) {
  Stroke line;  // A handle at every point.
  for (int i = 0; i <= 4; ++i) line.points.push_back({static_cast<float>(50 + 32 * i), 60});
  Rng rng(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Stroke bent = DeformStroke(line, 4, rng);
    int num_fixed = 0;
    Vector2d first = Vector2d::Zero();
    for (size_t i = 0; i < 5; ++i) {
      const Vector2d move = ToVector(bent.points[i]) - ToVector(line.points[i]);
      num_fixed += move.norm() < 1e-4;
      if (move.norm() < 1e-4) continue;
      if (first.isZero()) first = move;
      EXPECT_GE(move.x() * first.x(), -1e-3);
      EXPECT_GE(move.y() * first.y(), -1e-3);
    }
    EXPECT_EQ(num_fixed, 1);
  }
}

TEST(DeformStroke, StraighterStrokesMoveMore) {
  EXPECT_GT(MeanMove(Arc(100, 0.1), 4, 100), 1.5 * MeanMove(Arc(100, 4.5), 4, 100));
}

TEST(DeformStroke, ClosedStrokesMoveAndStayClosed) {
  Rng rng(3);
  for (int trial = 0; trial < 20; ++trial) EXPECT_TRUE(IsClosed(DeformStroke(FaceOval(), 5, rng)));
  EXPECT_GT(MeanMove(FaceOval(), 5, 20), 1);
}

TEST(DeformStroke, StrokesOfTwoPointsOrOfNoLengthStay) {
  Rng rng(4);
  for (const Stroke& stroke :
       {Stroke{}, Stroke{0, {{1, 2}}}, Stroke{0, {{1, 2}, {30, 40}}}, Stroke{0, {{1, 2}, {1, 2}, {1, 2}}}}) {
    EXPECT_EQ(DeformStroke(stroke, 10, rng).points, stroke.points);
  }
}

/// A cross in a circle, whose four extreme points are the first of each stroke.
std::vector<Stroke> Drawing() {
  return {{0, {{40, 130}, {120, 128}}},
          {1, {{210, 125}, {130, 120}}},
          {2, {{128, 30}, {126, 110}}},
          {3, {{131, 220}, {130, 140}}}};
}

TEST(DeformDrawing, KeepsTheOrderOfExtremePoints) {
  const auto drawing = Drawing();
  for (const double shift_px : {4.0, 60.0, 1e4}) {
    for (int seed = 0; seed < 200; ++seed) {
      Rng rng(seed);
      const auto deformed = DeformDrawing(drawing, shift_px, rng);
      for (size_t i = 0; i < 4; ++i) {
        for (size_t j = 0; j < 4; ++j) {
          const Vector2d before = ToVector(drawing[i].points[0]) - ToVector(drawing[j].points[0]);
          const Vector2d after = ToVector(deformed[i].points[0]) - ToVector(deformed[j].points[0]);
          EXPECT_GE((before.array() * after.array()).minCoeff(), -1e-2) << seed << ": " << i << " " << j;
        }
      }
    }
  }
}

TEST(DeformDrawing, MovesExtremePointsByNormalNumbersAndAllElseWithThem) {
  const auto drawing = Drawing();
  double square_sum = 0;
  constexpr int kSeeds = 2000;
  Rng rng(5);
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto deformed = DeformDrawing(drawing, 0.5, rng);  // So small that hardly an order changes.
    square_sum += (ToVector(deformed[0].points[0]) - Vector2d(40, 130)).squaredNorm();
    for (size_t i = 0; i < 4; ++i) EXPECT_NE(deformed[i].points[1], drawing[i].points[1]);
  }
  EXPECT_NEAR(std::sqrt(square_sum / kSeeds), 0.5 * std::sqrt(2), 0.03);
}

TEST(DeformDrawing, MovesNothingByNothing) {
  Rng rng(6);
  const auto deformed = DeformDrawing(Drawing(), 0, rng);
  for (size_t i = 0; i < 4; ++i) {
    for (size_t k = 0; k < 2; ++k)
      EXPECT_LT((ToVector(deformed[i].points[k]) - ToVector(Drawing()[i].points[k])).norm(), 1e-4);
  }
  EXPECT_TRUE(DeformDrawing({}, 5, rng).empty());
}

}  // namespace
}  // namespace daumier::datasets
