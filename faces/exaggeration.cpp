#include "faces/exaggeration.h"

#include "core/error.h"
#include "geometry/curvature.h"
#include "geometry/flips.h"
#include "geometry/normals.h"
#include "geometry/operators.h"
#include "geometry/poisson.h"
#include "geometry/topology.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {

namespace {

constexpr const char* kPurpose = "exaggeration";
constexpr int kMaxUnflipRounds = 12;
constexpr double kFlat = 1e-6;  // 1/cm^2: what is flatter counts as this flat, so that a logarithm exists

std::vector<int> FixedVertices(const Annotation& annotation) {
  std::vector<int> fixed;
  for (const char* region : {"eyes", "mouth", "neck_border"}) {
    const auto& vertices = RegionFor(annotation, region, kPurpose);
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

std::vector<int> CornersOf(const geometry::Triangles& triangles, const std::vector<int>& rows) {
  std::vector<int> corners;
  for (const int row : rows) {
    for (int k = 0; k < 3; ++k) corners.push_back(triangles(row, k));
  }
  return corners;
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

/// Makes the exponent of the nose one number, its area-weighted mean: a nose that is scaled as a whole is not pierced
/// by its own nostrils, whose pockets are curved more than what surrounds them.
void ScaleNoseAsOne(const geometry::TriangleMesh& mesh, const geometry::Adjacency& neighbours,
                    const std::vector<int>& nose, int blend_rings, Eigen::VectorXd& exponent) {
  const Eigen::VectorXd areas = geometry::VertexAreas(mesh);
  double sum = 0, area = 0;
  for (const int v : nose) {
    sum += areas[v] * exponent[v];
    area += areas[v];
  }
  const Eigen::ArrayXd outside = Fade(neighbours, nose, 0.0, blend_rings).array();
  exponent = outside * exponent.array() + (1.0 - outside) * (sum / area);
}

}  // namespace

std::vector<geometry::Points> Exaggerate(const FaceTemplate& face_template, const geometry::Points& face,
                                         const ExaggerationOptions& options) {
  DAUMIER_CHECK(face.rows() == face_template.num_vertices(), "the face has {} vertices, its template {}", face.rows(),
                face_template.num_vertices());
  const geometry::TriangleMesh mesh{face, face_template.triangles};
  const auto neighbours = geometry::VertexNeighbours(mesh.triangles, face_template.num_vertices());
  const std::vector<int> fixed = FixedVertices(face_template.annotation);
  const Annotation& annotation = face_template.annotation;
  Eigen::VectorXd exponent = LogCurvatureRatio(mesh, neighbours, fixed, options);
  ScaleNoseAsOne(mesh, neighbours, RegionFor(annotation, "nose", kPurpose), options.blend_rings, exponent);
  exponent.array() *=
      Fade(neighbours, fixed, 0.0, options.blend_rings).array() *
      Fade(neighbours, RegionFor(annotation, "ears", kPurpose), options.ear_damping, options.blend_rings).array();

  const geometry::PoissonSolver solver(geometry::CotangentLaplacian(mesh), fixed);
  const geometry::Points fixed_points = face(fixed, Eigen::all);
  const auto rebuild = [&](const Eigen::VectorXd& log_scales) -> geometry::Points {
    const Eigen::VectorXd scales = geometry::VerticesToTriangles(mesh.triangles, log_scales.array().exp().matrix());
    const Eigen::MatrixXd divergence = geometry::CotangentLaplacian(mesh, geometry::kMinCotangent, scales) * face;
    return solver.Solve(divergence, fixed_points);
  };
  std::vector<geometry::Points> levels;
  for (const double gamma : options.gammas) {
    Eigen::VectorXd log_scales = gamma * exponent;
    geometry::Points& level = levels.emplace_back(rebuild(log_scales));
    for (int round = 0; round < kMaxUnflipRounds; ++round) {
      const std::vector<int> flipped = geometry::FlippedTriangles(face, level, mesh.triangles);
      if (flipped.empty()) break;
      log_scales.array() *=
          Fade(neighbours, CornersOf(mesh.triangles, flipped), 0.5, (round + 1) * options.blend_rings).array();
      level = rebuild(log_scales);
    }
  }
  return levels;
}

}  // namespace daumier::faces
