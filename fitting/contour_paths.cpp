#include "fitting/contour_paths.h"

#include "core/error.h"
#include "geometry/path.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace daumier::fitting {
namespace {

/// Landmarks of the jaw's right half and of the face further in at about their height: the silhouette of a turned head
/// is between them. The left half mirrors them; the chin has no such path.
constexpr std::array<std::pair<int, int>, 8> kContourEnds = {
    {{0, 36}, {1, 41}, {2, 31}, {3, 31}, {4, 48}, {5, 48}, {6, 59}, {7, 58}}};
constexpr std::array<int, 8> kLeftContourEnds = {45, 46, 35, 35, 54, 54, 55, 56};
/// The silhouette lies in this part of a path.
constexpr double kContourShare = 0.7;

}  // namespace

ContourPaths::ContourPaths(const faces::FaceTemplate& face_template) {
  const std::array<int, 68>& landmarks = face_template.annotation.landmarks;
  const int num_vertices = face_template.num_vertices();
  for (size_t k = 0; k < landmarks.size(); ++k)
    DAUMIER_CHECK(landmarks[k] >= 0 && landmarks[k] < num_vertices, "landmark {} is not annotated", k);
  const geometry::Points& neutral = face_template.neutral;
  const geometry::Adjacency neighbours = geometry::VertexNeighbours(face_template.triangles, num_vertices);
  const auto add_path = [&](int jaw, int inner) {
    const int from = landmarks[size_t(jaw)], to = landmarks[size_t(inner)];
    std::vector<int> path = geometry::ShortestPath(neutral, neighbours, from, to);
    path.resize(std::max<size_t>(1, size_t(kContourShare * double(path.size()))));
    const Eigen::Vector2d outwards = (neutral.row(from) - neutral.row(to)).head<2>();
    paths_[size_t(jaw)] = {std::move(path), outwards.normalized()};
  };
  for (size_t i = 0; i < kContourEnds.size(); ++i) {
    add_path(kContourEnds[i].first, kContourEnds[i].second);
    add_path(kNumJaw - 1 - kContourEnds[i].first, kLeftContourEnds[i]);
  }
  paths_[faces::kChinLandmark] = {{landmarks[faces::kChinLandmark]}, {0, -1}};
}

std::vector<int> ContourPaths::AllVertices() const {
  std::vector<int> all;
  for (const Path& path : paths_) all.insert(all.end(), path.vertices.begin(), path.vertices.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

int ContourPaths::Outermost(int landmark, const PicturePoints& pixels, double roll) const {
  const Path& path = paths_.at(size_t(landmark));
  DAUMIER_CHECK(pixels.rows() == std::ssize(path.vertices), "{} pixels of {} candidates", pixels.rows(),
                path.vertices.size());
  const Eigen::Vector2d up = Eigen::Rotation2Dd(roll) * path.outwards, outwards(up.x(), -up.y());
  Eigen::Index outermost = 0;
  (pixels * outwards).maxCoeff(&outermost);
  return int(outermost);
}

}  // namespace daumier::fitting
