#include "fitting/forehead_landmarks.h"

#include "faces/appearance/scalp.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace daumier::fitting {
namespace {

/// From the temple of the face's own right to that of its left.
constexpr std::array<int, kNumForeheadLandmarks> kAlongHairline = {77, 75, 76, 68, 69, 70, 71, 80, 72, 73, 79, 74, 78};
/// Degrees from the front of the ear to where the line begins, at the height of the ear's middle.
constexpr double kBeforeEar = 9;

/// The line on the template, from right to left.
std::vector<geometry::Vector3> HairlineOf(const faces::FaceTemplate& face_template) {
  const faces::Scalp scalp(face_template);
  const faces::SkullGrid grid = scalp.GridOf(face_template.neutral);
  const double end = scalp.lines().ear_front - kBeforeEar;
  std::vector<geometry::Vector3> line;
  for (int column = 0; column < faces::SkullGrid::kColumns; ++column) {
    const double azimuth = faces::SkullGrid::Azimuth(column);
    if (std::abs(azimuth) <= end) line.push_back(grid.At(column, faces::HairlineAt(scalp.lines(), azimuth, 0)));
  }
  return line;
}

/// The points that part a line into `count` + 1 pieces of equal length.
std::vector<geometry::Vector3> PartingPoints(const std::vector<geometry::Vector3>& line, int count) {
  std::vector<double> lengths = {0};
  for (size_t i = 1; i < line.size(); ++i) lengths.push_back(lengths.back() + (line[i] - line[i - 1]).norm());
  std::vector<geometry::Vector3> points;
  for (int k = 1; k <= count; ++k) {
    const double place = lengths.back() * k / (count + 1);
    const auto after = std::max<size_t>(1, size_t(std::ranges::lower_bound(lengths, place) - lengths.begin()));
    const double share = (place - lengths[after - 1]) / (lengths[after] - lengths[after - 1]);
    points.push_back((1 - share) * line[after - 1] + share * line[after]);
  }
  return points;
}

}  // namespace

std::array<int, kNumForeheadLandmarks> ForeheadLandmarks(const faces::FaceTemplate& face_template) {
  geometry::Points vertices = face_template.neutral;
  if (const auto ears = face_template.annotation.regions.find("ears"); ears != face_template.annotation.regions.end())
    for (const int v : ears->second) vertices.row(v).setConstant(1e6);  // Never the nearest.
  std::array<int, kNumForeheadLandmarks> landmarks{};
  const std::vector<geometry::Vector3> points = PartingPoints(HairlineOf(face_template), kNumForeheadLandmarks);
  for (size_t k = 0; k < points.size(); ++k) {
    Eigen::Index nearest = 0;
    (vertices.rowwise() - points[k].transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    landmarks[size_t(kAlongHairline[k] - 68)] = int(nearest);
  }
  return landmarks;
}

}  // namespace daumier::fitting
