#include "systems/sketch/drawing_parser.h"

#include "core/error.h"
#include "datasets/styles/styled_dataset.h"
#include "render/heat_map_decoding.h"
#include "systems/sketch/mouth_lines.h"
#include "systems/sketch/parser_outputs.h"
#include "systems/sketch/stroke_network.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace daumier::sketch {
namespace {

using Eigen::Vector2d;
using enum faces::FacePoint;

constexpr double kForehead = 0.45;  // Above the eyes, as a share of the distance from eyes to chin.
constexpr double kEdge = 3;         // Pixels of the canvas at its border where a line may be cut off.

std::vector<float> MirroredPicture(const std::vector<float>& picture, int side) {
  std::vector<float> mirrored(picture.size());
  for (int row = 0; row < side; ++row)
    std::reverse_copy(picture.begin() + row * side, picture.begin() + (row + 1) * side, mirrored.begin() + row * side);
  return mirrored;
}

const std::vector<int>& MirroredPoints() {
  static const std::vector<int> order = [] {
    std::vector<int> points;
    for (int i = 0; i < faces::kNumFacePoints; ++i) points.push_back(int(MirroredPoint(faces::FacePoint(i))));
    return points;
  }();
  return order;
}

const std::vector<int>& SameLabels() {
  static const std::vector<int> order = [] {
    std::vector<int> labels;
    for (int i = 0; i < faces::kNumLineLabels; ++i) labels.push_back(i);
    return labels;
  }();
  return order;
}

FloatArray& OutputOf(NamedArrays& outputs, const char* name) {
  const auto found = outputs.find(name);
  DAUMIER_CHECK(found != outputs.end(), "the network of drawings has no output '{}'", name);
  return found->second;
}

template <size_t N>
std::array<double, N> Mean(const std::array<double, N>& a, const std::array<double, N>& b) {
  std::array<double, N> mean;
  for (size_t i = 0; i < N; ++i) mean[i] = 0.5 * (a[i] + b[i]);
  return mean;
}

/// Probabilities of all states.
struct States {
  std::array<double, faces::kNumMouthStates> mouth;
  std::array<std::array<double, faces::kNumEyeStates>, 2> eyes;
  std::array<double, faces::kNumDrawnViews> view;

  explicit States(std::span<const float> scores) {
    const auto groups = render::StateProbabilities(scores, datasets::kDrawingStateClasses);
    std::ranges::copy(groups[0], mouth.begin());
    std::ranges::copy(groups[1], eyes[0].begin());
    std::ranges::copy(groups[2], eyes[1].begin());
    std::ranges::copy(groups[3], view.begin());
  }
  /// Of the mirror image.
  void Mirror() {
    std::swap(eyes[0], eyes[1]);
    std::swap(view[size_t(faces::DrawnView::kThreeQuarterLeft)], view[size_t(faces::DrawnView::kThreeQuarterRight)]);
  }
};

/// The strokes with more points, so that no two neighbours are farther apart than `step`.
std::vector<render::Stroke> Dense(const std::vector<render::Stroke>& strokes, double step) {
  std::vector<render::Stroke> dense;
  for (const render::Stroke& stroke : strokes) {
    render::Stroke& more = dense.emplace_back();
    more.kind = stroke.kind;
    for (size_t i = 0; i < stroke.points.size(); ++i) {
      if (i > 0) {
        const auto &a = stroke.points[i - 1], &b = stroke.points[i];
        const int pieces = std::max(1, int(std::ceil(std::hypot(b[0] - a[0], b[1] - a[1]) / step)));
        for (int k = 1; k < pieces; ++k) {
          const float t = float(k) / float(pieces);
          more.points.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
        }
      }
      more.points.push_back(stroke.points[i]);
    }
  }
  return dense;
}

render::Placement Centred(const Eigen::AlignedBox2d& box, double turn_degrees, double share) {
  render::Placement frame{.turn_degrees = turn_degrees};
  frame.scale = share * render::kSketchCanvas / std::max(box.sizes().maxCoeff(), 1e-6);
  frame.shift = Vector2d::Constant(0.5 * render::kSketchCanvas) - frame.scale * box.center();
  return frame;
}

}  // namespace

render::Placement FrameOfWhole(const std::vector<render::Stroke>& strokes, double turn_degrees) {
  const render::FramedDrawing framed = render::FrameDrawing({.strokes = strokes});
  const Eigen::Rotation2Dd turn(turn_degrees * std::numbers::pi / 180);
  Eigen::AlignedBox2d box(Vector2d(turn * framed.box.min()));
  box.extend(turn * framed.box.max());
  return Centred(box, turn_degrees, kWholeShare);
}

render::Placement FrameOfPoints(const std::array<Vector2d, faces::kNumFacePoints>& points) {
  const auto at = [&](faces::FacePoint point) { return points[size_t(point)]; };
  const Vector2d eyes = at(kEyeLeftCentre) - at(kEyeRightCentre);
  const double turn = -std::atan2(eyes.y(), eyes.x());
  const Eigen::Rotation2Dd upright(turn);
  Eigen::AlignedBox2d box;
  for (const Vector2d& point : points) box.extend(upright * point);
  const Vector2d between = upright * (0.5 * (at(kEyeRightCentre) + at(kEyeLeftCentre)));
  const double below = std::max((upright * at(kChin)).y() - between.y(), 0.5 * eyes.norm());
  box.extend(between - Vector2d(0, kForehead * below));
  return Centred(box, turn * 180 / std::numbers::pi, kFaceShare);
}

