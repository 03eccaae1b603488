#include "faces/appearance/brows.h"

#include "faces/appearance/skin_fields.h"
#include "faces/controls/soft_region.h"
#include "faces/openings.h"
#include "geometry/triangle_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

constexpr SoupKind kBrowKind{PictureClass::kBrows, PicturePart::kBrow};
constexpr SoupKind kLashKind{PictureClass::kSkin, PicturePart::kLash};
constexpr int kBrowSteps = 26, kBrowRows = 5, kLashSteps = 26;

/// Of a brow's height from its inner end (0) to its outer one (1).
double BrowTaper(double t) {
  return std::min(1.0, 0.55 + 3 * t) * (1 - 0.78 * std::pow(std::max(0.0, (t - 0.3) / 0.7), 1.6));
}

/// A polygonal line of points at equal steps of its length.
std::vector<geometry::Vector3> EvenlyAlong(const std::vector<geometry::Vector3>& line, int count) {
  std::vector<double> length = {0};
  for (size_t k = 1; k < line.size(); ++k) length.push_back(length.back() + (line[k] - line[k - 1]).norm());
  std::vector<geometry::Vector3> even;
  size_t segment = 0;
  for (int i = 0; i < count; ++i) {
    const double at = length.back() * i / (count - 1);
    while (segment + 2 < line.size() && length[segment + 1] < at) ++segment;
    const double t =
        std::clamp((at - length[segment]) / std::max(1e-12, length[segment + 1] - length[segment]), 0.0, 1.0);
    even.emplace_back((1 - t) * line[segment] + t * line[segment + 1]);
  }
  return even;
}

}  // namespace

BrowPatches::BrowPatches(const FaceTemplate& face) : eye_span_(EyeSpan(face)) {
  const geometry::TriangleTree tree({face.neutral, face.triangles});
  const std::vector<BrowLine> lines = FindBrowLines(face);
  for (size_t side = 0; side < lines.size(); ++side) {
    const BrowLine& line = lines[side];
    Patch patch;
    patch.left = side == 1;
    for (int i = 0; i < kAlong; ++i) {
      const double place = (kBrowPoints - 1.0) * i / (kAlong - 1);
      const size_t k = std::min(size_t(kBrowPoints - 2), size_t(place));
      const double t = place - double(k);
      const geometry::Vector3 centre = (1 - t) * line.centre[k] + t * line.centre[k + 1];
      const double half = (1 - t) * line.half_height[k] + t * line.half_height[k + 1];
      // The height of the middle of the brow everywhere: its taper is drawn.
      double widest = 0;
      for (const double h : line.half_height) widest = std::max(widest, h);
      const double usual = 0.5 * (half + widest);
      patch.half_height.push_back(usual);
      geometry::Vector3 along = line.centre[k + 1] - line.centre[k];
      along.z() = 0;
      geometry::Vector3 up = geometry::Vector3(-along.y(), along.x(), 0).normalized();
      if (up.y() < 0) up = -up;
      for (int j = 0; j < kAcross; ++j) {
        const double v = kReach * (2.0 * j / (kAcross - 1) - 1);
        const geometry::SurfacePoint hit = tree.Closest(centre + v * usual * up);
        const auto t3 = face.triangles.row(hit.triangle);
        patch.places.push_back({{t3[0], t3[1], t3[2]}, {hit.barycentric[0], hit.barycentric[1], hit.barycentric[2]}});
      }
    }
    patches_.push_back(std::move(patch));
  }
  const FaceOpenings openings = FindOpenings(face);
  for (size_t side = 0; side < 2; ++side) {
    std::vector<int> lid = side < openings.lids.size() ? openings.lids[side].upper : std::vector<int>{};
    // The line that is drawn lies at the outer edge of a lid that has a thickness.
    for (const FeatureCurve& curve : face.annotation.curves) {
      if (curve.kind != "upper_eye" || curve.view != View::kFrontal || curve.vertices.size() < 4) continue;
      // Copied first: Eigen 3.4.0 sums an indexed column of a row-major matrix wrongly.
      const double x = Eigen::VectorXd(face.neutral(curve.vertices, 0)).mean();
      if ((x > 0.5 * (lines[0].centre[0].x() + lines[1].centre[0].x())) == (side == 1)) lid = curve.vertices;
    }
    const auto& l = face.annotation.landmarks;
    if (lid.size() < 4)
      lid = side == 0 ? std::vector<int>{l[36], l[37], l[38], l[39]} : std::vector<int>{l[42], l[43], l[44], l[45]};
    const bool outwards = std::abs(face.neutral(lid.back(), 0) - face.neutral(l[27], 0)) >
                          std::abs(face.neutral(lid.front(), 0) - face.neutral(l[27], 0));
    if (!outwards) std::reverse(lid.begin(), lid.end());
    lids_.push_back(std::move(lid));
  }
}

