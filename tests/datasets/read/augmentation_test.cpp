#include "datasets/read/augmentation.h"

#include "datasets/read/stroke_arc.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using render::Stroke;

Stroke Ellipse(int kind, const Vector2d& centre, const Vector2d& radii, double angle = 2 * std::numbers::pi) {
  Stroke stroke{kind, {}};
  for (int i = 0; i <= 24; ++i) {
    const double at = angle * i / 24;
    stroke.points.push_back(ToPoint(centre + radii.cwiseProduct(Vector2d(std::cos(at), std::sin(at)))));
  }
  if (angle > 6) stroke.points.back() = stroke.points.front();
  return stroke;
}

/// A head, two eyes, a nose of two points, a mouth, two brows; stroke i is of kind i.
std::vector<Stroke> Face() {
  return {Ellipse(0, {128, 128}, {60, 85}),  Ellipse(1, {105, 110}, {12, 5}),    Ellipse(2, {151, 110}, {12, 5}),
          {3, {{128, 115}, {126, 140}}},     Ellipse(4, {128, 165}, {22, 8}, 3), Ellipse(5, {105, 98}, {14, -5}, 3),
          Ellipse(6, {151, 98}, {14, -5}, 3)};
}

AugmentationOptions Strength(double strength) {
  AugmentationOptions options;
  options.strength = strength;
  return options;
}

/// Strength 1 and no effect.
AugmentationOptions Nothing() {
  AugmentationOptions options = Strength(1);
  for (double* effect : {&options.removal, &options.stroke_shift_px, &options.drawing_shift_px, &options.width,
                         &options.retrace, &options.retrace_px, &options.tremor_px, &options.gaps, &options.shift_px,
                         &options.scale, &options.rotation_degrees})
    *effect = 0;
  return options;
}

AugmentedSketch Draw(const AugmentationOptions& options, uint64_t seed, const std::vector<Stroke>& strokes = Face()) {
  Rng rng(seed);
  return Augment(strokes, options, rng);
}

void ExpectSameStrokes(const std::vector<Stroke>& strokes, const std::vector<Stroke>& expected) {
  ASSERT_EQ(strokes.size(), expected.size());
  for (size_t i = 0; i < strokes.size(); ++i) {
    EXPECT_EQ(strokes[i].kind, expected[i].kind);
    EXPECT_EQ(strokes[i].points, expected[i].points);
  }
}

TEST(Augment, OfStrengthZeroGivesTheStrokesBackBitForBit) {
  EXPECT_EQ(AugmentationOptions().strength, 0);
  const AugmentedSketch sketch = Draw({}, 1);
  ExpectSameStrokes(sketch.strokes, Face());
  ExpectSameStrokes(sketch.moved, Face());
  EXPECT_EQ(sketch.style.width, render::StrokeStyle().width);
  for (size_t i = 0; i < Face().size(); ++i)
    EXPECT_EQ(sketch.visible[i], std::vector<bool>(Face()[i].points.size(), true));
}

TEST(Augment, IsAFunctionOfTheRandomStream) {
  const AugmentedSketch sketch = Draw(Strength(1), 5), again = Draw(Strength(1), 5), other = Draw(Strength(1), 6);
  ExpectSameStrokes(sketch.strokes, again.strokes);
  ExpectSameStrokes(sketch.moved, again.moved);
  EXPECT_EQ(sketch.style.width, again.style.width);
  EXPECT_EQ(sketch.visible, again.visible);
  EXPECT_NE(sketch.moved[0].points, other.moved[0].points);
}

TEST(Augment, KeepsEveryPointInItsPlaceAndClosedStrokesClosed) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const AugmentedSketch sketch = Draw(Strength(2), seed);
    ASSERT_EQ(sketch.moved.size(), Face().size());
    ASSERT_EQ(sketch.visible.size(), Face().size());
    for (size_t i = 0; i < Face().size(); ++i) {
      EXPECT_EQ(sketch.moved[i].kind, Face()[i].kind);
      EXPECT_EQ(sketch.moved[i].points.size(), Face()[i].points.size());
      EXPECT_EQ(sketch.visible[i].size(), Face()[i].points.size());
      EXPECT_EQ(IsClosed(sketch.moved[i]), IsClosed(Face()[i]));
    }
  }
}

