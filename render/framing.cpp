#include "render/framing.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// Share of the length of all strokes that may lie beyond each side of the core box.
constexpr double kShareOutside = 0.02;
/// A stroke belongs to the drawing if it comes nearer to the core box than this share of the box's longer side.
constexpr double kReach = 0.15;

/// Scribbles much longer than the sheet is wide are sampled more coarsely.
constexpr double kMostSamples = 1e6;

struct Sample {
  double coordinate, length;
};

/// The coordinate below which `share` of the length lies.
double WeightedQuantile(std::vector<Sample> samples, double share) {
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.coordinate < b.coordinate; });
  double total = 0.0, sum = 0.0;
  for (const auto& sample : samples) total += sample.length;
  for (const auto& sample : samples) {
    sum += sample.length;
    if (sum >= share * total) return sample.coordinate;
  }
  return samples.back().coordinate;
}

AlignedBox2d BoxOf(const Stroke& stroke) {
  AlignedBox2d box;
  for (const auto& [x, y] : stroke.points) {
    DAUMIER_CHECK(std::isfinite(x) && std::isfinite(y), "a point of the drawing is ({}, {})", x, y);
    box.extend(Vector2d(x, y));
  }
  return box;
}

/// The box that holds all but the outermost lengths of the strokes.
AlignedBox2d CoreBox(const std::vector<Stroke>& strokes, double step) {
  double total_length = 0.0;
  for (const auto& stroke : strokes)
    for (size_t i = 1; i < stroke.points.size(); ++i)
      total_length += std::hypot(double(stroke.points[i][0]) - stroke.points[i - 1][0],
                                 double(stroke.points[i][1]) - stroke.points[i - 1][1]);
  step = std::max(step, total_length / kMostSamples);
  std::array<std::vector<Sample>, 2> samples;
  for (const auto& stroke : strokes) {
    for (size_t i = 1; i < stroke.points.size(); ++i) {
      const Vector2d from(stroke.points[i - 1][0], stroke.points[i - 1][1]);
      const Vector2d to(stroke.points[i][0], stroke.points[i][1]);
      const double length = (to - from).norm();
      const int num_parts = std::max(1, static_cast<int>(std::ceil(length / step)));
      for (int part = 0; part < num_parts; ++part) {
        const Vector2d point = from + (part + 0.5) / num_parts * (to - from);
        for (int axis = 0; axis < 2; ++axis) samples[axis].push_back({point[axis], length / num_parts});
      }
    }
  }
  AlignedBox2d box;
  if (samples[0].empty()) return box;
  for (const double share : {kShareOutside, 1.0 - kShareOutside}) {
    box.extend(Vector2d(WeightedQuantile(samples[0], share), WeightedQuantile(samples[1], share)));
  }
  return box;
}

}  // namespace

FramedDrawing FrameDrawing(const Drawing& drawing, const FrameOptions& options) {
  AlignedBox2d whole;
  for (const auto& stroke : drawing.strokes) whole.extend(BoxOf(stroke));
  DAUMIER_CHECK(!whole.isEmpty() && whole.sizes().maxCoeff() > 0.0, "the drawing has no extent");
  constexpr double kNumSteps = 500.0;
  AlignedBox2d reach = CoreBox(drawing.strokes, whole.sizes().maxCoeff() / kNumSteps);
  if (reach.isEmpty()) reach = whole;
  const double margin = kReach * reach.sizes().maxCoeff();
  reach = AlignedBox2d(reach.min().array() - margin, reach.max().array() + margin);

  FramedDrawing framed;
  for (const auto& stroke : drawing.strokes) {
    const AlignedBox2d own = BoxOf(stroke);
    if (stroke.points.empty() || !reach.intersects(own)) continue;
    framed.box.extend(own);
    framed.strokes.push_back(stroke);
  }
  const Vector2d size = framed.box.sizes().cwiseMax(1e-9 * whole.sizes().maxCoeff());
  framed.placement.scale = kSketchCanvas * std::min(options.curve_height / size.y(), options.max_width / size.x());
  framed.placement.shift = Vector2d::Constant(0.5 * kSketchCanvas) - framed.placement.scale * framed.box.center();
  return framed;
}

