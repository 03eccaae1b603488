#include "datasets/styles/proportions.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

/// A part moved, scaled about a point, and turned.
struct PartChange {
  Vector2d about, shift = Vector2d::Zero();
  double scale_x = 1, scale_y = 1, turn = 0;

  void Apply(std::initializer_list<Polyline*> lines) const {
    const Eigen::Rotation2Dd rotation(turn);
    for (Polyline* line : lines)
      for (Vector2d& point : *line)
        point = about + shift + rotation * Vector2d(scale_x * (point - about).x(), scale_y * (point - about).y());
  }
};

Vector2d MiddleOf(const EyeShape& eye) {
  return (eye.upper.front() + eye.upper.back()) / 2;
}

void ChangeEyes(FaceShape& shape, double parts, bool is_cartoon, Rng& rng) {
  const double u = shape.unit;
  const double larger = is_cartoon ? rng.Uniform(0, 0.45) : 0;
  const double scale_x = std::exp(larger + Deviate(parts, rng)),
               scale_y = std::exp(1.3 * larger + Deviate(1.5 * parts, rng));
  const double apart = Deviate(0.4 * parts, rng) * u, down = Deviate(0.5 * parts, rng) * u, tilt = Deviate(parts, rng);
  const double brow_up = Deviate(0.6 * parts, rng) * u, brow_tilt = Deviate(1.5 * parts, rng),
               brow_thick = Deviate(3 * parts, rng);
  for (size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? -1 : 1;
    EyeShape& eye = shape.eyes[side];
    BrowShape& brow = shape.brows[side];
    const Vector2d shift(outward * apart + Deviate(0.15 * parts, rng) * u, down + Deviate(0.15 * parts, rng) * u);
    if (eye.is_seen()) {
      PartChange change{MiddleOf(eye), shift};
      change.scale_x = scale_x * std::exp(Deviate(0.3 * parts, rng));
      change.scale_y = scale_y * std::exp(Deviate(0.4 * parts, rng));
      change.turn = outward * tilt;
      change.Apply({&eye.upper, &eye.lower});
    }
    if (brow.is_seen()) {
      PartChange change{(brow.upper.front() + brow.upper.back()) / 2, shift - Vector2d(0, brow_up)};
      change.scale_x = scale_x;
      change.scale_y = std::exp(brow_thick);
      change.turn = outward * brow_tilt;
      change.Apply({&brow.upper, &brow.lower});
    }
  }
}

/// Points of an arc from one place to another that bulges by `bulge` along y in the middle.
Polyline Arched(const Vector2d& from, const Vector2d& to, double bulge, int count) {
  Polyline arc;
  for (int i = 0; i < count; ++i) {
    const double t = double(i) / (count - 1);
    arc.push_back(from + t * (to - from) + Vector2d(0, bulge * 4 * t * (1 - t)));
  }
  return arc;
}

/// Numbers that place the parts of a doodle in its head: of a face, or drawn as people do. Lengths in half axes.
struct DoodlePlaces {
  double slim;  ///< Half height over half width of the head.
  double eyes_y, eyes_x, eye_size, eye_height;
  double nose_y, nose_size, mouth_y, mouth_half, mouth_bulge, mouth_depth, brow_gap;
};

DoodlePlaces PlacesOf(const FaceShape& shape, const Vector2d& middle, double a, double b) {
  const EyeShape &right = shape.eyes[0], &left = shape.eyes[1];
  const Vector2d corners = (shape.mouth.top.front() + shape.mouth.top.back()) / 2;
  const auto m = size_t(shape.mouth.middle);
  DoodlePlaces places{};
  places.slim = b / a;
  places.eyes_y = (shape.eyes_middle.y() - middle.y()) / b;
  places.eyes_x = (MiddleOf(left) - MiddleOf(right)).norm() / 2 / a;
  places.eye_size = (right.upper.front() - right.upper.back()).norm() / 2 / a;
  places.eye_height = 0.5;
  places.nose_y = (shape.nose.base[NoseShape::kBaseMiddle].y() - middle.y()) / b;
  places.nose_size = (shape.nose.base.front() - shape.nose.base.back()).norm() / 2 / a;
  places.mouth_y = (shape.mouth_middle().y() - middle.y()) / b;
  places.mouth_half = (shape.mouth.top.front() - shape.mouth.top.back()).norm() / 2 / a;
  places.mouth_bulge = (shape.mouth.inner_top[m].y() - corners.y()) / a;
  places.mouth_depth = std::max(0.0, shape.mouth.inner_bottom[m].y() - shape.mouth.inner_top[m].y()) / a;
  places.brow_gap = 0.2;
  return places;
}