TEST(Augment, WhatIsVisibleIsWhatIsDrawn) {
  AugmentationOptions options = Strength(1);
  options.gaps = 1;
  int num_hidden = 0;
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const AugmentedSketch sketch = Draw(options, seed);
    for (size_t i = 0; i < sketch.moved.size(); ++i) {
      for (size_t k = 0; k < sketch.moved[i].points.size(); ++k) {
        const auto shows = [&](const Stroke& stroke) {
          return stroke.kind == sketch.moved[i].kind && std::find(stroke.points.begin(), stroke.points.end(),
                                                                  sketch.moved[i].points[k]) != stroke.points.end();
        };
        EXPECT_EQ(std::any_of(sketch.strokes.begin(), sketch.strokes.end(), shows), sketch.visible[i][k]);
        num_hidden += !sketch.visible[i][k];
      }
    }
    EXPECT_TRUE(std::is_sorted(sketch.strokes.begin(), sketch.strokes.end(),
                               [](const Stroke& a, const Stroke& b) { return a.kind < b.kind; }));
  }
  EXPECT_GT(num_hidden, 100);
}

TEST(Augment, RemovesAShareButNeverAll) {
  AugmentationOptions options = Nothing();
  options.removal = 0.6;
  double sum = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    const size_t num_removed = Face().size() - Draw(options, seed).strokes.size();
    EXPECT_LE(num_removed, 4u);  // 0.6 of 7, rounded.
    sum += double(num_removed) / double(Face().size());
  }
  EXPECT_NEAR(sum / 400, 0.3, 0.03);
  options.removal = 1;
  options.strength = 4;
  for (uint64_t seed = 0; seed < 100; ++seed) EXPECT_FALSE(Draw(options, seed).strokes.empty());
}

TEST(Augment, StaysInTheCanvas) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    AugmentationOptions options = Strength(4);
    options.shift_px = 100;
    options.tremor_px = options.retrace_px = 0;
    for (const Stroke& stroke : Draw(options, seed).strokes) {
      for (const auto& [x, y] : stroke.points) {
        EXPECT_GE(std::min(x, y), 3.19f);  // 10 of 800 pixels.
        EXPECT_LE(std::max(x, y), 252.81f);
      }
    }
  }
}

TEST(Augment, LeavesTheCanvasOnlyAsFarAsBefore) {
  auto large = Face();
  large.push_back({7, {{-20, 100}, {128, 100}, {200, 300}}});
  AugmentationOptions options = Nothing();
  ExpectSameStrokes(Draw(options, 1, large).strokes, large);
  options.shift_px = 60;
  options.drawing_shift_px = 10;
  for (uint64_t seed = 0; seed < 50; ++seed) {
    for (const Stroke& stroke : Draw(options, seed, large).strokes) {
      for (const auto& [x, y] : stroke.points) {
        EXPECT_GE(x, -20.01f);
        EXPECT_LE(y, 300.01f);
        EXPECT_GE(y, 3.19f);
        EXPECT_LE(x, 252.81f);
      }
    }
  }
}

TEST(Augment, PlacesTheDrawingByASimilarity) {
  AugmentationOptions options = Nothing();
  options.shift_px = 10;
  options.scale = 0.2;
  options.rotation_degrees = 20;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const AugmentedSketch sketch = Draw(options, seed);
    const auto edge = [](const std::vector<Stroke>& strokes, size_t i) -> Vector2d {
      return ToVector(strokes[i].points[1]) - ToVector(strokes[i].points[0]);
    };
    const double factor = edge(sketch.moved, 3).norm() / edge(Face(), 3).norm();
    EXPECT_GE(factor, std::exp(-0.2) - 1e-4);
    EXPECT_LE(factor, std::exp(0.2) + 1e-4);
    const auto turn = [&](size_t i) {
      const Vector2d a = edge(Face(), i), b = edge(sketch.moved, i);
      return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    };
    EXPECT_LE(std::abs(turn(3)), 20 * std::numbers::pi / 180 + 1e-4);
    for (size_t i = 0; i < Face().size(); ++i) {
      EXPECT_NEAR(edge(sketch.moved, i).norm() / edge(Face(), i).norm(), factor, 1e-3);
      EXPECT_NEAR(turn(i), turn(3), 1e-3);
    }
  }
}

TEST(Augment, GapsHaveTheirLength) {
  AugmentationOptions options = Nothing();
  options.gaps = 1;
  options.gap_px = 8;
  double sum = 0;
  int num_gaps = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const AugmentedSketch sketch = Draw(options, seed);
    for (size_t i = 0; i < Face().size(); ++i) {
      double missing = StrokeArc(Face()[i]).length();
      for (const Stroke& piece : sketch.strokes)
        if (piece.kind == int(i)) missing -= StrokeArc(piece).length();
      if (missing < 1e-3) continue;
      EXPECT_GT(missing, 4 - 0.1);  // Cutting a polyline between its points takes nothing else away.
      EXPECT_LT(missing, 12 + 0.1);
      EXPECT_LE(2 * missing, StrokeArc(Face()[i]).length() + 0.1);
      sum += missing;
      ++num_gaps;
    }
  }
  EXPECT_NEAR(sum / num_gaps, 8, 0.4);
  EXPECT_NEAR(num_gaps, 0.5 * 200 * double(Face().size()), 100);
}

