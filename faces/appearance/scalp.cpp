#include "faces/appearance/scalp.h"

#include "core/error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace daumier::faces {
namespace {

constexpr int kSkullSmoothing = 4;
constexpr double kWidestGap = 75;  // Degrees of a hole that is filled from its sides.
constexpr double kRadiansPerDegree = std::numbers::pi / 180;

struct SkullDirection {
  double azimuth, elevation;
};
SkullDirection SkullDirectionOf(const geometry::Vector3& from_centre) {
  return {std::atan2(from_centre.x(), from_centre.z()) / kRadiansPerDegree,
          std::atan2(from_centre.y(), std::hypot(from_centre.x(), from_centre.z())) / kRadiansPerDegree};
}

geometry::Vector3 SkullCentre(const FaceTemplate& face) {
  geometry::Vector3 eyes = geometry::Vector3::Zero();
  for (int l = 36; l < 48; ++l) eyes += face.neutral.row(face.annotation.landmarks[size_t(l)]) / 12.0;
  double front = -std::numeric_limits<double>::infinity(), back = -front;
  const double hairline = face.neutral(face.annotation.hairline_vertex, 1);
  for (const auto& p : face.neutral.rowwise()) {
    if (p.y() < eyes.y() || p.y() > hairline) continue;
    front = std::max(front, p.z());
    back = std::min(back, p.z());
  }
  const double middle = std::isfinite(front) && front > back ? 0.5 * (front + back) : eyes.z();
  return {eyes.x(), eyes.y(), middle};
}

/// Distance along a unit direction from the origin to a triangle with these corners, and the barycentrics there.
struct SkullHit {
  double distance;
  geometry::Vector3 barycentric;
};
std::optional<SkullHit> HitTriangle(const std::array<geometry::Vector3, 3>& p, const geometry::Vector3& direction) {
  Eigen::Matrix3d corners;
  corners << p[0], p[1], p[2];
  const geometry::Vector3 w = corners.partialPivLu().solve(direction);
  const double sum = w.sum();
  if (!(w.minCoeff() >= -1e-9) || !(sum > 1e-9)) return std::nullopt;
  return SkullHit{1 / sum, w / sum};
}

using SkullRow = std::vector<std::pair<int, double>>;

void AddTo(SkullRow& row, const SkullRow& other, double weight) {
  for (const auto& [v, w] : other) row.emplace_back(v, weight * w);
}

double MeanElevation(const FaceTemplate& face, const geometry::Vector3& centre, std::initializer_list<int> landmarks) {
  geometry::Vector3 mean = geometry::Vector3::Zero();
  for (const int l : landmarks)
    mean += face.neutral.row(face.annotation.landmarks[size_t(l)]).transpose() / double(landmarks.size());
  return SkullDirectionOf(mean - centre).elevation;
}

ScalpLines FindScalpLines(const FaceTemplate& face, const geometry::Vector3& centre) {
  ScalpLines lines{};
  lines.hairline = SkullDirectionOf(face.neutral.row(face.annotation.hairline_vertex).transpose() - centre).elevation;
  lines.brow = MeanElevation(face, centre, {19, 20, 23, 24});
  lines.chin = MeanElevation(face, centre, {8});
  const auto ears = face.annotation.regions.find("ears");
  lines.ear_front = lines.ear_top = lines.ear_back = lines.ear_bottom = 0;
  if (ears != face.annotation.regions.end() && !ears->second.empty()) {
    std::vector<double> azimuths, elevations;
    for (const int v : ears->second) {
      const SkullDirection d = SkullDirectionOf(face.neutral.row(v).transpose() - centre);
      azimuths.push_back(std::abs(d.azimuth));
      elevations.push_back(d.elevation);
    }
    std::sort(azimuths.begin(), azimuths.end());
    std::sort(elevations.begin(), elevations.end());
    const auto at = [](const std::vector<double>& values, double share) {
      return values[size_t(share * double(values.size() - 1))];
    };
    lines.ear_front = at(azimuths, 0.03), lines.ear_back = at(azimuths, 0.97);
    lines.ear_bottom = at(elevations, 0.02), lines.ear_top = at(elevations, 0.98);
  } else {
    const SkullDirection d = SkullDirectionOf(face.neutral.row(face.annotation.landmarks[16]).transpose() - centre);
    lines.ear_front = std::abs(d.azimuth) + 5, lines.ear_back = std::abs(d.azimuth) + 25;
    lines.ear_bottom = d.elevation - 20, lines.ear_top = d.elevation + 5;
  }
  return lines;
}

}  // namespace

