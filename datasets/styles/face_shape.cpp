#include "datasets/styles/face_shape.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

/// Shares of a curve's points that have to be seen for it to be drawn.
constexpr double kLeastSeen = 0.6;
/// Distance of the eyes' outer corners over that of eyes and chin, on the neutral ICT face.
constexpr double kUnitOfEyesToChin = 0.84;
constexpr int kEarPoints = 21, kInnerEarPoints = 9;

Vector2d ToPlane(const SketchFacts::Point& point) {
  return {point[0], point[1]};
}

/// The curves and facts of a sketch by their names.
class SketchView {
 public:
  SketchView(const SketchDatabase& sketches, int face, int view) : facts_(sketches.facts(face, view)) {
    const auto strokes = sketches.strokes(face, view);
    const auto& names = sketches.curve_names();
    size_t point = 0;
    for (size_t i = 0; i < strokes.size(); ++i) {
      Polyline line;
      for (const auto& p : strokes[i].points) line.push_back(ToPlane(p));
      if (i >= names.size()) {
        wrinkles_.push_back(std::move(line));
        continue;
      }
      int num_seen = 0;
      for (size_t k = 0; k < line.size(); ++k) num_seen += facts_.visible[point++];
      seen_[names[i]] = line.empty() ? 0 : double(num_seen) / double(line.size());
      curves_[names[i]] = std::move(line);
    }
    is_side_ = curves_.contains("side_profile_upper");
  }

  bool is_side() const { return is_side_; }
  const SketchFacts& facts() const { return facts_; }
  std::vector<Polyline>& wrinkles() { return wrinkles_; }
  Vector2d landmark(size_t i) const { return ToPlane(facts_.landmarks[i]); }
  Vector2d MeanLandmark(size_t begin, size_t end) const {
    Vector2d sum = Vector2d::Zero();
    for (size_t i = begin; i < end; ++i) sum += landmark(i);
    return sum / double(end - begin);
  }
  /// @throws Error if there is no such curve.
  const Polyline& Required(const std::string& name) const {
    const auto curve = curves_.find(name);
    DAUMIER_CHECK(curve != curves_.end() && curve->second.size() >= 2,
                  "sketches lack the curve '{}', which styled profiles need; add it to the annotation of the faces",
                  name);
    return curve->second;
  }
  bool has(const std::string& name) const { return curves_.contains(name); }
  /// Empty if there is no such curve, or too little of it is seen.
  Polyline Seen(const std::string& name) const {
    const auto curve = curves_.find(name);
    if (curve == curves_.end() || seen_.at(name) < kLeastSeen) return {};
    return curve->second;
  }
  /// Where a template has no such curve the line through some landmarks.
  Polyline SeenOr(const std::string& name, std::initializer_list<size_t> landmarks) const {
    if (has(name)) return Seen(name);
    Polyline line;
    for (const size_t i : landmarks) line.push_back(landmark(i));
    return line;
  }

 private:
  SketchFacts facts_;
  std::map<std::string, Polyline> curves_;
  std::map<std::string, double> seen_;
  std::vector<Polyline> wrinkles_;
  bool is_side_ = false;
};

Polyline StartingNear(Polyline line, const Vector2d& start) {
  const bool is_turned = (line.back() - start).squaredNorm() < (line.front() - start).squaredNorm();
  return is_turned ? Reversed(std::move(line)) : line;
}

/// `count` points, an odd number, of which the middle one is where the line is nearest to a point.
Polyline WithMiddle(const Polyline& line, const Vector2d& middle, int count) {
  const double share = std::clamp(ShareNearest(line, middle), 0.15, 0.85);
  Polyline first = Part(line, 0, share, count / 2 + 1);
  const Polyline second = Part(line, share, 1, count / 2 + 1);
  first.insert(first.end(), second.begin() + 1, second.end());
  return first;
}

/// The two lines of a closed curve from the place nearest to `from` to that nearest to `to`; the first one is the
/// upper.
std::array<Polyline, 2> Divided(Polyline loop, const Vector2d& from, const Vector2d& to) {
  if ((loop.front() - loop.back()).squaredNorm() < 1e-12) loop.pop_back();
  std::rotate(loop.begin(), loop.begin() + NearestIndex(loop, from), loop.end());
  const int end = NearestIndex(loop, to);
  Polyline first(loop.begin(), loop.begin() + end + 1), second(loop.begin() + end, loop.end());
  second.push_back(loop.front());
  second = Reversed(std::move(second));
  const auto height = [](const Polyline& line) { return AtShare(line, 0.5).y(); };
  if (height(first) > height(second)) std::swap(first, second);
  return {first, second};
}

