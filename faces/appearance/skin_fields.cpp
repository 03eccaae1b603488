#include "faces/appearance/skin_fields.h"

#include "core/error.h"
#include "faces/appearance/scalp.h"
#include "faces/controls/soft_region.h"
#include "faces/face_holes.h"
#include "geometry/curvature.h"
#include "geometry/topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace daumier::faces {
namespace {

constexpr double kUsualBrowHeight = 0.03;  // Half of it, eye spans.

/// Soft regions of skin. A region of one side is added to its mirror image.
struct SkinRegion {
  SoftRegion region;
  bool both_sides = false;
};

const std::map<std::string, SkinRegion>& SkinRegions() {
  static const std::map<std::string, SkinRegion> regions = {
      {"upper_lids",
       {{{{{42}, {0, 0.03, 0}}, {{43}, {0, 0.045, 0}}, {{44}, {0, 0.045, 0}}, {{45}, {0, 0.03, 0}}},
         {0.06, 0.045, 0.12}},
        true}},
      {"lower_lids",
       {{{{{42}, {0, -0.025, 0}}, {{47}, {0, -0.03, 0}}, {{46}, {0, -0.03, 0}}, {{45}, {0, -0.02, 0}}},
         {0.05, 0.03, 0.12}},
        true}},
      {"lid_edges",
       {{{{{42}}, {{43}, {0, 0.005, 0}}, {{44}, {0, 0.005, 0}}, {{45}, {0.01, 0.005, 0}}}, {0.018, 0.018, 0.05}},
        true}},
      {"sockets", {{{{{42}}, {{43, 44}}, {{45}}, {{46, 47}}}, {0.13, 0.12, 0.2}}, true}},
      {"cheeks", {{{{{35, 46}, {0.04, -0.10, 0}}, {{14, 46}, {-0.02, -0.02, 0}}}, {0.13, 0.12, 0.25}}, true}},
      {"cheekbones", {{{{{35, 45}, {0.03, -0.02, 0}}, {{15, 45}, {-0.03, -0.02, 0}}}, {0.08, 0.06, 0.2}}, true}},
      {"hollows", {{{{{13, 54}, {0.02, 0.02, 0}}, {{14, 54}, {0.06, 0.04, 0}}}, {0.09, 0.12, 0.25}}, true}},
      {"nose_tip", {{{{{30}}, {{33}}}, {0.11, 0.09, 0.14}}}},
      {"nose_wings", {{{{{35}}, {{30, 35}}}, {0.06, 0.06, 0.12}}, true}},
      {"nose_bridge", {{{{{27}}, {{29}}}, {0.05, 0.10, 0.12}}}},
      {"nostrils", {{{{{34}, {0.006, 0.022, 0.0}}}, {0.030, 0.022, 0.04}}, true}},
      {"forehead", {{{{{19, kHairlineAnchor}}, {{24, kHairlineAnchor}}}, {0.25, 0.16, 0.4}}}},
      {"forehead_lines",
       {{{{{20, 21, kHairlineAnchor}, {-0.12, -0.02, 0}}, {{22, 23, kHairlineAnchor}, {0.12, -0.02, 0}}},
         {0.10, 0.022, 0.3}}}},
      {"chin", {{{{{8}, {0, 0.06, 0}}}, {0.15, 0.12, 0.2}}}},
      {"glabella", {{{{{21, 22}}}, {0.06, 0.06, 0.12}}}},
      {"nasolabial",
       {{{{{35}, {0.02, 0.01, 0}}, {{35, 54}, {0.045, 0, 0}}, {{54}, {0.04, -0.01, 0}}}, {0.022, 0.022, 0.08}}, true}},
      {"eye_bags",
       {{{{{42, 47}, {0.02, -0.075, 0}}, {{46, 47}, {0, -0.085, 0}}, {{45, 46}, {0, -0.07, 0}}}, {0.05, 0.028, 0.12}},
        true}},
      {"moustache", {{{{{54}, {0.015, 0.01, 0}}, {{35, 53}, {0.01, 0, 0}}, {{33, 51}}}, {0.06, 0.05, 0.12}}, true}},
      {"jaw", {{{{{15}, {0, 0, 0}}, {{14}}, {{13}}, {{12}}, {{11}}, {{10}}, {{9}}, {{8}}}, {0.15, 0.15, 0.3}}, true}},
      {"neck", {{{}, {1, 1, 1}, {{{{{8}, {0, -0.02, 0}}}, {0, -1, 0}, 0.25}}}}},
  };
  return regions;
}

/// y of a polygonal line at x; the line's greatest or least where it passes x several times.
struct BrowSpan {
  double low, high, depth;
};
BrowSpan SpanAt(const geometry::Points& loop, double x) {
  BrowSpan span{1e9, -1e9, 0};
  int count = 0;
  for (Eigen::Index k = 0; k < loop.rows(); ++k) {
    const auto a = loop.row(k), b = loop.row((k + 1) % loop.rows());
    if ((a.x() - x) * (b.x() - x) > 0 || a.x() == b.x()) continue;
    const double t = (x - a.x()) / (b.x() - a.x()), y = a.y() + t * (b.y() - a.y());
    span.low = std::min(span.low, y), span.high = std::max(span.high, y);
    span.depth += a.z() + t * (b.z() - a.z());
    ++count;
  }
  span.depth /= std::max(1, count);
  return span;
}

Eigen::VectorXd BrowField(const FaceTemplate& face, double inner, double outer) {
  Eigen::VectorXd field = Eigen::VectorXd::Zero(face.num_vertices());
  for (const BrowLine& brow : FindBrowLines(face)) {
    for (int v = 0; v < face.num_vertices(); ++v) {
      const geometry::Vector3 p = face.neutral.row(v);
      double best = 1e9;
      for (size_t k = 0; k + 1 < brow.centre.size(); ++k) {
        const geometry::Vector3 along = brow.centre[k + 1] - brow.centre[k];
        const double t = std::clamp((p - brow.centre[k]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const geometry::Vector3 away = p - brow.centre[k] - t * along;
        const double half = brow.half_height[k] + t * (brow.half_height[k + 1] - brow.half_height[k]);
        best = std::min(best, away.norm() / half);
      }
      field[v] = std::max(field[v], 1 - SmoothBetween(inner, outer, best));
    }
  }
  return field;
}

Eigen::VectorXd AlongBrow(const FaceTemplate& face) {
  // From -1 at the inner ends to 1 at the outer ones.
  const std::vector<BrowLine> brows = FindBrowLines(face);
  Eigen::VectorXd along(face.num_vertices());
  for (int v = 0; v < face.num_vertices(); ++v) {
    const double x = face.neutral(v, 0);
    const BrowLine& brow = brows[x < 0.5 * (brows[0].centre[0].x() + brows[1].centre[0].x()) ? 0 : 1];
    const double from = brow.centre.front().x(), to = brow.centre.back().x();
    along[v] = std::clamp(2 * (x - from) / (to - from) - 1, -1.0, 1.0);
  }
  return along;
}

/// Spots: three plane waves of the given length (eye spans) in the frontal plane, symmetric, in [0, 1].
Eigen::VectorXd Spots(const FaceTemplate& face, double length) {
  const double k = 2 * std::numbers::pi / (length * EyeSpan(face));
  const double middle = face.neutral(face.annotation.landmarks[30], 0);
  Eigen::VectorXd spots(face.num_vertices());
  for (int v = 0; v < face.num_vertices(); ++v) {
    const double x = std::abs(face.neutral(v, 0) - middle), y = face.neutral(v, 1);
    const double wave = std::cos(k * x) * std::cos(k * (0.31 * x + 0.95 * y)) + std::cos(k * (0.8 * y - 0.6 * x) + 1.3);
    spots[v] = SmoothBetween(0.5, 1.4, wave);
  }
  return spots;
}

}  // namespace

std::vector<BrowLine> FindBrowLines(const FaceTemplate& face) {
  std::vector<BrowLine> brows;
  for (const bool left : {false, true}) {
    BrowLine brow;
    geometry::Points line(5, 3);
    for (int k = 0; k < 5; ++k)
      line.row(k) = face.neutral.row(face.annotation.landmarks[size_t(left ? 22 + k : 21 - k)]);
    const double middle_x = line.col(0).mean();
    const FeatureCurve* outline = nullptr;
    for (const FeatureCurve& curve : face.annotation.curves) {
      if (curve.kind != "brow" || curve.view != View::kFrontal || !curve.closed || curve.vertices.size() < 6) continue;
      const geometry::Points points = face.neutral(curve.vertices, Eigen::all);
      if (points.col(0).minCoeff() < middle_x && points.col(0).maxCoeff() > middle_x) outline = &curve;
    }
    if (outline != nullptr) {
      const geometry::Points loop = face.neutral(outline->vertices, Eigen::all);
      double from = loop.col(0).minCoeff(), to = loop.col(0).maxCoeff();
      if (!left) std::swap(from, to);
      for (int k = 0; k < kBrowPoints; ++k) {
        const double t = 0.03 + 0.94 * k / (kBrowPoints - 1.0);
        const double x = from + t * (to - from);
        const BrowSpan span = SpanAt(loop, x);
        brow.centre.emplace_back(x, 0.5 * (span.low + span.high), span.depth);
        brow.half_height.push_back(std::max(0.5 * (span.high - span.low), 0.15 * kUsualBrowHeight * EyeSpan(face)));
      }
    } else {
      for (int k = 0; k < kBrowPoints; ++k) {
        const double place = 4.0 * k / (kBrowPoints - 1.0);
        const int i = std::min(3, int(place));
        brow.centre.emplace_back(line.row(i) + (place - i) * (line.row(i + 1) - line.row(i)));
        brow.half_height.push_back(kUsualBrowHeight * EyeSpan(face) * (1 - 0.6 * std::pow(k / (kBrowPoints - 1.0), 2)));
      }
    }
    brows.push_back(std::move(brow));
  }
  return brows;
}

Eigen::VectorXd LipIndicator(const FaceTemplate& face) {
  const int num_vertices = face.num_vertices();
  Eigen::VectorXd lips = Eigen::VectorXd::Zero(num_vertices);
  const std::vector<int> mouth = FindHoles(face).mouth;
  const FeatureCurve* outline = nullptr;
  for (const FeatureCurve& curve : face.annotation.curves)
    if (curve.kind == "lips" && curve.closed && curve.view == View::kFrontal) outline = &curve;
  if (outline != nullptr && !mouth.empty()) {
    for (const int v : outline->vertices) lips[v] = 1;
    const geometry::Adjacency neighbours = geometry::VertexNeighbours(face.triangles, num_vertices);
    std::vector<int> stack = mouth;
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      if (lips[v] > 0) continue;
      lips[v] = 1;
      for (const int n : neighbours[v]) stack.push_back(n);
    }
    // A curve with a gap lets the flood out: then the landmarks have to do.
    if (lips.sum() < 0.2 * num_vertices) return lips;
    lips.setZero();
  }
  geometry::Points outer(12, 3);
  for (int k = 0; k < 12; ++k) outer.row(k) = face.neutral.row(face.annotation.landmarks[size_t(48 + k)]);
  const double depth = outer.col(2).minCoeff() - 0.1 * EyeSpan(face);
  for (int v = 0; v < num_vertices; ++v) {
    const auto p = face.neutral.row(v);
    if (p.z() < depth) continue;
    bool inside = false;
    for (int k = 0; k < 12; ++k) {
      const auto a = outer.row(k), b = outer.row((k + 1) % 12);
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
    lips[v] = inside ? 1 : 0;
  }
  return lips;
}

Eigen::VectorXd SkinField(const FaceTemplate& face, const std::string& name) {
  const int num_vertices = face.num_vertices();
  if (name == "skin") return Eigen::VectorXd::Ones(num_vertices);
  if (name == "lips") return LipIndicator(face);
  if (name == "upper_lip" || name == "lower_lip") {
    const double seam =
        0.5 * (face.neutral(face.annotation.landmarks[62], 1) + face.neutral(face.annotation.landmarks[66], 1));
    Eigen::VectorXd lips = LipIndicator(face);
    const double soft = 0.01 * EyeSpan(face);
    for (int v = 0; v < num_vertices; ++v) {
      const double above = SmoothBetween(-soft, soft, face.neutral(v, 1) - seam);
      lips[v] *= name == "upper_lip" ? above : 1 - above;
    }
    return lips;
  }
  if (name == "brows") return BrowField(face, 0.75, 1.35);
  if (name == "brow_rims") return BrowField(face, 1.3, 2.2) - BrowField(face, 0.75, 1.35);
  if (name == "brows_along") return BrowField(face, 0.75, 1.35).cwiseProduct(AlongBrow(face));
  if (name == "ears") {
    const auto ears = face.annotation.regions.find("ears");
    if (ears == face.annotation.regions.end()) return Eigen::VectorXd::Zero(num_vertices);
    Eigen::VectorXd field = Eigen::VectorXd::Zero(num_vertices);
    for (const int v : ears->second) field[v] = 1;
    return geometry::SmoothOverRings(field, Eigen::VectorXd::Ones(num_vertices),
                                     geometry::VertexNeighbours(face.triangles, num_vertices), 2);
  }
  if (name == "scalp") return Scalp(face).weights();
  if (name == "beard") {
    const Eigen::VectorXd jaw = SkinField(face, "jaw"), chin = SkinField(face, "chin"),
                          lip = SkinField(face, "moustache");
    return (1 - (1 - jaw.array()) * (1 - chin.array()) * (1 - lip.array())) * (1 - LipIndicator(face).array());
  }
  if (name == "freckles" || name == "fine_freckles") {
    const Eigen::VectorXd where =
        (SkinField(face, "cheeks") + SkinField(face, "nose_tip") + SkinField(face, "nose_bridge")).cwiseMin(1.0);
    return where.cwiseProduct(Spots(face, name == "freckles" ? 0.10 : 0.065));
  }
  if (name == "sun") {
    return (SkinField(face, "cheeks") + SkinField(face, "nose_tip") + 0.6 * SkinField(face, "forehead")).cwiseMin(1.0);
  }
  const auto found = SkinRegions().find(name);
  DAUMIER_CHECK(found != SkinRegions().end(), "'{}' is no region of skin", name);
  Eigen::VectorXd field = WeightsOf(found->second.region, face);
  if (found->second.both_sides)
    field = 1 - (1 - field.array()) * (1 - WeightsOf(Mirrored(found->second.region), face).array());
  return field;
}

}  // namespace daumier::faces
