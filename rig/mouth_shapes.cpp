#include "rig/mouth_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace daumier::rig {
namespace {

/// An arch is half an ellipse: x = side sin(angle), z = depth (cos(angle) - 1) + front.
struct Arch {
  double side, depth, front;
  double edge;    ///< y of the middle's edges.
  double height;  ///< Of its teeth.
};
constexpr double kLastAngle = 80 * std::numbers::pi / 180;
constexpr Arch kUpperArch{0.43, 0.56, 0.0, -0.065, 0.19}, kLowerArch{0.38, 0.51, -0.055, -0.045, 0.16};
constexpr double kGumHeight = 0.10, kEdgeRise = 0.03;
/// Widths of the teeth of a side from the middle on.
constexpr std::array<double, kNumTeeth / 2> kUpperWidths = {1.0, 0.8, 0.9, 0.85, 0.85, 1.15},
                                            kLowerWidths = {0.65, 0.7, 0.85, 0.9, 0.95, 1.3};

const Arch& ArchOf(Jaw jaw) {
  return jaw == Jaw::kUpper ? kUpperArch : kLowerArch;
}

/// Angles of the gaps between the teeth, from the right to the left, with the ends: equal widths along the ellipse.
std::vector<double> GapAngles(Jaw jaw) {
  const Arch& arch = ArchOf(jaw);
  constexpr int kSteps = 400;
  std::vector<double> lengths = {0};
  for (int i = 1; i <= kSteps; ++i) {
    const double angle = kLastAngle * (i - 0.5) / kSteps;
    lengths.push_back(lengths.back() + std::hypot(arch.side * std::cos(angle), arch.depth * std::sin(angle)));
  }
  const auto& widths = jaw == Jaw::kUpper ? kUpperWidths : kLowerWidths;
  double sum = 0, total = 0;
  for (const double width : widths) total += width;
  std::vector<double> angles = {0};
  for (const double width : widths) {
    sum += width;
    const auto at = std::lower_bound(lengths.begin(), lengths.end() - 1, sum / total * lengths.back());
    angles.push_back(kLastAngle * double(at - lengths.begin()) / kSteps);
    angles.insert(angles.begin(), -angles.back());
  }
  return angles;
}

/// A point of a tooth's cross-section: `out` of the arch's front, and its height as shares of tooth and gum.
struct SectionPoint {
  double out;
  double of_tooth, of_gum;
  double gap_out, gap_height;  ///< Added in gaps, along `out` and from the edge on.
};
constexpr std::array<SectionPoint, 8> kSection = {{{-0.055, 1.0, 1.0, 0.000, 0.00},
                                                   {0.012, 1.0, 0.08, 0.000, -0.04},
                                                   {-0.002, 1.0, 0.0, -0.006, -0.045},
                                                   {0.008, 0.5, 0.0, -0.018, 0.00},
                                                   {-0.010, 0.06, 0.0, -0.014, 0.010},
                                                   {-0.032, 0.0, 0.0, -0.006, 0.010},
                                                   {-0.090, 1.0, 0.0, 0.010, -0.03},
                                                   {-0.105, 1.0, 1.0, 0.000, 0.00}}};

/// A cubic Bezier curve in the plane x = 0 (y, z).
using Curve = std::array<Eigen::Vector2d, 4>;
Eigen::Vector2d CurveAt(const Curve& curve, double t) {
  const double s = 1 - t;
  return s * s * s * curve[0] + 3 * s * s * t * curve[1] + 3 * s * t * t * curve[2] + t * t * t * curve[3];
}
Eigen::Vector2d CurveSlope(const Curve& curve, double t) {
  const double s = 1 - t;
  return 3 * (s * s * (curve[1] - curve[0]) + 2 * s * t * (curve[2] - curve[1]) + t * t * (curve[3] - curve[2]));
}

struct TongueSize {
  double width, thickness;  ///< Half of what is greatest.
};

/// A tongue whose middle runs along a curve from its root to its tip.
geometry::Points TongueAlong(const Curve& curve, const TongueSize& size) {
  constexpr double kGroove = 0.012;
  geometry::Points points(kTongueTube.num_vertices(), 3);
  const std::vector<double> columns = TongueColumns();
  for (int column = 0; column < kTongueTube.num_columns; ++column) {
    const double t = columns[size_t(column)];
    const Eigen::Vector2d at = CurveAt(curve, t), along = CurveSlope(curve, t).normalized(), up(along.y(), -along.x());
    // Round at the tip, a little narrower at the root.
    const double tip = std::clamp((t - 0.55) / 0.45, 0.0, 1.0), round = std::sqrt(1 - tip * tip);
    const double width = size.width * (0.8 + 0.2 * std::min(1.0, 3 * t)) * std::max(round, 0.25),
                 thickness = size.thickness * (1.2 - 0.5 * t) * std::max(std::sqrt(round), 0.45);
    for (int side = 0; side < kTongueTube.num_sides; ++side) {
      const double angle = -2 * std::numbers::pi * side / kTongueTube.num_sides;
      const double x = width * std::cos(angle), groove = std::sin(angle) > 0.5 ? kGroove * std::exp(-x * x / 0.004) : 0;
      const Eigen::Vector2d place = at + (thickness * std::sin(angle) - groove) * up;
      points.row(kTongueTube.vertex(column, side)) << x, place.x(), place.y();
    }
  }
  const Eigen::Vector2d root = CurveAt(curve, 0) - 0.03 * CurveSlope(curve, 0).normalized(),
                        tip = CurveAt(curve, 1) + 0.015 * CurveSlope(curve, 1).normalized();
  points.row(kTongueTube.pole(false)) << 0, root.x(), root.y();
  points.row(kTongueTube.pole(true)) << 0, tip.x(), tip.y();
  return points;
}

}  // namespace