double SmoothBetween(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double HairlineAt(const ScalpLines& lines, double azimuth, double receding) {
  const double a = std::abs(azimuth), front = lines.ear_front, back = lines.ear_back;
  const double top = lines.ear_top, bottom = lines.ear_bottom;
  struct Knot {
    double azimuth, elevation;
  };
  const std::array<Knot, 10> knots = {{{0, lines.hairline + 6 * receding},
                                       {16, lines.hairline - 1 + 14 * receding},
                                       {36, lines.hairline - 6 + 24 * receding},
                                       {front - 22, top + 6 + 16 * receding},
                                       {front - 9, 0.6 * top + 0.4 * bottom},
                                       {front - 2, 0.75 * top + 0.25 * bottom},
                                       {front + 5, top + 3},
                                       {0.4 * front + 0.6 * back, top + 4},
                                       {back + 6, bottom},
                                       {180, bottom - 9}}};
  for (size_t k = 1; k < knots.size(); ++k) {
    if (a <= knots[k].azimuth || k + 1 == knots.size()) {
      const double t = SmoothBetween(knots[k - 1].azimuth, knots[k].azimuth, a);
      return knots[k - 1].elevation + t * (knots[k].elevation - knots[k - 1].elevation);
    }
  }
  return bottom;
}

SkullGrid::SkullGrid(geometry::Points points) : points_(std::move(points)), normals_(points_.rows(), 3) {
  centre_.setZero();
  const int rows = int(90 / kStep) + 1;
  for (int i = 0; i < rows * kColumns; ++i) centre_ += points_.row(i).transpose() / double(rows * kColumns);
  for (int i = 0; i < rows * kColumns; ++i)
    radius_ += (points_.row(i).transpose() - centre_).norm() / double(rows * kColumns);
  for (int r = 1; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      const int left = (c + kColumns - 1) % kColumns, right = (c + 1) % kColumns, below = std::min(r + 1, kRows - 1);
      const Eigen::RowVector3d around = points_.row(r * kColumns + right) - points_.row(r * kColumns + left);
      const Eigen::RowVector3d down = points_.row(below * kColumns + c) - points_.row((r - 1) * kColumns + c);
      normals_.row(r * kColumns + c) = down.cross(around).normalized();
    }
  }
  const Eigen::RowVector3d crown = normals_.middleRows(kColumns, kColumns).colwise().mean().normalized();
  normals_.topRows(kColumns).rowwise() = crown;
}

geometry::Vector3 SkullGrid::Mixed(const geometry::Points& of, int column, double elevation) const {
  const double place = std::clamp((90 - elevation) / kStep, 0.0, kRows - 1.001);
  const int row = static_cast<int>(place);
  const double t = place - row;
  return (1 - t) * of.row(row * kColumns + column) + t * of.row((row + 1) * kColumns + column);
}

geometry::Vector3 SkullGrid::At(int column, double elevation) const {
  return Mixed(points_, column, elevation);
}

geometry::Vector3 SkullGrid::Outwards(int column, double elevation) const {
  return Mixed(normals_, column, elevation).normalized();
}

