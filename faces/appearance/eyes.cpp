#include "faces/appearance/eyes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace daumier::faces {
namespace {

constexpr int kEyeSides = 28;
constexpr double kBulgeKept = 0.35;  // Of the cornea's bulge: less, since it may turn behind a lid.
constexpr SoupKind kBallKind{PictureClass::kEyes, PicturePart::kEyeball};
constexpr SoupKind kHighlightKind{PictureClass::kEyes, PicturePart::kHighlight};

/// Places on the eyeball by the angle from its axis.
class TurnedEye {
 public:
  TurnedEye(const Eyeball& eyeball, double yaw, double pitch, double iris) : eyeball_(eyeball), iris_(iris) {
    turn_ = Eigen::AngleAxisd(yaw, geometry::Vector3::UnitY()) * Eigen::AngleAxisd(-pitch, geometry::Vector3::UnitX());
  }

  /// `across`: in the plane across the axis, as shares of the radius along x; `front`: on which half.
  geometry::Vector3 At(double x, double y, bool front, double lift) const {
    const double flat = std::min(1.0, std::hypot(x, y));
    geometry::Vector3 unit(x, y, (front ? 1 : -1) * std::sqrt(std::max(0.0, 1 - flat * flat)));
    // Round on the ellipsoid where the iris is, an ellipse like the ball's at its equator.
    const double squeeze = eyeball_.radii.x() / eyeball_.radii.y();
    const double round = front ? std::clamp((1 - flat) / (1 - iris_), 0.0, 1.0) : 0.0;
    unit.y() *= 1 + round * (squeeze - 1);
    unit.normalize();
    const double near_axis = std::max(0.0, 1 - flat * flat / (iris_ * iris_));
    const double bulge = front ? kBulgeKept * eyeball_.bulge * near_axis * near_axis : 0.0;
    const geometry::Vector3 turned = turn_ * unit;
    return eyeball_.centre + eyeball_.radii.cwiseProduct(turned) + (bulge + lift) * turned;
  }

 private:
  const Eyeball& eyeball_;
  double iris_;
  Eigen::Matrix3d turn_;
};

struct EyeBand {
  double from, to;
  bool front;
  Eigen::Vector3f inner, outer;
};

}  // namespace

void AddEye(const Eyeball& eyeball, const Looks& looks, HeadSoup& soup) {
  const double iris = std::min(0.8, looks.iris_size * eyeball.iris_radius / eyeball.radii.x());
  const double pupil = std::min(0.75, 0.42 * looks.pupil_size) * iris;
  const TurnedEye eye(eyeball, looks.gaze_yaw, looks.gaze_pitch, iris);
  const Eigen::Vector3f black(0.03f, 0.03f, 0.04f), white(0.93f, 0.92f, 0.90f), pink(0.86f, 0.75f, 0.72f);
  const Eigen::Vector3f colour = looks.iris_colour;
  const std::vector<EyeBand> bands = {
      {0, pupil, true, black, black},
      {pupil, 0.5 * (pupil + 0.9 * iris), true, 1.25f * colour, 1.1f * colour},
      {0.5 * (pupil + 0.9 * iris), 0.9 * iris, true, 1.1f * colour, 0.75f * colour},
      {0.9 * iris, iris, true, 0.3f * colour, 0.3f * colour},
      {iris, 0.5 * (iris + 0.9), true, white, white},
      {0.5 * (iris + 0.9), 0.9, true, white, white + 0.4f * (pink - white)},
      {0.9, 1.0, true, white + 0.4f * (pink - white), pink},
      {1.0, 0.7, false, pink, pink},
      {0.7, 0.0, false, pink, pink},
  };
  const auto ring = [&](double radius, bool front, const Eigen::Vector3f& of) {
    const int first = soup.size();
    if (radius == 0) {
      soup.AddVertex(eye.At(0, 0, front, 0), of);
      return first;
    }
    for (int i = 0; i < kEyeSides; ++i) {
      const double a = 2 * std::numbers::pi * i / kEyeSides;
      soup.AddVertex(eye.At(radius * std::cos(a), radius * std::sin(a), front, 0), of);
    }
    return first;
  };
  for (const EyeBand& band : bands) {
    const int a = ring(band.from, band.front || band.from == 1.0, band.inner),
              b = ring(band.to, band.front, band.outer);
    for (int i = 0; i < kEyeSides; ++i) {
      const int j = (i + 1) % kEyeSides;
      if (band.from == 0) {
        soup.AddTriangle(a, b + i, b + j, kBallKind);
      } else if (band.to == 0) {
        soup.AddTriangle(a + i, b, a + j, kBallKind);
      } else {
        soup.AddQuad(a + i, b + i, b + j, a + j, kBallKind);
      }
    }
  }
  for (int k = 0; k < std::min(2, looks.highlights); ++k) {
    const double x = (k == 0 ? -0.36 : 0.40) * iris, y = (k == 0 ? 0.42 : -0.38) * iris;
    const double radius = (k == 0 ? 0.24 : 0.12) * iris, lift = 0.006 * eyeball.radii.x();
    const Eigen::Vector3f shine(1, 1, 1);
    const int centre = soup.AddVertex(eye.At(x, y, true, lift), shine);
    constexpr int kSpotSides = 10;
    for (int i = 0; i < kSpotSides; ++i) {
      const double a = 2 * std::numbers::pi * i / kSpotSides;
      soup.AddVertex(eye.At(x + radius * std::cos(a), y + radius * std::sin(a), true, lift), shine);
    }
    for (int i = 0; i < kSpotSides; ++i)
      soup.AddTriangle(centre, centre + 1 + i, centre + 1 + (i + 1) % kSpotSides, kHighlightKind);
  }
}

}  // namespace daumier::faces
