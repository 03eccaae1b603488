#include "faces/appearance/glasses.h"

#include "faces/controls/soft_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace daumier::faces {
namespace {

constexpr SoupKind kFrameKind{PictureClass::kBackground, PicturePart::kGlasses};
constexpr SoupKind kLensKind{PictureClass::kBackground, PicturePart::kLens};
constexpr int kRimPoints = 36;

double PowerOf(double value, double exponent) {
  return std::copysign(std::pow(std::abs(value), exponent), value);
}

}  // namespace

GlassesFit::GlassesFit(const FaceTemplate& face) {
  const auto& landmarks = face.annotation.landmarks;
  const double span = EyeSpan(face);
  geometry::Vector3 middle = geometry::Vector3::Zero();
  for (size_t side = 0; side < 2; ++side) {
    for (size_t k = 0; k < 6; ++k) {
      eyes_[side].push_back(landmarks[36 + 6 * side + k]);
      middle += face.neutral.row(landmarks[36 + 6 * side + k]).transpose() / 12.0;
    }
  }
  const double bridge = face.neutral(landmarks[27], 2);
  std::vector<bool> is_ear(size_t(face.num_vertices()), false);
  if (const auto ears = face.annotation.regions.find("ears"); ears != face.annotation.regions.end())
    for (const int v : ears->second) is_ear[size_t(v)] = true;
  std::array<double, 2> best = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int v = 0; v < face.num_vertices(); ++v) {
    const geometry::Vector3 from = face.neutral.row(v).transpose() - middle;
    if (std::abs(from.x()) < 0.95 * span && std::abs(from.y()) < 0.5 * span && face.neutral(v, 2) > bridge - 0.8 * span)
      front_.push_back(v);
    const size_t side = from.x() > 0 ? 1 : 0;
    if (std::abs(from.x()) > 0.4 * span && from.y() > -0.1 * span && from.y() < 0.25 * span && !is_ear[size_t(v)])
      sides_[side].push_back(v);
    // The root of the ear: where the skin behind the side's landmark is at the height of the eyes.
    const geometry::Vector3 place = face.neutral.row(landmarks[side == 0 ? 0 : 16]);
    const geometry::Vector3 wanted(place.x(), middle.y() + 0.06 * span, place.z() - 0.12 * span);
    const double distance = (face.neutral.row(v).transpose() - wanted).squaredNorm();
    if (!is_ear[size_t(v)] && distance < best[side]) {
      best[side] = distance;
      ears_[side] = v;
    }
  }
  std::vector<bool> is_front(size_t(face.num_vertices()), false);
  for (const int v : front_) is_front[size_t(v)] = true;
  int count = 0;
  for (const auto& t : face.triangles.rowwise()) {
    if (!is_front[size_t(t[0])] || !is_front[size_t(t[1])]) continue;
    edge_ += (face.neutral.row(t[0]) - face.neutral.row(t[1])).norm();
    ++count;
  }
  const double width = (face.neutral.row(landmarks[36]) - face.neutral.row(landmarks[39])).norm();
  edge_ /= std::max(1, count) * width;
}