EyeShape EyeOf(const SketchView& sketch, const Polyline& upper, const Polyline& lower, size_t side) {
  EyeShape eye;
  if (upper.size() < 2 || lower.size() < 2) return eye;
  const bool is_right = side == 0;
  const Vector2d outer = sketch.landmark(is_right ? 36 : 45);
  const size_t first = is_right ? 37 : 43;
  const Vector2d top = sketch.MeanLandmark(first, first + 2);
  const Vector2d bottom = is_right ? sketch.MeanLandmark(40, 42) : sketch.MeanLandmark(46, 48);
  eye.upper = WithMiddle(StartingNear(upper, outer), top, EyeShape::kPoints);
  eye.lower = WithMiddle(StartingNear(lower, outer), bottom, EyeShape::kPoints);
  eye.upper.front() = eye.lower.front() = (eye.upper.front() + eye.lower.front()) / 2;
  if (!sketch.is_side()) eye.upper.back() = eye.lower.back() = (eye.upper.back() + eye.lower.back()) / 2;
  eye.is_closed = sketch.facts().gaps_mm[side] < kClosedLidsMm;
  return eye;
}

BrowShape BrowOf(const Polyline& loop, const Vector2d& outer, const Vector2d& inner, double unit) {
  BrowShape brow;
  if (loop.size() < 4) return brow;
  if ((loop.front() - loop.back()).norm() > 0.1 * unit) {  // One line: the middle of a brow.
    brow.upper = brow.lower = Resampled(StartingNear(loop, outer), BrowShape::kPoints);
    for (size_t i = 1; i + 1 < brow.upper.size(); ++i) {
      brow.upper[i].y() -= 0.04 * unit;
      brow.lower[i].y() += 0.04 * unit;
    }
    return brow;
  }
  const auto [upper, lower] = Divided(loop, outer, inner);
  if (upper.size() < 2 || lower.size() < 2) return brow;
  brow.upper = Resampled(upper, BrowShape::kPoints);
  brow.lower = Resampled(lower, BrowShape::kPoints);
  return brow;
}

Polyline TopDown(const Polyline& line, int count) {
  if (line.size() < 2) return {};
  return Resampled(line.front().y() > line.back().y() ? Reversed(line) : line, count);
}

void ReadFrontalNose(const SketchView& sketch, double unit, NoseShape& nose) {
  const std::array<const char*, 2> sides = {"right", "left"};
  for (size_t side = 0; side < 2; ++side) {
    const std::string bridge = fmt::format("nose_bridge_{}", sides[side]);
    nose.bridges[side] = TopDown(sketch.Seen(bridge), NoseShape::kBridgePoints);
    nose.wings[side] = TopDown(sketch.Seen(fmt::format("nose_wing_{}", sides[side])), NoseShape::kWingPoints);
    if (sketch.has(bridge)) continue;
    const Vector2d aside((side == 0 ? -0.07 : 0.07) * unit, 0);
    nose.bridges[side] =
        Smooth({sketch.landmark(27) + aside, sketch.landmark(29) + aside, sketch.landmark(side == 0 ? 31 : 35)},
               NoseShape::kBridgePoints);
  }
  const Polyline base = sketch.SeenOr("nose_base", {31, 32, 33, 34, 35});
  if (base.size() >= 2)
    nose.base = WithMiddle(StartingNear(base, sketch.landmark(31)), sketch.landmark(33), NoseShape::kBasePoints);
}