std::vector<Stroke> FrameStrokes(const Drawing& drawing, const FrameOptions& options) {
  const FramedDrawing framed = FrameDrawing(drawing, options);
  return MapToCanvas(framed.strokes, framed.placement);
}

namespace {

/// Exactly the identity for a turn of 0.
Eigen::Matrix2d PlacementRotation(const Placement& placement) {
  const double angle = placement.turn_degrees * std::numbers::pi / 180;
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

}  // namespace

Placement PlacementFrom(double a, double b, const Vector2d& shift) {
  return {std::hypot(a, b), shift, std::atan2(b, a) * 180 / std::numbers::pi};
}

Eigen::Matrix2d LinearPart(const Placement& placement) {
  return placement.scale * PlacementRotation(placement);
}

Vector2d ToCanvas(const Placement& placement, const Vector2d& p_in_sheet) {
  return placement.scale * (PlacementRotation(placement) * p_in_sheet) + placement.shift;
}

Vector2d ToSheet(const Placement& placement, const Vector2d& p_in_canvas) {
  return PlacementRotation(placement).transpose() * (p_in_canvas - placement.shift) / placement.scale;
}

Placement Inverse(const Placement& placement) {
  Placement inverse{.scale = 1 / placement.scale, .turn_degrees = -placement.turn_degrees};
  inverse.shift = -ToCanvas(inverse, placement.shift);
  return inverse;
}

Placement Composed(const Placement& outer, const Placement& inner) {
  return {outer.scale * inner.scale, ToCanvas(outer, inner.shift), outer.turn_degrees + inner.turn_degrees};
}

std::vector<Stroke> MapToCanvas(const std::vector<Stroke>& strokes, const Placement& placement) {
  const Eigen::Matrix2d rotation = PlacementRotation(placement);
  std::vector<Stroke> placed = strokes;
  for (auto& stroke : placed) {
    for (auto& point : stroke.points) {
      const Vector2d on_canvas = placement.scale * (rotation * Vector2d(point[0], point[1])) + placement.shift;
      point = {static_cast<float>(on_canvas.x()), static_cast<float>(on_canvas.y())};
    }
  }
  return placed;
}

Json PlacementToJson(const Placement& placement) {
  Json json = {{"scale", placement.scale}, {"shift", {placement.shift.x(), placement.shift.y()}}};
  if (placement.turn_degrees != 0) json["turn_degrees"] = placement.turn_degrees;
  return json;
}

Placement PlacementFromJson(const Json& json) {
  try {
    const Json& shift = json.at("shift");
    DAUMIER_CHECK(shift.size() == 2, "the frame's shift has {} numbers, expected 2", shift.size());
    const Placement placement{json.at("scale").get<double>(),
                              {shift.at(0).get<double>(), shift.at(1).get<double>()},
                              json.value("turn_degrees", 0.0)};
    DAUMIER_CHECK(placement.scale > 0, "the frame's scale is {:g}, expected a number > 0", placement.scale);
    return placement;
  } catch (const Json::exception& error) {
    throw Error(
        fmt::format("the frame is malformed ({}); expected {{\"scale\": S, \"shift\": [X, Y]}}", TextOf(error)));
  }
}

Json HomographyToJson(const Eigen::Matrix3d& homography) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) rows.push_back({homography(row, 0), homography(row, 1), homography(row, 2)});
  return rows;
}

Eigen::Matrix3d HomographyFromJson(const Json& json) {
  Eigen::Matrix3d homography;
  try {
    const auto rows = json.get<std::array<std::array<double, 3>, 3>>();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) homography(row, column) = rows[size_t(row)][size_t(column)];
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the homography is malformed ({}); expected three rows of three numbers", TextOf(error)));
  }
  DAUMIER_CHECK(homography.determinant() != 0, "the homography is singular");
  return homography;
}

}  // namespace daumier::render
