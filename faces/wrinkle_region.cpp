#include "faces/wrinkle_region.h"

#include "geometry/normals.h"
#include "geometry/topology.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

constexpr double kSteepestDegrees = 65;
constexpr int kNoseTip = 30;  // Landmark.

void Mark(const std::vector<int>& vertices, std::vector<bool>& marks) {
  for (const int vertex : vertices) marks[size_t(vertex)] = true;
}

void MarkRegion(const Annotation& annotation, const std::string& name, std::vector<bool>& marks) {
  const auto region = annotation.regions.find(name);
  if (region != annotation.regions.end()) Mark(region->second, marks);
}

/// What can be reached from a vertex without stepping on a marked one.
std::vector<bool> Reached(const geometry::Adjacency& neighbours, int from, const std::vector<bool>& barrier) {
  std::vector<bool> reached(barrier.size());
  std::vector<int> open = {from};
  reached[size_t(from)] = true;
  while (!open.empty()) {
    const int vertex = open.back();
    open.pop_back();
    for (const int next : neighbours[vertex]) {
      if (reached[size_t(next)] || barrier[size_t(next)]) continue;
      reached[size_t(next)] = true;
      open.push_back(next);
    }
  }
  return reached;
}

}  // namespace

std::vector<int> WrinkleRegion(const FaceTemplate& face_template, View view, double clearance_mm) {
  const Annotation& annotation = face_template.annotation;
  if (const auto own = annotation.regions.find("wrinkles"); own != annotation.regions.end()) return own->second;

  const std::vector<int>& face = RegionFor(annotation, "face", "drawing wrinkles");
  const size_t num_vertices = size_t(face_template.num_vertices());
  std::vector<bool> barrier(num_vertices), excluded(num_vertices);
  std::vector<int> drawn;
  MarkRegion(annotation, "ears", barrier);
  for (const FeatureCurve& curve : annotation.curves) {
    if (curve.view == View::kFrontal && curve.kind == "silhouette") Mark(curve.vertices, barrier);
    if (curve.view == view) drawn.insert(drawn.end(), curve.vertices.begin(), curve.vertices.end());
  }
  for (const char* part : {"eyes", "mouth", "nose"}) MarkRegion(annotation, part, excluded);

  const std::vector<bool> inside =
      Reached(geometry::VertexNeighbours(face_template.triangles, face_template.num_vertices()),
              annotation.landmarks[kNoseTip], barrier);
  const geometry::Points normals = geometry::VertexNormals({face_template.neutral, face_template.triangles});
  const Eigen::RowVector3d towards_viewer =
      view == View::kFrontal ? Eigen::RowVector3d(0, 0, 1) : Eigen::RowVector3d(-1, 0, 0);
  const double least_cosine = std::cos(kSteepestDegrees * std::numbers::pi / 180);
  const double clearance = clearance_mm / MillimetresPerCm(face_template);
  std::vector<int> region;
  for (const int vertex : face) {
    const bool faces_viewer = normals.row(vertex).dot(towards_viewer) >= least_cosine;
    if (!inside[size_t(vertex)] || excluded[size_t(vertex)] || !faces_viewer) continue;
    const bool is_drawn = std::any_of(drawn.begin(), drawn.end(), [&](int other) {
      return (face_template.neutral.row(vertex) - face_template.neutral.row(other)).norm() < clearance;
    });
    if (!is_drawn) region.push_back(vertex);
  }
  return region;
}

}  // namespace daumier::faces