void ReadFrontalMouth(const SketchView& sketch, MouthShape& mouth) {
  const Vector2d right = sketch.landmark(48), left = sketch.landmark(54);
  Polyline lips = sketch.SeenOr("lips", {48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59});
  if (lips.size() < 4) return;
  const auto [top, bottom] = Divided(std::move(lips), right, left);
  const auto inner = [&](const char* name, std::initializer_list<size_t> landmarks, size_t middle) {
    const Polyline line = sketch.SeenOr(name, landmarks);
    return line.size() < 2 ? Polyline{}
                           : WithMiddle(StartingNear(line, right), sketch.landmark(middle), MouthShape::kPoints);
  };
  mouth.inner_top = inner("upper_mouth", {60, 61, 62, 63, 64}, 62);
  mouth.inner_bottom = inner("lower_mouth", {60, 67, 66, 65, 64}, 66);
  if (mouth.inner_top.empty() || mouth.inner_bottom.empty()) {
    mouth.inner_top = mouth.inner_bottom = {};
    return;
  }
  mouth.top = WithMiddle(top, sketch.landmark(51), MouthShape::kPoints);
  mouth.bottom = WithMiddle(bottom, sketch.landmark(57), MouthShape::kPoints);
}

/// Radii between neighbours of a closed line, smoothed a little: extreme vertices alternate.
Polyline SmoothedRing(const Polyline& ring) {
  Polyline smooth(ring.size());
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &before = ring[(i + ring.size() - 1) % ring.size()], &after = ring[(i + 1) % ring.size()];
    smooth[i] = (before + 2 * ring[i] + after) / 4;
  }
  return smooth;
}

Polyline RingOf(const SketchFacts& facts) {
  Polyline ring;
  for (const auto& point : facts.outline) ring.push_back(ToPlane(point));
  return SmoothedRing(ring);
}

/// From index `from` to `to` of a ring, in steps of +1 or -1.
Polyline RingPart(const Polyline& ring, int from, int to, int step) {
  const int count = static_cast<int>(ring.size());
  Polyline part;
  for (int i = from;; i = (i + step + count) % count) {
    part.push_back(ring[size_t(i)]);
    if (i == to) return part;
  }
}

/// The border of the head from temple to temple round the chin, and over the crown.
void ReadRingOutline(const SketchView& sketch, FaceShape& shape) {
  const Polyline ring = RingOf(sketch.facts());
  const int right = NearestIndex(ring, sketch.landmark(0)), left = NearestIndex(ring, sketch.landmark(16));
  const Polyline face = RingPart(ring, right, left, -1);  // Clockwise the chin lies before the right side.
  shape.outline = WithMiddle(face, face[size_t(NearestIndex(face, sketch.landmark(8)))], FaceShape::kOutlinePoints);
  shape.skull = Resampled(RingPart(ring, left, right, -1), FaceShape::kSkullPoints);
}

void ReadFrontalOutline(const SketchView& sketch, FaceShape& shape) {
  if (!sketch.has("jaw") || !sketch.has("cranium")) return ReadRingOutline(sketch, shape);
  const Polyline jaw = StartingNear(sketch.Required("jaw"), sketch.landmark(0));
  const Polyline cranium = StartingNear(sketch.Required("cranium"), sketch.landmark(16));
  const Vector2d chin = jaw[jaw.size() / 2];
  shape.outline = WithMiddle(jaw, chin, FaceShape::kOutlinePoints);
  shape.skull = Resampled(cranium, FaceShape::kSkullPoints);
}

/// Of a turned face the far side is its contour, the near side the line of the jaw.
void ReadTurnedOutline(const SketchView& sketch, FaceShape& shape) {
  if (!sketch.has("jaw")) return ReadRingOutline(sketch, shape);
  const Polyline ring = RingOf(sketch.facts());
  const bool looks_left = sketch.facts().yaw < 0;
  const Polyline jaw = StartingNear(sketch.Required("jaw"), sketch.landmark(looks_left ? 16 : 0));  // Near end first.
  const Vector2d chin = jaw[jaw.size() / 2];
  const Polyline near_half = Part(jaw, 0, ShareNearest(jaw, chin), FaceShape::kOutlinePoints / 2 + 1);
  const int at_chin = NearestIndex(ring, chin);
  // Clockwise from the top: a far side on the left lies behind the chin.
  const int step = looks_left ? 1 : -1;
  int temple = at_chin;
  const int count = static_cast<int>(ring.size());
  while (ring[size_t(temple)].y() > shape.eyes_middle.y() - 0.25 * shape.unit) {
    temple = (temple + step + count) % count;
    if (temple == at_chin) break;
  }
  Polyline far = RingPart(ring, (at_chin + 2 * step + count) % count, temple, step);
  far.insert(far.begin(), chin);
  const Polyline far_half = Resampled(far, FaceShape::kOutlinePoints / 2 + 1);  // From the chin up.
  Polyline outline = near_half;                                                 // Near end, chin, far end.
  outline.insert(outline.end(), far_half.begin() + 1, far_half.end());
  const int near_end = NearestIndex(ring, jaw.front());
  const Polyline skull = Resampled(RingPart(ring, near_end, temple, -step), FaceShape::kSkullPoints);
  shape.outline = looks_left ? Reversed(outline) : outline;
  shape.skull = looks_left ? skull : Reversed(skull);
}