void GlassesFit::AddGlasses(const geometry::Points& face, const Looks& looks, HeadSoup& soup) const {
  if (looks.glasses == GlassesStyle::kNone) return;
  std::array<geometry::Vector3, 2> centre;
  double width = 0;
  for (size_t side = 0; side < 2; ++side) {
    centre[side].setZero();
    for (const int v : eyes_[side]) centre[side] += face.row(v).transpose() / 6.0;
    width += 0.5 * (face.row(eyes_[side][0]) - face.row(eyes_[side][3])).norm();
  }
  const double between = (centre[1] - centre[0]).norm();
  const bool is_square = looks.glasses != GlassesStyle::kRound;
  const double half_width = std::min(0.455 * between, std::max(0.74 * width, 0.36 * between));
  const double half_height = half_width * (looks.glasses == GlassesStyle::kRound ? 1.0 : 0.78);
  const double power = is_square ? 0.5 : 1.0;
  const double tube = 0.048 * width * (looks.glasses == GlassesStyle::kDark ? 1.5 : 1.2);
  const double clearance = tube + 0.02 * width;

  // How far out frames have to lie at a place of the picture plane.
  const auto skin_at = [&](double x, double y, double reach) {
    double most = -std::numeric_limits<double>::infinity();
    for (const int v : front_) {
      if (std::abs(face(v, 0) - x) > reach || std::abs(face(v, 1) - y) > reach) continue;
      most = std::max(most, face(v, 2));
    }
    return most;
  };
  const double reach = 0.6 * edge_ * width + tube;
  // A plane for each lens, turned about the vertical: z = at_nose + slope (distance from the nose), as near as the skin allows.
  std::array<std::vector<geometry::Vector3>, 2> rims;
  for (size_t side = 0; side < 2; ++side) {
    const double outer = side == 1 ? 1 : -1;
    const double wrap = -0.10;  // Slope: lenses turn back to the sides.
    double plane = -std::numeric_limits<double>::infinity();
    std::vector<geometry::Vector3>& rim = rims[side];
    for (int k = 0; k < kRimPoints; ++k) {
      const double a = 2 * std::numbers::pi * k / kRimPoints;
      const double x = half_width * PowerOf(std::cos(a), power),
                   y = half_height * PowerOf(std::sin(a), power) - 0.06 * half_height;
      // Away from the nose.
      const geometry::Vector3 at(centre[side].x() + outer * 0.03 * between + x, centre[side].y() + y, 0);
      plane = std::max(plane, skin_at(at.x(), at.y(), reach) - wrap * outer * x);
      rim.push_back(at);
    }
    if (looks.glasses == GlassesStyle::kDark) {
      for (const int v : eyes_[side])
        plane = std::max(plane, face(v, 2) - wrap * outer * (face(v, 0) - centre[side].x()));
    }
    if (!std::isfinite(plane)) plane = centre[side].z();
    for (geometry::Vector3& p : rim) p.z() = plane + clearance + wrap * outer * (p.x() - centre[side].x());
  }
  for (size_t side = 0; side < 2; ++side) {
    const double outer = side == 1 ? 1 : -1;
    const std::vector<geometry::Vector3>& rim = rims[side];
    AddRing(rim, tube, 8, looks.glasses_colour, kFrameKind, soup);
    if (looks.glasses == GlassesStyle::kDark) {
      for (const double face_of : {1.0, -1.0}) {
        const int first = soup.size();
        geometry::Vector3 middle = geometry::Vector3::Zero();
        for (const geometry::Vector3& p : rim) middle += p / double(rim.size());
        soup.AddVertex(middle + geometry::Vector3(0, 0, (face_of > 0 ? 1.2 : -0.2) * tube), {0.10f, 0.10f, 0.12f});
        for (const geometry::Vector3& p : rim)
          soup.AddVertex(p, Eigen::Vector3f(0.07f, 0.07f, 0.09f) *
                                float(1 + 1.2 * std::max(0.0, (p.y() - middle.y()) / half_height)));
        for (int k = 0; k < kRimPoints; ++k) {
          const int p = first + 1 + k, q = first + 1 + (k + 1) % kRimPoints;
          face_of > 0 ? soup.AddTriangle(first, p, q, kLensKind) : soup.AddTriangle(first, q, p, kLensKind);
        }
      }
    }
    // From the rim's outer end around the side of the head to the ear.
    const geometry::Vector3 hinge = rim[size_t(side == 1 ? 2 : kRimPoints / 2 - 2)];
    const geometry::Vector3 ear = face.row(ears_[side]);
    std::vector<geometry::Vector3> path;
    constexpr int kTempleSteps = 8;
    for (int k = 0; k <= kTempleSteps; ++k) {
      const double t = double(k) / kTempleSteps;
      geometry::Vector3 p = hinge + t * (ear - hinge);
      double most = outer * p.x();
      for (const int v : sides_[side]) {
        if (std::abs(face(v, 2) - p.z()) > 0.45 * width || std::abs(face(v, 1) - p.y()) > 0.25 * width) continue;
        most = std::max(most, outer * face(v, 0) + clearance);
      }
      p.x() = outer * most;
      path.push_back(p);
    }
    // No way back towards the head before its widest place is reached.
    for (int k = 1; k <= kTempleSteps; ++k)
      path[size_t(k)].x() = outer * std::max(outer * path[size_t(k)].x(), outer * path[size_t(k - 1)].x());
    AddTube(path, std::vector<double>(path.size(), 0.9 * tube), 6, looks.glasses_colour, kFrameKind, soup);
  }
  // The bridge.
  const geometry::Vector3 from = rims[0][1], to = rims[1][kRimPoints / 2 - 1];
  std::vector<geometry::Vector3> bridge;
  for (int k = 0; k <= 8; ++k) {
    const double t = k / 8.0, bow = std::sin(std::numbers::pi * t);
    geometry::Vector3 p = from + t * (to - from) + geometry::Vector3(0, 0.10 * half_height * bow, 0.1 * tube);
    p.z() = std::max(p.z(), skin_at(p.x(), p.y(), reach) + clearance);
    bridge.push_back(p);
  }
  AddTube(bridge, std::vector<double>(bridge.size(), tube), 8, looks.glasses_colour, kFrameKind, soup);
}

}  // namespace daumier::faces