DoodlePlaces DrawPlaces(Rng& rng) {
  DoodlePlaces places{};
  places.slim = std::exp(0.1 + Deviate(0.17, rng));
  places.eyes_y = rng.Uniform(-0.5, 0.0);
  places.eyes_x = rng.Uniform(0.2, 0.5);
  places.eye_size = std::exp(rng.Uniform(std::log(0.07), std::log(0.28)));
  places.eye_height = rng.Uniform(0.45, 1.2);
  places.mouth_y = rng.Uniform(0.32, 0.68);
  places.nose_y = places.eyes_y + rng.Uniform(0.35, 0.75) * (places.mouth_y - places.eyes_y);
  places.nose_size = rng.Uniform(0.05, 0.2);
  places.mouth_half = rng.Uniform(0.18, 0.68);
  places.mouth_bulge = places.mouth_half * (rng.Uniform() < 0.8 ? rng.Uniform(0.05, 0.7) : rng.Uniform(-0.4, 0.05));
  places.mouth_depth = rng.Uniform(0.1, 0.5);
  places.brow_gap = rng.Uniform(0.12, 0.3);
  return places;
}

DoodlePlaces Between(const DoodlePlaces& face, const DoodlePlaces& drawn, double t) {
  const auto mix = [t](double a, double b) { return (1 - t) * a + t * b; };
  return {mix(face.slim, drawn.slim),
          mix(face.eyes_y, drawn.eyes_y),
          mix(face.eyes_x, drawn.eyes_x),
          mix(face.eye_size, drawn.eye_size),
          mix(face.eye_height, drawn.eye_height),
          mix(face.nose_y, drawn.nose_y),
          mix(face.nose_size, drawn.nose_size),
          mix(face.mouth_y, drawn.mouth_y),
          mix(face.mouth_half, drawn.mouth_half),
          mix(face.mouth_bulge, drawn.mouth_bulge),
          mix(face.mouth_depth, drawn.mouth_depth),
          mix(face.brow_gap, drawn.brow_gap)};
}

/// The head of a doodle by angles: 0 is up, positive ones turn to the right of the picture.
class DoodleHead {
 public:
  DoodleHead(const Vector2d& middle, double a, double b, double amount, Rng& rng) : middle_(middle), a_(a), b_(b) {
    const double uneven = Happens(0.3, rng) ? 0.13 : 0.05;
    for (int i = 0; i < 4; ++i)
      waves_[size_t(i)] = {amount * Deviate(uneven / (1 + i), rng), rng.Uniform(0, 2 * std::numbers::pi)};
    chin_ = amount * rng.Uniform(-0.1, 0.25);
  }
  Vector2d At(double degrees) const {
    const double angle = degrees * std::numbers::pi / 180;
    double radius = 1;
    for (size_t i = 0; i < waves_.size(); ++i)
      radius += waves_[i].size * std::sin(double(i + 2) * angle + waves_[i].phase);
    const double low = std::max(0.0, -std::cos(angle));  // Narrower towards the chin.
    return middle_ + radius * Vector2d(a_ * (1 - chin_ * low) * std::sin(angle), -b_ * std::cos(angle));
  }
  Polyline Arc(double from, double to, int count) const {
    Polyline arc;
    for (int i = 0; i < count; ++i) arc.push_back(At(from + (to - from) * i / (count - 1)));
    return arc;
  }

 private:
  struct Wave {
    double size, phase;
  };
  Vector2d middle_;
  double a_, b_, chin_ = 0;
  std::array<Wave, 4> waves_;
};

/// The point, or one nearer to the middle of the head where it is too near to its border or outside.
Vector2d WellInside(const Polyline& head, const Vector2d& middle, Vector2d point) {
  Polyline inner = head;
  for (Vector2d& p : inner) p = middle + 0.85 * (p - middle);
  for (int i = 0; i < 20 && !IsInside(inner, point); ++i) point = middle + 0.9 * (point - middle);
  return point;
}