TEST(Augment, RetracesWholeStrokesAtTheirRootMeanSquare) {
  AugmentationOptions options = Nothing();
  options.retrace = 1;
  options.retrace_px = 2;
  double square_sum = 0;
  int num_points = 0, num_retraced = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const AugmentedSketch sketch = Draw(options, seed);
    for (size_t k = 1; k < sketch.strokes.size(); ++k) {
      const Stroke &line = sketch.strokes[k - 1], &second = sketch.strokes[k];
      if (line.kind != second.kind) continue;
      ++num_retraced;
      ASSERT_EQ(line.points, Face()[size_t(line.kind)].points);
      ASSERT_EQ(second.points.size(), line.points.size());
      for (size_t i = 0; i < line.points.size(); ++i, ++num_points)
        square_sum += (ToVector(second.points[i]) - ToVector(line.points[i])).squaredNorm() / 2;
    }
  }
  EXPECT_NEAR(num_retraced, 0.5 * 200 * double(Face().size()), 100);
  EXPECT_NEAR(std::sqrt(square_sum / num_points), 2, 0.2);
}

TEST(Augment, TremorAndWidthStayWithinTheirSizes) {
  AugmentationOptions options = Nothing();
  options.tremor_px = 1;
  options.width = 0.5;
  double square_sum = 0, least = 9, greatest = 0;
  int num_points = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    const AugmentedSketch sketch = Draw(options, seed);
    for (size_t i = 0; i < Face()[0].points.size(); ++i, ++num_points)
      square_sum += (ToVector(sketch.moved[0].points[i]) - ToVector(Face()[0].points[i])).squaredNorm() / 2;
    least = std::min(least, sketch.style.width);
    greatest = std::max(greatest, sketch.style.width);
  }
  EXPECT_NEAR(std::sqrt(square_sum / num_points), 1 / std::sqrt(3), 0.05);  // Uniform in [0, 1] px.
  EXPECT_GE(least, 1.5 * std::exp(-0.5));
  EXPECT_LE(greatest, 1.5 * std::exp(0.5));
  EXPECT_GT(greatest / least, 2);
}

TEST(Augment, IsStrongerWithMoreStrength) {
  double last = 0;
  for (const double strength : {0.0, 0.5, 1.0, 2.0}) {
    double sum = 0;
    for (uint64_t seed = 0; seed < 50; ++seed) {
      const AugmentedSketch sketch = Draw(Strength(strength), seed);
      for (size_t i = 0; i < Face()[0].points.size(); ++i)
        sum += (ToVector(sketch.moved[0].points[i]) - ToVector(Face()[0].points[i])).norm();
    }
    if (strength > 0) {
      EXPECT_GT(sum, 1.3 * last);
    }
    last = sum;
  }
}

TEST(Augment, TakesEmptyDrawings) {
  EXPECT_TRUE(Draw(Strength(1), 1, {}).strokes.empty());
  const AugmentedSketch sketch = Draw(Strength(1), 1, {Stroke{2, {}}, Stroke{3, {{5, 5}}}});
  EXPECT_EQ(sketch.moved[0].points.size(), 0u);
  EXPECT_EQ(sketch.moved[1].points.size(), 1u);
}

TEST(AugmentationOptions, AreParsedAndHeldInTheirRanges) {
  const auto options = ParseOptions<AugmentationOptions>({{"strength", 1}, {"tremor_px", 0.25}});
  EXPECT_EQ(options.strength, 1);
  EXPECT_EQ(options.tremor_px, 0.25);
  EXPECT_EQ(ToJson(ParseOptions<AugmentationOptions>(ToJson(options))), ToJson(options));
  testing::ExpectError([] { ParseOptions<AugmentationOptions>({{"removal", 1.5}}); }, "removal");
  testing::ExpectError([] { ParseOptions<AugmentationOptions>({{"strength", -1}}); }, "strength");
  testing::ExpectError([] { ParseOptions<AugmentationOptions>({{"tremour_px", 1}}); }, "tremor_px");
}

}  // namespace
}  // namespace daumier::datasets
