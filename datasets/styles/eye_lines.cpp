#include "datasets/styles/eye_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using enum faces::FacePoint;

constexpr int kLastOfEye = EyeShape::kPoints - 1, kMiddleOfEye = EyeShape::kMiddle;

/// The points of an eye by side: outer, inner, top, bottom.
constexpr std::array<std::array<faces::FacePoint, 4>, 2> kEyePoints = {
    {{kEyeRightOuter, kEyeRightInner, kEyeRightTop, kEyeRightBottom},
     {kEyeLeftOuter, kEyeLeftInner, kEyeLeftTop, kEyeLeftBottom}}};

/// How the eyes of a drawing are drawn.
struct EyeStyle {
  enum class Kind { kAlmond, kUpperLid, kCircle, kDot, kDash } kind;
  bool has_iris, has_pupil, has_solid_iris, has_lashes, has_double_lid, has_bags;
  double iris_size;             ///< Radius in widths of the eye.
  Vector2d gaze;                ///< Widths of the eye.
  double lower_from, lower_to;  ///< Shares of the lower lid that are drawn.
  double circle_x, circle_y, mark_size, dash_angle, crease;
  int num_lashes;
};

EyeStyle DrawStyle(const DrawingContext& drawing) {
  const EyeStyles& styles = drawing.styles.eyes;
  const bool is_doodle = drawing.character == DrawingCharacter::kDoodle;
  const bool is_cartoon = drawing.character == DrawingCharacter::kCartoon;
  EyeStyle style{};
  style.kind = static_cast<EyeStyle::Kind>(
      DrawByWeight<5>({styles.almond, styles.upper_lid, styles.circle, styles.dot, styles.dash}, drawing.rng));
  style.has_iris = style.kind == EyeStyle::Kind::kUpperLid || drawing.Happens(styles.iris);
  style.has_solid_iris = drawing.Happens(styles.solid_iris);
  style.has_pupil = drawing.Happens(styles.pupil);
  style.has_lashes = drawing.Happens(styles.lashes);
  style.has_double_lid = drawing.Happens(styles.double_lid);
  style.has_bags = drawing.Happens(styles.bags);
  style.iris_size = is_cartoon  ? drawing.Uniform(0.1, 0.26)
                    : is_doodle ? drawing.Uniform(0.08, 0.25)
                                : drawing.Uniform(0.15, 0.24);
  const double roaming = drawing.Happens(0.3) ? 0.16 : 0.04;
  style.gaze = {Deviate(roaming, drawing.rng), Deviate(roaming / 3, drawing.rng)};
  style.lower_from = 0, style.lower_to = 1;
  if (!is_doodle && drawing.Happens(0.3)) {
    style.lower_from = drawing.Uniform(0, 0.3);
    style.lower_to = drawing.Uniform(0.7, 1);
  }
  style.circle_x = drawing.Uniform(0.75, 1.1);
  style.circle_y = drawing.Uniform(0.6, 1.25);
  style.mark_size = drawing.Uniform(0.025, 0.08);
  style.dash_angle = drawing.Happens(0.6) ? drawing.Uniform(75, 105) : drawing.Uniform(-15, 15);
  style.crease = drawing.Uniform(0.05, 0.12);
  style.num_lashes = drawing.Count(3, 7);
  return style;
}

Vector2d CentreOf(const EyeShape& eye) {
  return (eye.upper.front() + eye.upper.back() + eye.upper[kMiddleOfEye] + eye.lower[kMiddleOfEye]) / 4;
}

double WidthOf(const EyeShape& eye) {
  return (eye.upper.front() - eye.upper.back()).norm();
}

/// Both lids as a polygon.
Polyline OpeningOf(const EyeShape& eye) {
  return Joined(eye.upper, Reversed(eye.lower));
}

void DrawLashes(const DrawingContext& drawing, const Polyline& lid, double down, double width, int count) {
  const Vector2d middle = (lid.front() + lid.back()) / 2;
  for (int i = 0; i < count; ++i) {
    const Vector2d root = AtShare(lid, drawing.Uniform(0, 0.12) + 0.6 * i / count);
    const Vector2d out = (root - middle).normalized() * 0.6 + Vector2d(0, down);
    const double length = width * drawing.Uniform(0.1, 0.22);
    drawing.sheet.AddMark(DrawnPart::kSkin, faces::LineLabel::kOther, {root, root + length * out.normalized()});
  }
}