DrawingParser::DrawingParser(const ParserNetworkOptions& network_options,
                             std::shared_ptr<const runtime::NetworkRunner> network, const DrawingParserOptions& options)
    : network_options_(network_options), network_(std::move(network)), options_(options) {}

double ParsedDrawing::confidence() const {
  return std::accumulate(confidences.begin(), confidences.begin() + faces::kNumLandmarkPoints, 0.0) /
         faces::kNumLandmarkPoints;
}

ParsedDrawing DrawingParser::Parse(const std::vector<render::Stroke>& strokes) const {
  ParsedDrawing best = ParseTurned(strokes, 0);
  if (options_.turn && best.confidence() < kUncertainParse) {
    double least = std::max(kCertainTurn, best.confidence() + kMoreCertain);
    for (const double turn : {180.0, 90.0, 270.0}) {
      ParsedDrawing turned = ParseTurned(strokes, turn);
      if (turned.confidence() < least) continue;
      least = turned.confidence();
      best = std::move(turned);
    }
  }
  ReadMouthLines(best);
  return best;
}

ParsedDrawing DrawingParser::ParseTurned(const std::vector<render::Stroke>& strokes, double turn_degrees) const {
  const render::Placement whole = FrameOfWhole(strokes, turn_degrees);
  ParsedDrawing drawing;
  drawing.strokes = Dense(strokes, ParsedDrawing::kLabelStep / whole.scale);
  for (const render::Stroke& stroke : drawing.strokes)
    drawing.labels.emplace_back(stroke.points.size(), faces::LineLabel::kOther);
  for (int round = 0; round < options_.rounds; ++round)
    ParseIn(round == 0 ? whole : FrameOfPoints(drawing.points), drawing);
  return drawing;
}

void DrawingParser::ParseIn(const render::Placement& frame, ParsedDrawing& drawing) const {
  const int side = network_options_.resolution, map_side = network_options_.map_side(),
            label_side = network_options_.label_side();
  const std::vector<render::Stroke> on_canvas = render::MapToCanvas(drawing.strokes, frame);
  const std::vector<float> picture = InkOf(on_canvas, side);
  FloatArray pictures({options_.mirror ? 2 : 1, 1, side, side});
  std::ranges::copy(picture, pictures.row(0));
  if (options_.mirror) std::ranges::copy(MirroredPicture(picture, side), pictures.row(1));
  NamedArrays outputs = network_->Run({{"pictures", std::move(pictures)}});
  FloatArray &maps = OutputOf(outputs, "heat_maps"), &labels = OutputOf(outputs, "labels");
  const FloatArray& scores = OutputOf(outputs, "states");
  States states(RowOf(scores, 0));
  if (options_.mirror) {
    render::AverageWithMirrored({maps.row(0), size_t(maps.row_size())}, RowOf(maps, 1), map_side, map_side,
                                MirroredPoints());
    render::AverageWithMirrored({labels.row(0), size_t(labels.row_size())}, RowOf(labels, 1), label_side, label_side,
                                SameLabels());
    States mirrored(RowOf(scores, 1));
    mirrored.Mirror();
    states.mouth = Mean(states.mouth, mirrored.mouth);
    states.view = Mean(states.view, mirrored.view);
    for (size_t eye = 0; eye < 2; ++eye) states.eyes[eye] = Mean(states.eyes[eye], mirrored.eyes[eye]);
  }
  drawing.frame = frame;
  drawing.mouth = states.mouth;
  drawing.eyes = states.eyes;
  drawing.view = states.view;
  const auto peaks = render::FindPeaks(RowOf(maps, 0), faces::kNumFacePoints, map_side, map_side,
                                       {.deviation = network_options_.deviation});
  const double cell = double(render::kSketchCanvas) / map_side;
  for (size_t i = 0; i < peaks.size(); ++i) {
    drawing.points[i] = render::ToSheet(frame, cell * Vector2d(peaks[i].x, peaks[i].y));
    drawing.confidences[i] = peaks[i].confidence;
  }
  const render::ScoreGrid grid(RowOf(labels, 0), faces::kNumLineLabels, label_side, label_side);
  const double label_cell = double(render::kSketchCanvas) / label_side;
  for (size_t s = 0; s < on_canvas.size(); ++s) {
    for (size_t p = 0; p < on_canvas[s].points.size(); ++p) {
      const auto& at = on_canvas[s].points[p];
      if (std::min(at[0], at[1]) < kEdge || std::max(at[0], at[1]) > render::kSketchCanvas - kEdge) continue;
      drawing.labels[s][p] = faces::LineLabel(grid.ClassAt(at[0] / label_cell, at[1] / label_cell));
    }
  }
}

}  // namespace daumier::sketch