void BrowPatches::AddBrows(const geometry::Points& face, const geometry::Points& normals, const Looks& looks,
                           HeadSoup& soup) const {
  for (const Patch& patch : patches_) {
    std::vector<geometry::Vector3> points, outwards;
    for (const Place& place : patch.places) {
      geometry::Vector3 p = geometry::Vector3::Zero(), n = p;
      for (size_t k = 0; k < 3; ++k) {
        p += place.weights[k] * face.row(place.vertices[k]).transpose();
        n += place.weights[k] * normals.row(place.vertices[k]).transpose();
      }
      points.push_back(p);
      outwards.push_back(n.normalized());
    }
    // Bilinear in the patch.
    const auto mixed = [&](const std::vector<geometry::Vector3>& of, double t, double v) {
      const double i = std::clamp(t, 0.0, 1.0) * (kAlong - 1),
                   j = (std::clamp(v / kReach, -1.0, 1.0) + 1) / 2 * (kAcross - 1);
      const int i0 = std::min(kAlong - 2, int(i)), j0 = std::min(kAcross - 2, int(j));
      const double a = i - i0, b = j - j0;
      const auto at = [&](int x, int y) -> const geometry::Vector3& { return of[size_t(x * kAcross + y)]; };
      return geometry::Vector3((1 - a) * ((1 - b) * at(i0, j0) + b * at(i0, j0 + 1)) +
                               a * ((1 - b) * at(i0 + 1, j0) + b * at(i0 + 1, j0 + 1)));
    };
    const double relief = 0.014 * eye_span_;
    const int first = soup.size();
    for (int i = 0; i <= kBrowSteps; ++i) {
      const double t = double(i) / kBrowSteps;
      const double half = looks.brow_thickness * BrowTaper(t);
      const double middle = looks.brow_arch * (0.9 * std::sin(3.1 * std::min(1.0, 1.15 * t)) - 0.5 + 0.3 * t);
      // The ends are round.
      const double round = std::sqrt(std::clamp(std::min(t / 0.06, (1 - t) / 0.04), 0.02, 1.0));
      const float hairs = 1.0f + 0.12f * float(std::sin(2.1 * i) + 0.5 * std::sin(5.3 * i + 1));
      for (int j = 0; j < kBrowRows; ++j) {
        const double across = 2.0 * j / (kBrowRows - 1) - 1, v = middle + across * half * round;
        const double lift = relief * round * (1 - across * across) - 0.25 * relief * across * across;
        soup.AddVertex(mixed(points, t, v) + lift * mixed(outwards, t, v), hairs * looks.brow_colour);
      }
      // Under the skin.
      soup.AddVertex(mixed(points, t, middle) - 1.2 * relief * mixed(outwards, t, middle), looks.brow_colour);
    }
    constexpr int kStride = kBrowRows + 1;
    // Seen from outside, a patch of the left brow runs to the right of the picture and its rows upwards.
    const auto quad = [&](int a, int b, int c, int d) {
      patch.left ? soup.AddQuad(a, b, c, d, kBrowKind) : soup.AddQuad(a, d, c, b, kBrowKind);
    };
    for (int i = 0; i < kBrowSteps; ++i) {
      for (int j = 0; j < kStride; ++j) {
        const int p = first + i * kStride, q = p + kStride, k = (j + 1) % kStride;
        quad(p + j, q + j, q + k, p + k);
      }
    }
    for (const bool at_end : {false, true}) {
      const int p = first + (at_end ? kBrowSteps * kStride : 0);
      for (int j = 1; j + 1 < kStride; ++j)
        at_end != patch.left ? soup.AddTriangle(p, p + j, p + j + 1, kBrowKind)
                             : soup.AddTriangle(p, p + j + 1, p + j, kBrowKind);
    }
  }
}