void DrawClosedEye(const DrawingContext& drawing, const EyeShape& eye, const EyeStyle& style, size_t side) {
  const auto [outer, inner, top, bottom] = kEyePoints[side];
  const bool is_laughing = drawing.Happens(0.2);
  Polyline line = Mixed(eye.upper, eye.lower, is_laughing ? 0.1 : drawing.Uniform(0.7, 1.0));
  if (is_laughing || eye.is_closed) {
    // Flat lids are bent, up where they laugh.
    const double bulge = WidthOf(eye) * drawing.Uniform(0.05, 0.25) * (is_laughing ? -1 : 1);
    for (int i = 0; i <= kLastOfEye; ++i) line[size_t(i)].y() += bulge * std::sin(std::numbers::pi * i / kLastOfEye);
  }
  drawing.sheet.Add(EyePart(side), faces::LineLabel::kUpperLid, line,
                    {{outer, 0}, {inner, kLastOfEye}, {top, kMiddleOfEye}, {bottom, kMiddleOfEye}});
  drawing.sheet.eyes[side] = faces::EyeState::kClosed;
  drawing.sheet.eye_centres[side] = (line.front() + line.back() + 2 * line[kMiddleOfEye]) / 4;
  if (!is_laughing && (style.has_lashes || drawing.Happens(0.3)))
    DrawLashes(drawing, line, 0.8, WidthOf(eye), style.num_lashes);
}

/// A crease above the upper lid, and lines below the eye.
void DrawLidLines(const DrawingContext& drawing, const EyeShape& eye, const EyeStyle& style) {
  const double width = WidthOf(eye);
  if (style.has_double_lid) {
    Polyline crease = Part(eye.upper, 0.08, drawing.Uniform(0.75, 0.95), 9);
    for (size_t i = 0; i < crease.size(); ++i) crease[i].y() -= width * style.crease * (1 + 0.5 * double(i) / 8);
    drawing.sheet.Add(DrawnPart::kSkin, faces::LineLabel::kWrinkle, crease);
  }
  if (style.has_bags) {
    const double from = drawing.Uniform(0.1, 0.5);
    Polyline bag = Part(eye.lower, from, drawing.Uniform(0.7, 0.95), 7);
    for (Vector2d& point : bag) point.y() += width * (0.12 + style.crease);
    drawing.sheet.Add(DrawnPart::kSkin, faces::LineLabel::kWrinkle, bag);
  }
}

void DrawIris(const DrawingContext& drawing, const Polyline& opening, const Vector2d& centre, double width,
              const EyeStyle& style, size_t side) {
  const double radius = width * style.iris_size;
  const Vector2d middle = centre + width * style.gaze;
  const DrawnPart part = EyePart(side);
  const Polyline circle = EllipseArc(middle, radius, radius, -100, 260, 21);
  if (style.has_solid_iris) {
    Polyline disc;
    for (const LinePiece& piece : Inside(circle, opening)) disc = Joined(std::move(disc), piece.points);
    StyledLine& iris = drawing.sheet.AddMark(part, faces::LineLabel::kIris, disc);
    iris.filled = true;
    return;
  }
  for (const LinePiece& piece : Inside(circle, opening))
    drawing.sheet.Add(part, faces::LineLabel::kIris, piece.points).care = LineCare::kShort;
  if (!style.has_pupil) return;
  const double pupil = radius * drawing.Uniform(0.3, 0.55);
  StyledLine& dot = drawing.sheet.AddMark(part, faces::LineLabel::kIris, EllipseArc(middle, pupil, pupil, 0, 360, 11));
  dot.filled = drawing.Happens(0.7);
}

void DrawLids(const DrawingContext& drawing, const EyeShape& eye, const EyeStyle& style, size_t side) {
  const auto [outer, inner, top, bottom] = kEyePoints[side];
  LineSheet& sheet = drawing.sheet;
  const bool sees_inner = drawing.shape.view != faces::DrawnView::kProfile;
  std::vector<LineAnchor> on_upper = {{outer, 0}, {top, kMiddleOfEye}};
  if (sees_inner) on_upper.push_back({inner, kLastOfEye});
  const bool is_whole = style.lower_from == 0 && style.lower_to == 1;
  if (style.kind == EyeStyle::Kind::kAlmond && is_whole && sees_inner && drawing.Happens(0.4)) {
    const Polyline back = Reversed(eye.lower);
    Polyline loop = eye.upper;
    loop.insert(loop.end(), back.begin() + 1, back.end());
    on_upper.push_back({bottom, kLastOfEye + kLastOfEye - kMiddleOfEye});
    StyledLine& line = sheet.Add(EyePart(side), faces::LineLabel::kUpperLid, std::move(loop), on_upper);
    std::fill(line.labels.begin() + kLastOfEye, line.labels.end(), faces::LineLabel::kLowerLid);
  } else {
    sheet.Add(EyePart(side), faces::LineLabel::kUpperLid, eye.upper, on_upper).width = drawing.Happens(0.3) ? 1.6 : 1;
    if (style.kind == EyeStyle::Kind::kAlmond) {
      const auto from = static_cast<size_t>(std::lround(style.lower_from * kLastOfEye));
      const auto to = static_cast<size_t>(std::lround(style.lower_to * kLastOfEye));
      const Polyline lower(eye.lower.begin() + ptrdiff_t(from), eye.lower.begin() + ptrdiff_t(to) + 1);
      std::vector<LineAnchor> on_lower = {{bottom, kMiddleOfEye - static_cast<int>(from)}};
      if (from == 0) on_lower.push_back({outer, 0});
      if (to == kLastOfEye && sees_inner) on_lower.push_back({inner, static_cast<int>(lower.size()) - 1});
      sheet.Add(EyePart(side), faces::LineLabel::kLowerLid, lower, on_lower);
    }
  }
  sheet.eyes[side] = faces::EyeState::kOpen;
  sheet.eye_centres[side] = CentreOf(eye);
  if (style.has_iris) DrawIris(drawing, OpeningOf(eye), CentreOf(eye), WidthOf(eye), style, side);
  if (style.has_lashes) DrawLashes(drawing, eye.upper, -0.8, WidthOf(eye), style.num_lashes);
  DrawLidLines(drawing, eye, style);
}

