#include "fitting/frame_search.h"

#include "tests/fitting/projected_face.h"
#include "tests/support/cancelled_task.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

using Sketch = std::vector<render::Stroke>;

/// A network that predicts the same face always.
class FrameSearchTest : public ::testing::Test {
 protected:
  FrameSearchTest() : curves_(CurveStrokes(seen_.curves.offsets, seen_.Points(seen_.Face(1, 1)))) {}

  CurvesOfSketches Always() {
    return [this](const std::vector<Sketch>& sketches) {
      num_tried_ += int(sketches.size());
      return std::vector<Sketch>(sketches.size(), curves_);
    };
  }
  /// The face on another sheet, with lines around it that belong to no face.
  render::Drawing OnASheet(const Sketch& more) const {
    Sketch strokes = curves_;
    strokes.insert(strokes.end(), more.begin(), more.end());
    return {1000, 1000, render::MapToCanvas(strokes, {2.0, {70, -30}})};
  }
  static double Error(const FoundFrame& found) {
    // The sheet's frame undone: scale 1/2 and back.
    const Eigen::Vector2d shift = found.placement.scale * Eigen::Vector2d(70, -30) + found.placement.shift;
    return 128 * std::abs(2 * found.placement.scale - 1) +
           (shift - (1 - 2 * found.placement.scale) * Eigen::Vector2d(128, 128)).norm();
  }

  ProjectedFace seen_;
  Sketch curves_;
  int num_tried_ = 0;
};

TEST_F(FrameSearchTest, BringsTheDrawingOntoTheFacesCurves) {
  const auto framed = render::FrameDrawing(OnASheet({}));
  const FoundFrame found = FindFrame(framed, Always());
  EXPECT_LT(found.distance_px, 1.0);
  EXPECT_LT(Error(found), 6) << "pixels of the canvas";
  EXPECT_LT(num_tried_, 700);
}

TEST_F(FrameSearchTest, IsNotMisledByHairAndShoulders) {
  // Hair above, and shoulders that make the drawing half as high again.
  const Sketch more = {{0, {{60, 100}, {70, 30}, {128, 5}, {186, 30}, {196, 100}}},
                       {0, {{100, 235}, {95, 260}, {20, 290}}},
                       {0, {{156, 235}, {161, 260}, {236, 290}}}};
  const auto framed = render::FrameDrawing(OnASheet(more));
  const FoundFrame found = FindFrame(framed, Always());
  EXPECT_LT(Error(found), 8);
  EXPECT_LT(found.distance_px, 0.5 * found.start_distance_px);
}

TEST_F(FrameSearchTest, ANoisyDistanceMovesTheFrameLittle) {
  // A network whose face shakes by up to half a pixel with the least change of the sketch.
  const auto shaking = [this](double phase) -> CurvesOfSketches {
    return [this, phase](const std::vector<Sketch>& sketches) {
      std::vector<Sketch> faces;
      for (const Sketch& sketch : sketches) {
        faces.push_back(curves_);
        const double noise = 0.5 * std::sin(phase + 1e3 * sketch[0].points[0][0]);
        for (auto& stroke : faces.back())
          for (auto& point : stroke.points) point[0] += float(noise);
      }
      return faces;
    };
  };
  const auto framed = render::FrameDrawing(OnASheet({}));
  const FoundFrame one = FindFrame(framed, shaking(0.0)), other = FindFrame(framed, shaking(1.0));
  EXPECT_LT(std::abs(std::log(one.placement.scale / other.placement.scale)), 0.01);
  EXPECT_LT((one.placement.scale * Eigen::Vector2d(500, 500) + one.placement.shift -
             other.placement.scale * Eigen::Vector2d(500, 500) - other.placement.shift)
                .norm(),
            1.0);
}