void PlaceEyes(FaceShape& shape, const Vector2d& middle, double a, double b, const DoodlePlaces& places, double amount,
               Rng& rng) {
  const double brow_half = rng.Uniform(0.9, 1.5), brow_bulge = rng.Uniform(-0.5, 0.15), brow_tilt = Deviate(0.35, rng);
  for (size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? -1 : 1;
    const Vector2d place = middle + Vector2d(outward * places.eyes_x * a + Deviate(0.04 * amount, rng) * a,
                                             places.eyes_y * b + Deviate(0.04 * amount, rng) * b);
    const Vector2d centre = WellInside(shape.head(), middle, place);
    const double half = places.eye_size * a * std::exp(Deviate(0.15 * amount, rng)), high = half * places.eye_height;
    EyeShape& eye = shape.eyes[side];
    const Vector2d outer = centre + Vector2d(outward * half, 0), inner = centre - Vector2d(outward * half, 0);
    eye.upper = Arched(outer, inner, -high, EyeShape::kPoints);
    eye.lower = Arched(outer, inner, high, EyeShape::kPoints);
    const double w = brow_half * std::max(half, 0.12 * a), y = centre.y() - high - places.brow_gap * b;
    const Vector2d brow_outer(centre.x() + outward * w, y), brow_inner(centre.x() - outward * w, y + brow_tilt * w);
    BrowShape& brow = shape.brows[side];
    brow.upper = Arched(brow_outer, brow_inner, brow_bulge * w - 0.04 * a, BrowShape::kPoints);
    brow.lower = Arched(brow_outer, brow_inner, brow_bulge * w + 0.04 * a, BrowShape::kPoints);
  }
}

void PlaceNose(FaceShape& shape, const Vector2d& middle, double a, double b, const DoodlePlaces& places, double amount,
               Rng& rng) {
  NoseShape& nose = shape.nose;
  const Vector2d bottom = middle + Vector2d(Deviate(0.05 * amount, rng) * a, places.nose_y * b);
  const double half = places.nose_size * a, top = middle.y() + places.eyes_y * b + 0.1 * b;
  nose.base = Arched(bottom - Vector2d(half, 0.15 * half), bottom + Vector2d(half, -0.15 * half), 0.15 * half,
                     NoseShape::kBasePoints);
  for (size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? -1 : 1;
    const Vector2d wing = bottom + Vector2d(outward * half, -0.6 * half);
    const Vector2d from(bottom.x() + outward * 0.25 * half, std::min(top, bottom.y() - 1.2 * half));
    nose.bridges[side] = Smooth(
        {from, {bottom.x() + outward * 0.35 * half, 0.5 * (from.y() + wing.y())}, wing - Vector2d(0, 0.4 * half)},
        NoseShape::kBridgePoints);
    nose.wings[side] = Smooth({wing - Vector2d(0, 0.4 * half), wing + Vector2d(outward * 0.25 * half, 0),
                               bottom + Vector2d(outward * 0.8 * half, 0)},
                              NoseShape::kWingPoints);
  }
}

void PlaceMouth(FaceShape& shape, const Vector2d& middle, double a, double b, const DoodlePlaces& places, double amount,
                Rng& rng) {
  MouthShape& mouth = shape.mouth;
  const double half = places.mouth_half * a, tilt = Deviate(0.12 * amount, rng), lip = rng.Uniform(0.08, 0.25) * half;
  const Vector2d centre =
      WellInside(shape.head(), middle, middle + Vector2d(Deviate(0.08 * amount, rng) * a, places.mouth_y * b));
  const Vector2d right = centre - half * Vector2d(1, tilt), left = centre + half * Vector2d(1, tilt);
  const double bulge = places.mouth_bulge * a;
  // An open mouth is flat above and round below; it would be taken for closed lips otherwise.
  const double depth = mouth.is_open ? std::max(places.mouth_depth * a, 0.35 * half) : 0;
  const double upper = mouth.is_open ? std::clamp(rng.Uniform(-0.1, 0.5) * bulge, -0.1 * half, 0.2 * half) : bulge;
  constexpr int n = MouthShape::kPoints;
  mouth.inner_top = Arched(right, left, upper, n);
  mouth.inner_bottom = Arched(right, left, upper + depth, n);
  mouth.top = Arched(right, left, upper - lip, n);
  mouth.bottom = Arched(right, left, upper + depth + lip, n);
  for (int i = 0; i < n; ++i) {  // The upper lip is lower in its middle.
    const double t = (double(i) / (n - 1) - 0.5) / 0.09;
    mouth.top[size_t(i)].y() += 0.5 * lip * std::exp(-t * t);
  }
}

}  // namespace