void BrowPatches::AddLashes(const geometry::Points& face, const geometry::Points& normals, const Looks& looks,
                            HeadSoup& soup) const {
  if (looks.lash_length <= 0 && looks.lid_line <= 0) return;
  for (size_t side = 0; side < lids_.size(); ++side) {
    std::vector<geometry::Vector3> line;
    const double lift = 0.008 * (face.row(lids_[side].back()) - face.row(lids_[side].front())).norm();
    for (const int v : lids_[side]) line.emplace_back(face.row(v) + lift * normals.row(v));
    const std::vector<geometry::Vector3> lid = EvenlyAlong(line, kLashSteps + 1);
    const double width = (lid.back() - lid.front()).norm();
    const geometry::Vector3 middle = 0.5 * (lid.back() + lid.front()) - geometry::Vector3(0, 0.10 * width, 0);
    const double outer = side == 1 ? 1 : -1;
    const int first = soup.size();
    const Eigen::Vector3f colour = 0.35f * looks.brow_colour + Eigen::Vector3f::Constant(0.02f);
    const double thick = width * (0.010 + 0.030 * looks.lid_line);
    for (int i = 0; i <= kLashSteps; ++i) {
      const double t = double(i) / kLashSteps;
      geometry::Vector3 up = lid[size_t(i)] - middle;
      up.z() = 0;
      up = (up.normalized() + geometry::Vector3(0, 0.6, 0)).normalized();
      const geometry::Vector3 along = (0.7 * up + geometry::Vector3(0.4 * outer * t, 0, 0.9)).normalized();
      const double shape = std::sin(std::numbers::pi * std::min(1.0, 0.08 + 0.80 * t)) * (0.45 + 0.75 * t);
      const double spike = i % 2 == 0 ? 1.0 : 0.45;
      const double length = width * looks.lash_length * 0.135 * shape * spike;
      const double half = thick * std::min(1.0, 0.25 + 4 * std::min(t, 1.1 - t));
      soup.AddVertex(lid[size_t(i)] - 0.6 * half * up + geometry::Vector3(0, 0, 0.004 * width), colour);
      soup.AddVertex(lid[size_t(i)] + half * up + geometry::Vector3(0, 0, 0.016 * width), colour);
      soup.AddVertex(lid[size_t(i)] + (length + half) * along + geometry::Vector3(0, 0, 0.010 * width), colour);
    }
    const auto quad = [&](int a, int b, int c, int d) {
      side == 1 ? soup.AddQuad(a, b, c, d, kLashKind) : soup.AddQuad(a, d, c, b, kLashKind);
    };
    for (int i = 0; i < kLashSteps; ++i) {
      const int p = first + 3 * i, q = p + 3;
      quad(p, q, q + 2, p + 2);
      quad(p + 2, q + 2, q + 1, p + 1);
      quad(p + 1, q + 1, q, p);
    }
    const int p = first, q = first + 3 * kLashSteps;
    side == 1 ? soup.AddTriangle(p, p + 2, p + 1, kLashKind) : soup.AddTriangle(p, p + 1, p + 2, kLashKind);
    side == 1 ? soup.AddTriangle(q, q + 1, q + 2, kLashKind) : soup.AddTriangle(q, q + 2, q + 1, kLashKind);
  }
}

}  // namespace daumier::faces