TEST_F(FrameSearchTest, ANoisyFlatValleyMovesTheFrameLittle) {
  // A network whose face takes most of the drawing's size, so that the distance hardly depends on scale, and shakes.
  const auto height = [](const Sketch& sketch) {
    Eigen::AlignedBox2d box;
    for (const auto& stroke : sketch)
      for (const auto& [x, y] : stroke.points) box.extend(Eigen::Vector2d(x, y));
    return box.sizes().y();
  };
  const auto yielding = [&](double phase) -> CurvesOfSketches {
    return [&, phase](const std::vector<Sketch>& sketches) {
      std::vector<Sketch> faces;
      for (const Sketch& sketch : sketches) {
        const double factor = std::pow(height(sketch) / height(curves_), 0.8);
        const double noise = 0.2 * std::sin(phase + 1e3 * sketch[0].points[0][0]);
        faces.push_back(render::MapToCanvas(
            curves_, {factor, (1 - factor) * Eigen::Vector2d(128, 128) + Eigen::Vector2d(noise, noise)}));
      }
      return faces;
    };
  };
  const auto framed = render::FrameDrawing(OnASheet({}));
  double largest = 0;
  for (int phase = 0; phase < 6; ++phase) {
    const FoundFrame found = FindFrame(framed, yielding(phase));
    largest = std::max(largest, std::abs(std::log(2 * found.placement.scale)));
  }
  EXPECT_LT(largest, 0.02);
}

TEST_F(FrameSearchTest, TheWeightsOfNearFramesFallWithTheDistance) {
  const auto framed = render::FrameDrawing(OnASheet({}));
  const FoundFrame found = FindFrame(framed, Always());
  ASSERT_EQ(found.near.size(), 29u);
  EXPECT_EQ(found.near[0].placement.shift, found.placement.shift);
  double sum = 0;
  for (const WeightedFrame& frame : found.near) {
    const double distance =
        DistanceBetween(render::MapToCanvas(framed.strokes, frame.placement), curves_, 0.5, 0.05).two_way();
    EXPECT_NEAR(frame.weight, found.near[0].weight * std::exp((found.distance_px - distance) / 0.05), 1e-9);
    EXPECT_LT(std::abs(std::log(frame.placement.scale / found.placement.scale)), 0.031);
    sum += frame.weight;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST_F(FrameSearchTest, IsNeverWorseThanTheFrameOfTheBoundingBox) {
  const auto framed = render::FrameDrawing({100, 100, {{0, {{10, 10}, {80, 50}, {30, 90}}}}});
  const FoundFrame found = FindFrame(framed, Always(), {.shares = {0.5}, .starts = 1, .rounds = 0});
  EXPECT_LE(found.distance_px, found.start_distance_px);
}

TEST_F(FrameSearchTest, WithoutSharesAndStepsTheBoundingBoxIsReturned) {
  const auto framed = render::FrameDrawing(OnASheet({}));
  const FoundFrame found = FindFrame(framed, Always(), {.shares = {}, .rounds = 0});
  EXPECT_EQ(found.placement.scale, framed.placement.scale);
  EXPECT_EQ(found.placement.shift, framed.placement.shift);
  EXPECT_EQ(found.distance_px, found.start_distance_px);
  EXPECT_EQ(num_tried_, 1);
  ASSERT_EQ(found.near.size(), 1u);
  EXPECT_EQ(found.near[0].weight, 1);
}

TEST(FrameSearchOptions, AreParsed) {
  const auto options = ParseOptions<FrameSearchOptions>(Json{{"shares", {1.0, 0.5}}, {"starts", 2}});
  EXPECT_EQ(options.shares, (std::vector<double>{1.0, 0.5}));
  EXPECT_EQ(options.starts, 2);
}

TEST_F(FrameSearchTest, ACancelledTaskEndsIt) {
  const auto framed = render::FrameDrawing(OnASheet({}));
  EXPECT_THROW(FindFrame(framed, Always(), {}, testing::CancelledTask()), Cancelled);
  EXPECT_EQ(num_tried_, 0);
}

}  // namespace
}  // namespace daumier::fitting