/// An oval from the outer corner over the top and the bottom back to it.
void DrawRoundEye(const DrawingContext& drawing, const EyeShape& eye, const EyeStyle& style, size_t side) {
  const auto [outer, inner, top, bottom] = kEyePoints[side];
  const Vector2d centre = CentreOf(eye);
  const double half = WidthOf(eye) / 2;
  const double half_x = half * style.circle_x * drawing.Uniform(0.95, 1.05);
  const double half_y = half * style.circle_y * drawing.Uniform(0.9, 1.1);
  const bool is_right = eye.upper.front().x() < eye.upper.back().x();
  const Polyline oval =
      is_right ? EllipseArc(centre, half_x, half_y, -180, 180, 25) : EllipseArc(centre, half_x, half_y, 0, -360, 25);
  StyledLine& line = drawing.sheet.Add(EyePart(side), faces::LineLabel::kUpperLid, oval,
                                       {{outer, 0}, {top, 6}, {inner, 12}, {bottom, 18}});
  std::fill(line.labels.begin() + 12, line.labels.end(), faces::LineLabel::kLowerLid);
  drawing.sheet.eyes[side] = faces::EyeState::kOpen;
  drawing.sheet.eye_centres[side] = centre;
  if (style.has_iris) {
    // Somewhere inside, as a doodle has it.
    EyeStyle free = style;
    const double room = std::min(half_x, half_y) / (2 * half);
    free.iris_size = std::min(style.iris_size, 0.7 * room);
    free.gaze *= room / 0.25;
    DrawIris(drawing, oval, centre, 2 * half, free, side);
  }
  if (style.has_lashes)
    DrawLashes(drawing, Polyline(oval.begin(), oval.begin() + 13), -0.8, 2 * half, style.num_lashes);
  DrawLidLines(drawing, eye, style);
}

void DrawMarkEye(const DrawingContext& drawing, const EyeShape& eye, const EyeStyle& style, size_t side) {
  const Vector2d centre = CentreOf(eye);
  const double size = style.mark_size * drawing.unit() * drawing.Uniform(0.85, 1.15);
  if (style.kind == EyeStyle::Kind::kDot) {
    StyledLine& dot = drawing.sheet.AddMark(EyePart(side), faces::LineLabel::kIris,
                                            EllipseArc(centre, size, size * drawing.Uniform(0.8, 1.3),
                                                       drawing.Uniform(0, 180), drawing.Uniform(340, 700), 13));
    dot.filled = drawing.Happens(0.7);
  } else {
    const double angle = (style.dash_angle + Deviate(6, drawing.rng)) * std::numbers::pi / 180;
    const Vector2d arm = 2.2 * size * Vector2d(std::cos(angle), std::sin(angle));
    drawing.sheet.Add(EyePart(side), faces::LineLabel::kIris, {centre - arm, centre, centre + arm}).care =
        LineCare::kShort;
  }
  drawing.sheet.eye_centres[side] = centre;
}

}  // namespace

void DrawEyes(const DrawingContext& drawing) {
  const EyeStyles& styles = drawing.styles.eyes;
  const EyeStyle style = DrawStyle(drawing);
  const bool both_closed = drawing.Happens(styles.closed);
  const size_t winking = drawing.Happens(styles.wink) ? drawing.rng.Below(2) : 2;
  const size_t missing = drawing.Happens(styles.one_missing) ? drawing.rng.Below(2) : 2;
  for (size_t side = 0; side < 2; ++side) {
    const EyeShape& eye = drawing.shape.eyes[side];
    if (!eye.is_seen() || side == missing) continue;
    using enum EyeStyle::Kind;
    const bool is_mark = style.kind == kDot || style.kind == kDash;
    if (!is_mark && (eye.is_closed || both_closed || side == winking))
      DrawClosedEye(drawing, eye, style, side);
    else if (is_mark)
      DrawMarkEye(drawing, eye, style, side);
    else if (style.kind == kCircle && drawing.shape.view != faces::DrawnView::kProfile)
      DrawRoundEye(drawing, eye, style, side);
    else
      DrawLids(drawing, eye, style, side);
  }
}

}  // namespace daumier::datasets