void ReadFrontal(const SketchView& sketch, FaceShape& shape) {
  const std::array<const char*, 2> sides = {"right", "left"};
  const auto name = [&](const char* part, size_t side) { return fmt::format("{}_{}", part, sides[side]); };
  for (size_t side = 0; side < 2; ++side) {
    const bool is_right = side == 0;
    const Polyline upper = is_right ? sketch.SeenOr(name("upper_eye", side), {36, 37, 38, 39})
                                    : sketch.SeenOr(name("upper_eye", side), {45, 44, 43, 42});
    const Polyline lower = is_right ? sketch.SeenOr(name("lower_eye", side), {36, 41, 40, 39})
                                    : sketch.SeenOr(name("lower_eye", side), {45, 46, 47, 42});
    shape.eyes[side] = EyeOf(sketch, upper, lower, side);
    const Polyline brow = is_right ? sketch.SeenOr(name("brow", side), {17, 18, 19, 20, 21})
                                   : sketch.SeenOr(name("brow", side), {26, 25, 24, 23, 22});
    shape.brows[side] =
        BrowOf(brow, sketch.landmark(is_right ? 17 : 26), sketch.landmark(is_right ? 21 : 22), shape.unit);
    shape.ears[side].outer = TopDown(sketch.Seen(name("ear", side)), kEarPoints);
    if (!shape.ears[side].outer.empty())
      shape.ears[side].inner = TopDown(sketch.Seen(name("ear_inner", side)), kInnerEarPoints);
  }
  ReadFrontalNose(sketch, shape.unit, shape.nose);
  ReadFrontalMouth(sketch, shape.mouth);
  if (shape.view == faces::DrawnView::kFront) return ReadFrontalOutline(sketch, shape);
  for (const auto& point : sketch.facts().nose_contour) shape.nose.contour.push_back(ToPlane(point));
  ReadTurnedOutline(sketch, shape);
}

/// A profile that looks to the right: the face's own right side.
void ReadProfile(const SketchView& sketch, FaceShape& shape) {
  const Polyline upper = StartingNear(sketch.Required("side_profile_upper"), ToPlane(sketch.facts().hairline));
  const Polyline face = Part(upper, ShareNearest(upper, ToPlane(sketch.facts().hairline)), 1, 60);
  const Polyline lower = StartingNear(sketch.Required("side_profile_lower"), upper.back());
  shape.outline = Resampled(Joined(face, lower), FaceShape::kOutlinePoints);
  shape.chin = NearestIndex(shape.outline, sketch.landmark(8));
  const Polyline ring = RingOf(sketch.facts());
  // From the nape, the lowest point of the rear sixth, over the crown to the forehead.
  const Eigen::AlignedBox2d box = BoxOf(ring);
  int nape = 0;
  for (int i = 0; i < static_cast<int>(ring.size()); ++i) {
    const bool is_behind = ring[size_t(i)].x() < box.min().x() + box.sizes().x() / 6;
    if (is_behind && ring[size_t(i)].y() > ring[size_t(nape)].y()) nape = i;
  }
  shape.skull = Resampled(RingPart(ring, nape, NearestIndex(ring, shape.outline.front()), 1), FaceShape::kSkullPoints);

  shape.eyes[0] = EyeOf(sketch, sketch.Required("side_upper_eye"), sketch.Required("side_lower_eye"), 0);
  shape.brows[0] = BrowOf(sketch.Seen("side_brow"), sketch.landmark(17), sketch.landmark(21), shape.unit);
  shape.ears[0].outer = TopDown(sketch.Seen("side_ear"), kEarPoints);
  shape.ears[0].inner = TopDown(sketch.Seen("side_ear_inner"), kInnerEarPoints);
  shape.nose.wings[0] = TopDown(sketch.Seen("side_nose_wing"), NoseShape::kWingPoints);
  const Polyline nostril = sketch.Seen("side_nostril");
  if (nostril.size() >= 2) shape.nose.base = Resampled(nostril, NoseShape::kBasePoints);

  const Vector2d corner = sketch.landmark(48);
  const auto from_corner = [&](const Polyline& line) {
    return Resampled(StartingNear(line, corner), MouthShape::kPoints);
  };
  const Polyline& lips = sketch.Required("side_lips");
  const double at_corner = ShareNearest(lips, corner);
  Polyline top = Part(lips, at_corner, 0, MouthShape::kPoints), bottom = Part(lips, at_corner, 1, MouthShape::kPoints);
  if (top.back().y() > bottom.back().y()) std::swap(top, bottom);
  shape.mouth.top = top;
  shape.mouth.bottom = bottom;
  shape.mouth.inner_top = from_corner(sketch.Required("side_upper_mouth"));
  shape.mouth.inner_bottom = from_corner(sketch.Required("side_lower_mouth"));
  shape.mouth.middle = MouthShape::kPoints - 1;
}

}  // namespace