Scalp::Scalp(const FaceTemplate& face) {
  const geometry::Vector3 centre = SkullCentre(face);
  lines_ = FindScalpLines(face, centre);
  const int num_vertices = face.num_vertices();
  std::vector<bool> is_ear(size_t(num_vertices), false);
  if (const auto ears = face.annotation.regions.find("ears"); ears != face.annotation.regions.end())
    for (const int v : ears->second) is_ear[size_t(v)] = true;

  constexpr int kColumns = SkullGrid::kColumns, kRows = SkullGrid::kRows;
  std::vector<SkullRow> rows(size_t(kColumns) * kRows);
  std::vector<double> farthest(rows.size(), 0.0);
  const auto direction_of = [](int r, int c) {
    const double b = (90 - r * SkullGrid::kStep) * kRadiansPerDegree, a = SkullGrid::Azimuth(c) * kRadiansPerDegree;
    return geometry::Vector3(std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a));
  };
  for (const auto& t : face.triangles.rowwise()) {
    if (is_ear[size_t(t[0])] || is_ear[size_t(t[1])] || is_ear[size_t(t[2])]) continue;
    std::array<geometry::Vector3, 3> p;
    double low_a = 360, high_a = -360, low_e = 90, high_e = -90;
    for (size_t k = 0; k < 3; ++k) {
      p[k] = face.neutral.row(t[Eigen::Index(k)]).transpose() - centre;
      const SkullDirection d = SkullDirectionOf(p[k]);
      low_a = std::min(low_a, d.azimuth), high_a = std::max(high_a, d.azimuth);
      low_e = std::min(low_e, d.elevation), high_e = std::max(high_e, d.elevation);
    }
    // Around the crown and across the back all columns are tried.
    const bool wide = high_a - low_a > 90 || high_e > 75;
    if (wide) high_e = high_e > 75 ? 90 : high_e;
    for (int r = std::max(0, int(std::floor((90 - high_e) / SkullGrid::kStep)));
         r < kRows && 90 - r * SkullGrid::kStep >= low_e - SkullGrid::kStep; ++r) {
      for (int c = 0; c < kColumns; ++c) {
        if (!wide && (SkullGrid::Azimuth(c) < low_a - 1e-6 || SkullGrid::Azimuth(c) > high_a + 1e-6)) continue;
        const auto hit = HitTriangle(p, direction_of(r, c));
        const size_t i = size_t(r) * kColumns + size_t(c);
        if (!hit || hit->distance <= farthest[i]) continue;
        farthest[i] = hit->distance;
        rows[i] = {{t[0], hit->barycentric[0]}, {t[1], hit->barycentric[1]}, {t[2], hit->barycentric[2]}};
      }
    }
  }

  // Holes are filled from both sides of their row, or else from the row above.
  for (int r = 0; r < kRows; ++r) {
    std::vector<int> found;
    for (int c = 0; c < kColumns; ++c)
      if (farthest[size_t(r) * kColumns + size_t(c)] > 0) found.push_back(c);
    DAUMIER_CHECK(r > 0 || !found.empty(), "the template '{}' has no crown above the middle of its eyes", face.source);
    std::vector<SkullRow> filled(rows.begin() + r * kColumns, rows.begin() + (r + 1) * kColumns);
    for (int c = 0; c < kColumns; ++c) {
      if (farthest[size_t(r) * kColumns + size_t(c)] > 0) continue;
      int before = -1, after = -1;
      for (int k = 1; k < kColumns && (before < 0 || after < 0); ++k) {
        if (before < 0 && farthest[size_t(r * kColumns + (c - k + kColumns) % kColumns)] > 0) before = k;
        if (after < 0 && farthest[size_t(r * kColumns + (c + k) % kColumns)] > 0) after = k;
      }
      SkullRow& row = filled[size_t(c)];
      if (before > 0 && after > 0 && (before + after) * 360.0 / kColumns <= kWidestGap) {
        AddTo(row, rows[size_t(r * kColumns + (c - before + kColumns) % kColumns)], double(after) / (before + after));
        AddTo(row, rows[size_t(r * kColumns + (c + after) % kColumns)], double(before) / (before + after));
      } else if (r > 1) {
        // Straight down as far as the row above came.
        row = rows[size_t((r - 1) * kColumns + c)];
      } else {
        row = rows[size_t(found.empty() ? c : r * kColumns + found.front())];
      }
    }
    std::copy(filled.begin(), filled.end(), rows.begin() + r * kColumns);
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> grid(Eigen::Index(rows.size()), num_vertices);
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t i = 0; i < rows.size(); ++i)
    for (const auto& [v, w] : rows[i]) entries.emplace_back(int(i), v, w);
  grid.setFromTriplets(entries.begin(), entries.end());

  // Smooth: each point becomes the mean of itself and its four neighbours; the crown stays one point.
  Eigen::SparseMatrix<double, Eigen::RowMajor> smooth(grid.rows(), grid.rows());
  entries.clear();
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      const int i = r * kColumns + c;
      if (r == 0) {
        for (int k = 0; k < kColumns; ++k) entries.emplace_back(i, kColumns + k, 0.6 / kColumns);
        entries.emplace_back(i, i, 0.4);
        continue;
      }
      entries.emplace_back(i, i, 0.4);
      entries.emplace_back(i, r * kColumns + (c + 1) % kColumns, 0.15);
      entries.emplace_back(i, r * kColumns + (c + kColumns - 1) % kColumns, 0.15);
      entries.emplace_back(i, (r - 1) * kColumns + c, 0.15);
      entries.emplace_back(i, std::min(r + 1, kRows - 1) * kColumns + c, 0.15);
    }
  }
  smooth.setFromTriplets(entries.begin(), entries.end());
  for (int k = 0; k < kSkullSmoothing; ++k) grid = (smooth * grid).pruned();
  grid_from_face_ = grid;

  weights_.resize(num_vertices);
  for (int v = 0; v < num_vertices; ++v) {
    const SkullDirection d = SkullDirectionOf(face.neutral.row(v).transpose() - centre);
    weights_[v] = is_ear[size_t(v)] ? 0.0 : SmoothBetween(-4, 4, d.elevation - HairlineAt(lines_, d.azimuth, 0));
  }
}

SkullGrid Scalp::GridOf(const geometry::Points& face) const {
  return SkullGrid(geometry::Points(grid_from_face_ * face));
}

}  // namespace daumier::faces