bool IsInArch(Jaw jaw, double x) {
  return std::abs(x) <= ArchOf(jaw).side * std::sin(kLastAngle);
}

double ArchDepth(Jaw jaw, double x) {
  const Arch& arch = ArchOf(jaw);
  const double sine = x / arch.side;
  return arch.front + arch.depth * (std::sqrt(std::max(0.0, 1 - sine * sine)) - 1);
}

geometry::Points TeethPoints(Jaw jaw) {
  const Arch& arch = ArchOf(jaw);
  const double up = jaw == Jaw::kUpper ? 1 : -1;
  geometry::Points points(kTeethTube.num_vertices(), 3);
  const std::vector<double> gaps = GapAngles(jaw);
  for (int column = 0; column < kTeethTube.num_columns; ++column) {
    constexpr std::array<double, 3> kPlaces = {0, 0.2, 0.8};
    const size_t tooth = size_t(column / 3);
    const bool is_gap = column % 3 == 0;
    const double angle =
        is_gap ? gaps[tooth] : gaps[tooth] + kPlaces[size_t(column % 3)] * (gaps[tooth + 1] - gaps[tooth]);
    const geometry::Vector3 at(arch.side * std::sin(angle), 0, arch.depth * (std::cos(angle) - 1) + arch.front);
    const geometry::Vector3 out =
        geometry::Vector3(arch.depth * std::sin(angle), 0, arch.side * std::cos(angle)).normalized();
    const double edge = arch.edge + up * kEdgeRise * (angle / kLastAngle) * (angle / kLastAngle);
    for (int side = 0; side < kTeethTube.num_sides; ++side) {
      const SectionPoint& p = kSection[size_t(side)];
      const double height = p.of_tooth * arch.height + p.of_gum * kGumHeight + (is_gap ? p.gap_height : 0);
      const geometry::Vector3 point =
          at + (p.out + (is_gap ? p.gap_out : 0)) * out + geometry::Vector3(0, edge + up * height, 0);
      // Sides run clockwise around columns from the right to the left in the lower jaw; in the upper one the other way.
      const int place = jaw == Jaw::kLower ? column : kTeethTube.num_columns - 1 - column;
      points.row(kTeethTube.vertex(place, side)) = point.transpose();
    }
  }
  for (const bool last : {false, true}) {
    const int column = last ? kTeethTube.num_columns - 1 : 0;
    points.row(kTeethTube.pole(last)) =
        points.middleRows(kTeethTube.vertex(column, 0), kTeethTube.num_sides).colwise().mean() -
        Eigen::RowVector3d(0, 0, 0.02);
  }
  return points;
}

std::vector<faces::HeadMaterial> TeethMaterials() {
  std::vector<faces::HeadMaterial> materials;
  for (const int side : kTeethTube.Sides())
    materials.push_back(side >= 2 && side < 6 ? faces::HeadMaterial::kTooth : faces::HeadMaterial::kGum);
  return materials;
}

std::vector<double> TeethColumns() {
  std::vector<double> columns;
  for (int column = 0; column < kTeethTube.num_columns; ++column)
    columns.push_back((column + (column % 3 == 1 ? -0.4 : column % 3 == 2 ? 0.4 : 0.0)) / (kTeethTube.num_columns - 1));
  return columns;
}

geometry::Points TongueAtRest() {
  return TongueAlong({{{-0.22, -0.60}, {0.06, -0.52}, {0.02, -0.28}, {-0.095, -0.145}}}, {0.235, 0.08});
}

geometry::Points TongueOut(double lip) {
  return TongueAlong({{{-0.22, -0.60}, {0.10, -0.40}, {0.14, lip + 0.12}, {-0.24, lip + 0.26}}}, {0.205, 0.06});
}

std::vector<double> TongueColumns() {
  return {0, 0.12, 0.24, 0.36, 0.48, 0.6, 0.7, 0.79, 0.87, 0.94, 1};
}

}  // namespace daumier::rig