Polyline FaceShape::head() const {
  return Joined(outline, skull);
}

Vector2d FaceShape::mouth_middle() const {
  if (mouth.inner_top.empty()) return eyes_middle + Vector2d(0, 0.8 * unit);
  return (mouth.inner_top.front() + mouth.inner_top.back() + mouth.inner_bottom.front() + mouth.inner_bottom.back()) /
         4;
}

void ForEachLine(FaceShape& shape, const std::function<void(Polyline&)>& change) {
  change(shape.outline);
  change(shape.skull);
  for (EyeShape& eye : shape.eyes) change(eye.upper), change(eye.lower);
  for (BrowShape& brow : shape.brows) change(brow.upper), change(brow.lower);
  for (EarShape& ear : shape.ears) change(ear.outer), change(ear.inner);
  for (Polyline& bridge : shape.nose.bridges) change(bridge);
  for (Polyline& wing : shape.nose.wings) change(wing);
  change(shape.nose.base);
  change(shape.nose.contour);
  for (Polyline* line : {&shape.mouth.top, &shape.mouth.inner_top, &shape.mouth.inner_bottom, &shape.mouth.bottom})
    change(*line);
  for (Polyline& wrinkle : shape.wrinkles) change(wrinkle);
}

void MovePoints(FaceShape& shape, const std::function<Vector2d(const Vector2d&)>& moved) {
  ForEachLine(shape, [&](Polyline& line) {
    for (Vector2d& point : line) point = moved(point);
  });
  shape.hairline = moved(shape.hairline);
  shape.eyes_middle = moved(shape.eyes_middle);
}

FaceShape ShapeOf(const SketchDatabase& sketches, int face, int view) {
  SketchView sketch(sketches, face, view);
  const SketchFacts& facts = sketch.facts();
  FaceShape shape;
  shape.hairline = ToPlane(facts.hairline);
  shape.eyes_middle = sketch.MeanLandmark(36, 48);
  shape.mouth.is_open = facts.gaps_mm[2] > kClosedLipsMm;
  const double yaw = std::abs(facts.yaw);
  shape.unit = kUnitOfEyesToChin * (shape.eyes_middle - sketch.landmark(8)).norm();
  if (sketch.is_side()) {
    shape.view = faces::DrawnView::kProfile;
    ReadProfile(sketch, shape);
  } else {
    DAUMIER_CHECK(yaw < kLeastProfileYaw,
                  "a sketch of frontal curves is turned by {:g} degrees, expected less than {:g}", yaw,
                  kLeastProfileYaw);
    if (yaw <= kGreatestFrontalYaw)
      shape.unit = (sketch.landmark(36) - sketch.landmark(45)).norm();
    else
      shape.view = facts.yaw < 0 ? faces::DrawnView::kThreeQuarterLeft : faces::DrawnView::kThreeQuarterRight;
    ReadFrontal(sketch, shape);
  }
  shape.wrinkles = std::move(sketch.wrinkles());
  return shape;
}

}  // namespace daumier::datasets
