#include "faces/exaggeration.h"

#include "core/error.h"
#include "geometry/curvature.h"
#include "geometry/normals.h"
#include "geometry/operators.h"
#include "geometry/poisson.h"
#include "geometry/topology.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {

namespace {

constexpr double kFlat = 1e-6;  // 1/cm^2: what is flatter counts as this flat, so that a logarithm exists

std::vector<int> FixedVertices(const Annotation& annotation) {
  std::vector<int> fixed;
  for (const char* region : {"eyes", "mouth", "neck_border"}) {
    const auto& vertices = annotation.regions.at(region);
    fixed.insert(fixed.end(), vertices.begin(), vertices.end());
  }
  std::sort(fixed.begin(), fixed.end());
  fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
  return fixed;
}

/// V: `inside` at the vertices, 1 from blend_rings + 1 edges away on, linear between.
Eigen::VectorXd Fade(const geometry::Adjacency& neighbours, const std::vector<int>& vertices, double inside,
                     int blend_rings) {
  const std::vector<int> rings = geometry::RingsFrom(neighbours, vertices);
  Eigen::VectorXd fade(neighbours.size());
  for (int v = 0; v < neighbours.size(); ++v) {
    const double way = rings[v] < 0 ? 1.0 : std::min(1.0, rings[v] / (blend_rings + 1.0));
    fade[v] = inside + (1.0 - inside) * way;
  }
  return fade;
}

/// V: log(|K| / Kbar), smoothed and clamped.
Eigen::VectorXd LogCurvatureRatio(const geometry::TriangleMesh& mesh, const geometry::Adjacency& neighbours,
                                  const std::vector<int>& fixed, const ExaggerationOptions& options) {
  const Eigen::VectorXd areas = geometry::VertexAreas(mesh);
  const Eigen::VectorXd curvature = geometry::SmoothOverRings(geometry::GaussianCurvature(mesh).cwiseAbs(), areas,
                                                              neighbours, options.smoothing_rings);
  const Eigen::VectorXd logarithm = curvature.cwiseMax(kFlat).array().log();
  Eigen::VectorXd free_areas = areas;
  for (const int v : fixed) free_areas[v] = 0;
  DAUMIER_CHECK(free_areas.sum() > 0, "the whole surface is fixed; nothing can be exaggerated");
  const double mean = logarithm.dot(free_areas) / free_areas.sum();
  const double limit = std::log(options.clamp_ratio);
  return (logarithm.array() - mean).max(-limit).min(limit);
}

}  // namespace

std::vector<geometry::Points> Exaggerate(const FaceTemplate& face_template, const geometry::Points& face,
                                         const ExaggerationOptions& options) {
  DAUMIER_CHECK(face.rows() == face_template.num_vertices(), "the face has {} vertices, its template {}", face.rows(),
                face_template.num_vertices());
  const geometry::TriangleMesh mesh{face, face_template.triangles};
  const auto neighbours = geometry::VertexNeighbours(mesh.triangles, face_template.num_vertices());
  const std::vector<int> fixed = FixedVertices(face_template.annotation);
  const Eigen::VectorXd exponent =
      LogCurvatureRatio(mesh, neighbours, fixed, options).array() *
      Fade(neighbours, fixed, 0.0, options.blend_rings).array() *
      Fade(neighbours, face_template.annotation.regions.at("ears"), options.ear_damping, options.blend_rings).array();

  const geometry::PoissonSolver solver(geometry::CotangentLaplacian(mesh), fixed);
  const geometry::Points fixed_points = face(fixed, Eigen::all);
  std::vector<geometry::Points> levels;
  for (const double gamma : options.gammas) {
    const Eigen::VectorXd scales =
        geometry::VerticesToTriangles(mesh.triangles, (gamma * exponent).array().exp().matrix());
    const Eigen::MatrixXd divergence = geometry::CotangentLaplacian(mesh, geometry::kMinCotangent, scales) * face;
    levels.emplace_back(solver.Solve(divergence, fixed_points));
  }
  return levels;
}

}  // namespace daumier::faces
