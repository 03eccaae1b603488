#include "faces/appearance/mouth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace daumier::faces {
namespace {

constexpr SoupKind kTeethKind{PictureClass::kMouth, PicturePart::kTeeth};
constexpr SoupKind kTongueKind{PictureClass::kMouth, PicturePart::kMouth};
constexpr int kTeethSteps = 20;

/// The points of a contour at equal shares of the mouth's width.
std::vector<geometry::Vector3> AcrossMouth(const std::vector<int>& contour, const geometry::Points& face) {
  std::vector<geometry::Vector3> points;
  const double from = face(contour.front(), 0), to = face(contour.back(), 0);
  for (int i = 0; i <= kTeethSteps; ++i) {
    const double x = from + (to - from) * i / kTeethSteps;
    size_t k = 0;
    while (k + 2 < contour.size() && face(contour[k + 1], 0) < x) ++k;
    const geometry::Vector3 a = face.row(contour[k]), b = face.row(contour[k + 1]);
    const double span = b.x() - a.x();
    points.emplace_back(a + (std::abs(span) > 1e-9 ? std::clamp((x - a.x()) / span, 0.0, 1.0) : 0.0) * (b - a));
  }
  return points;
}

}  // namespace

void AddTeeth(const LipContours& lips, const geometry::Points& face, HeadSoup& soup) {
  const std::vector<geometry::Vector3> upper = AcrossMouth(lips.upper, face), lower = AcrossMouth(lips.lower, face);
  const double width = std::abs(upper.back().x() - upper.front().x());
  double widest = 0;
  for (size_t i = 0; i < upper.size(); ++i) widest = std::max(widest, upper[i].y() - lower[i].y());
  if (widest < 0.05 * width || width <= 0) return;
  const Eigen::Vector3f white(0.96f, 0.95f, 0.90f);
  for (const bool is_upper : {true, false}) {
    const int first = soup.size();
    for (int i = 0; i <= kTeethSteps; ++i) {
      const double side = 2.0 * i / kTeethSteps - 1, gap = std::max(0.0, upper[size_t(i)].y() - lower[size_t(i)].y());
      const double reach = std::min((is_upper ? 0.62 : 0.22) * gap, (is_upper ? 0.15 : 0.08) * width);
      const double back = (0.07 + 0.10 * side * side) * width;
      const geometry::Vector3 from = (is_upper ? upper : lower)[size_t(i)];
      const double sign = is_upper ? 1 : -1;
      const geometry::Vector3 behind(0, 0, -back);
      // A gap between neighbouring teeth.
      const float light = i % 3 == 0 ? 0.86f : 1.0f;
      soup.AddVertex(from + behind + geometry::Vector3(0, sign * 0.03 * width, -0.01 * width), light * white);
      soup.AddVertex(from + behind + geometry::Vector3(0, -sign * reach, 0), light * white);
      soup.AddVertex(from + behind + geometry::Vector3(0, -sign * reach, -0.05 * width), 0.7f * white);
    }
    for (int i = 0; i < kTeethSteps; ++i) {
      const int p = first + 3 * i, q = p + 3;
      for (int k = 0; k < 3; ++k) {
        const int a = p + k, b = p + (k + 1) % 3, c = q + (k + 1) % 3, d = q + k;
        is_upper ? soup.AddQuad(a, b, c, d, kTeethKind) : soup.AddQuad(a, d, c, b, kTeethKind);
      }
    }
    const int p = first, q = first + 3 * kTeethSteps;
    is_upper ? soup.AddTriangle(p, p + 2, p + 1, kTeethKind) : soup.AddTriangle(p, p + 1, p + 2, kTeethKind);
    is_upper ? soup.AddTriangle(q, q + 1, q + 2, kTeethKind) : soup.AddTriangle(q, q + 2, q + 1, kTeethKind);
  }
  const geometry::Vector3 middle = lower[kTeethSteps / 2];
  Eigen::Matrix3d axes;
  axes.setZero();
  axes(0, 0) = 0.26 * width;
  axes(1, 2) = std::min(0.3 * widest, 0.12 * width);
  axes(2, 1) = -0.22 * width;
  AddEllipsoid(middle + geometry::Vector3(0, 0.02 * width, -0.34 * width), axes, 6, 12, {0.62f, 0.24f, 0.24f},
               {0.80f, 0.38f, 0.36f}, kTongueKind, soup);
}

}  // namespace daumier::faces
