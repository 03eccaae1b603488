#include "systems/sketch/parsed_face.h"

#include "core/error.h"
#include "datasets/styles/face_lines.h"
#include "systems/sketch/parser_overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::sketch {
namespace {

constexpr double kLeastProfile = 0.6;  // Probability of a profile that is refused.
constexpr double kShownPoint = 0.5;    // Support of a point that the drawing shows.

using Point = faces::FacePoint;
struct FacePart {
  const char* name;
  std::vector<Point> points;
};

const std::vector<FacePart>& FaceParts() {
  using enum faces::FacePoint;
  static const std::vector<FacePart> kParts = {
      {"outline", {kContourRight, kContourLeft, kChin}},
      {"right eye", {kEyeRightOuter, kEyeRightInner, kEyeRightTop, kEyeRightBottom, kEyeRightCentre}},
      {"left eye", {kEyeLeftOuter, kEyeLeftInner, kEyeLeftTop, kEyeLeftBottom, kEyeLeftCentre}},
      {"brows", {kBrowRightOuter, kBrowRightInner, kBrowLeftInner, kBrowLeftOuter}},
      {"nose", {kNoseBottom, kNoseWingRight, kNoseWingLeft}},
      {"mouth", {kMouthRight, kMouthLeft, kLipTop, kLipBottom, kInnerTop, kInnerBottom}}};
  return kParts;
}

}  // namespace

std::vector<render::Stroke> LinesOfFace(const ParsedDrawing& drawing) {
  std::vector<render::Stroke> lines = LabelRuns(drawing);
  std::erase_if(lines, [](const render::Stroke& line) { return !datasets::ShowsFace(faces::LineLabel(line.kind)); });
  return lines.empty() ? drawing.strokes : lines;
}

void RefuseProfile(const ParsedDrawing& drawing) {
  const double profile = drawing.view[size_t(faces::DrawnView::kProfile)];
  if (profile < kLeastProfile) return;
  throw Error(
      fmt::format("the drawing shows a face from the side (probability {:.2f}). Faces are predicted from the front, or "
                  "turned by up to about 60 degrees: draw both eyes",
                  profile));
}

std::vector<std::string> ParseWarnings(const ParsedDrawing& drawing) {
  constexpr double kTurned = 60;  // Degrees.
  std::vector<std::string> warnings;
  if (drawing.confidence() < kLeastConfidence)
    warnings.push_back(
        fmt::format("hardly a face is seen: the points are found with a confidence of {:.2f} (faces by most people 0.7 "
                    "or more). Is it one face from the front, drawn by lines?",
                    drawing.confidence()));
  const double turn = std::remainder(drawing.frame.turn_degrees, 360.0);
  if (std::abs(turn) > kTurned)
    warnings.push_back(fmt::format("the face is not upright on the sheet: it is read turned by {:.0f} degrees", turn));
  return warnings;
}

bool CanShow(faces::LineLabel label, faces::FacePoint point) {
  using enum faces::LineLabel;
  using enum faces::FacePoint;
  switch (point) {
    case kBrowRightOuter:
    case kBrowRightInner:
    case kBrowLeftInner:
    case kBrowLeftOuter:
      return label == kBrow;
    case kNoseBottom:
    case kNoseWingRight:
    case kNoseWingLeft:
      return label == kNose;
    case kMouthRight:
    case kMouthLeft:
    case kLipTop:
    case kLipBottom:
    case kInnerTop:
    case kInnerBottom:
      return label == kUpperLip || label == kLowerLip || label == kInnerMouth;
    case kChin:
    case kContourRight:
    case kContourLeft:
      return label == kSilhouette;
    default:
      return label == kUpperLid || label == kLowerLid || label == kIris;
  }
}

std::array<double, faces::kNumFacePoints> SupportOf(const ParsedDrawing& drawing) {
  std::array<double, faces::kNumFacePoints> squares;
  squares.fill(std::numeric_limits<double>::infinity());
  for (size_t s = 0; s < drawing.strokes.size(); ++s) {
    for (size_t p = 0; p < drawing.strokes[s].points.size(); ++p) {
      const auto& [x, y] = drawing.strokes[s].points[p];
      for (size_t i = 0; i < squares.size(); ++i)
        if (CanShow(drawing.labels[s][p], faces::FacePoint(i)))
          squares[i] = std::min(squares[i], (drawing.points[i] - Eigen::Vector2d(x, y)).squaredNorm());
    }
  }
  std::array<double, faces::kNumFacePoints> support;
  std::ranges::transform(squares, support.begin(), [&](double square) {
    const double beyond = std::max(0.0, drawing.frame.scale * std::sqrt(square) - kSupportTolerance) / kSupportReach;
    return std::exp(-0.5 * beyond * beyond);
  });
  return support;
}

std::vector<std::string> DrawnParts(const ParsedDrawing& drawing) {
  const std::array<double, faces::kNumFacePoints> support = SupportOf(drawing);
  std::vector<std::string> parts;
  for (const FacePart& part : FaceParts()) {
    const auto is_shown = [&](Point point) { return support[size_t(point)] >= kShownPoint; };
    if (3 * size_t(std::ranges::count_if(part.points, is_shown)) >= part.points.size()) parts.emplace_back(part.name);
  }
  const auto has_ear = [](const std::vector<faces::LineLabel>& labels) {
    return 2 * std::ranges::count(labels, faces::LineLabel::kEar) > std::ranges::ssize(labels);
  };
  if (std::ranges::any_of(drawing.labels, has_ear)) parts.emplace_back("ears");
  return parts;
}

}  // namespace daumier::sketch