FaceShape WithErrors(FaceShape shape, double parts, DrawingCharacter character, Rng& rng) {
  const bool is_cartoon = character == DrawingCharacter::kCartoon;
  const double u = shape.unit, size = is_cartoon ? 2 * parts : parts;
  ChangeEyes(shape, size, is_cartoon, rng);
  NoseShape& nose = shape.nose;
  if (!nose.base.empty() && shape.view != faces::DrawnView::kProfile) {
    PartChange change{nose.base[NoseShape::kBaseMiddle],
                      Vector2d(Deviate(0.15 * size, rng), Deviate(0.5 * size, rng)) * u};
    change.scale_x = std::exp(Deviate(1.5 * size, rng));
    change.scale_y = std::exp(Deviate(size, rng));
    change.Apply({&nose.base, &nose.contour, &nose.wings[0], &nose.wings[1], &nose.bridges[0], &nose.bridges[1]});
  }
  MouthShape& mouth = shape.mouth;
  if (shape.view != faces::DrawnView::kProfile) {
    PartChange change{shape.mouth_middle(), Vector2d(Deviate(0.15 * size, rng), Deviate(0.5 * size, rng)) * u};
    change.scale_x = std::exp(Deviate(1.2 * size, rng));
    change.scale_y = std::exp(Deviate(1.5 * size, rng));
    change.turn = Deviate(0.3 * size, rng);
    change.Apply({&mouth.top, &mouth.inner_top, &mouth.inner_bottom, &mouth.bottom});
  }
  for (EarShape& ear : shape.ears) {
    if (ear.outer.empty()) continue;
    PartChange change{(ear.outer.front() + ear.outer.back()) / 2, Vector2d(0, Deviate(0.3 * size, rng) * u)};
    change.scale_x = std::exp(Deviate(2 * size, rng));
    change.scale_y = std::exp(Deviate(size, rng));
    change.Apply({&ear.outer, &ear.inner});
  }
  return shape;
}

FaceShape DoodleShape(const FaceShape& shape, double amount, Rng& rng) {
  DAUMIER_CHECK(shape.view == faces::DrawnView::kFront, "a doodle of a face in the view '{}', expected 'front'",
                faces::kDrawnViewNames[size_t(shape.view)]);
  const Eigen::AlignedBox2d box = BoxOf(shape.head());
  const Vector2d middle = box.center();
  const double half_x = box.sizes().x() / 2, half_y = box.sizes().y() / 2;
  const DoodlePlaces places = Between(PlacesOf(shape, middle, half_x, half_y), DrawPlaces(rng), amount);
  // The area of the head stays.
  const double b = std::sqrt(half_x * half_y * places.slim), a = b / places.slim;
  FaceShape doodle = shape;
  const DoodleHead head(middle, a, b, amount, rng);
  doodle.outline = head.Arc(-75, -285, FaceShape::kOutlinePoints);
  doodle.skull = head.Arc(75, -75, FaceShape::kSkullPoints);
  doodle.chin = FaceShape::kOutlinePoints / 2;
  doodle.wrinkles.clear();
  doodle.unit = (1 - amount) * shape.unit + amount * 1.2 * a;
  doodle.hairline = middle - Vector2d(0, 0.65 * b);
  const double clumsy = Happens(0.25, rng) ? 3 * amount : amount;
  PlaceEyes(doodle, middle, a, b, places, clumsy, rng);
  PlaceNose(doodle, middle, a, b, places, clumsy, rng);
  PlaceMouth(doodle, middle, a, b, places, clumsy, rng);
  doodle.eyes_middle = (MiddleOf(doodle.eyes[0]) + MiddleOf(doodle.eyes[1])) / 2;
  const double ear_x = rng.Uniform(0.15, 0.4) * a, ear_y = rng.Uniform(0.15, 0.32) * b,
               ear_middle = rng.Uniform(75, 100);
  for (size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? -1 : 1;
    const Vector2d root = head.At(outward * ear_middle);
    doodle.ears[side].outer = EllipseArc(root, ear_x, ear_y, -90, side == 0 ? -270 : 90, 21);
    doodle.ears[side].inner =
        EllipseArc(root, 0.5 * ear_x, 0.5 * ear_y, side == 0 ? -110 : -70, side == 0 ? -250 : 70, 9);
  }
  return doodle;
}

std::function<Vector2d(const Vector2d&)> SmoothBend(const FaceShape& shape, double amount, Rng& rng) {
  const Eigen::AlignedBox2d box = BoxOf(shape.head());
  const Vector2d middle = box.center();
  const double half = box.sizes().y() / 2;
  std::array<std::array<double, 8>, 2> weights;
  for (auto& row : weights)
    for (double& weight : row) weight = Deviate(amount, rng);
  return [=](const Vector2d& p) {
    // Beyond 1.6 half heights the terms stay as they are there: shoulders are not carried away.
    const double x = std::clamp((p.x() - middle.x()) / half, -1.6, 1.6),
                 y = std::clamp((p.y() - middle.y()) / half, -1.6, 1.6);
    const std::array<double, 8> terms = {x, y, x * x, x * y, y * y, x * x * x, x * y * y, y * y * y};
    Vector2d moved = p;
    for (size_t k = 0; k < terms.size(); ++k) {
      moved.x() += half * weights[0][k] * terms[k];
      moved.y() += half * weights[1][k] * terms[k];
    }
    return moved;
  };
}

}  // namespace daumier::datasets
