#include "faces/exaggeration.h"

#include "core/error.h"
#include "geometry/curvature.h"
#include "geometry/normals.h"
#include "geometry/topology.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {

namespace {

constexpr const char* kPurpose = "exaggeration";
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

void CheckSize(const FaceTemplate& face_template, const geometry::Points& face) {
  DAUMIER_CHECK(face.rows() == face_template.num_vertices(), "the face has {} vertices, its template {}", face.rows(),
                face_template.num_vertices());
}

}  // namespace

Eigen::VectorXd CurvatureExponent(const FaceTemplate& face_template, const geometry::Points& face,
                                  const ExaggerationOptions& options) {
  CheckSize(face_template, face);
  const geometry::TriangleMesh mesh{face, face_template.triangles};
  const auto neighbours = geometry::VertexNeighbours(mesh.triangles, face_template.num_vertices());
  const Annotation& annotation = face_template.annotation;
  const std::vector<int> fixed = FixedVertices(annotation);
  Eigen::VectorXd exponent = LogCurvatureRatio(mesh, neighbours, fixed, options);
  ScaleNoseAsOne(mesh, neighbours, RegionFor(annotation, "nose", kPurpose), options.blend_rings, exponent);
  exponent.array() *=
      Fade(neighbours, fixed, 0.0, options.blend_rings).array() *
      Fade(neighbours, RegionFor(annotation, "ears", kPurpose), options.ear_damping, options.blend_rings).array();
  return exponent;
}

FaceExaggerator::FaceExaggerator(const FaceTemplate& face_template, const geometry::Points& face,
                                 const ExaggerationOptions& options)
    : exponent_(CurvatureExponent(face_template, face, options)),
      scaling_({face, face_template.triangles}, FixedVertices(face_template.annotation)),
      blend_rings_(options.blend_rings) {}

geometry::Points FaceExaggerator::At(double gamma) const {
  return scaling_.RebuildWithoutFlips((gamma * exponent_).replicate<1, 3>(), blend_rings_);
}

std::vector<geometry::Points> Exaggerate(const FaceTemplate& face_template, const geometry::Points& face,
                                         const ExaggerationOptions& options) {
  const FaceExaggerator exaggerator(face_template, face, options);
  std::vector<geometry::Points> levels;
  for (const double gamma : options.gammas) levels.push_back(exaggerator.At(gamma));
  return levels;
}

}  // namespace daumier::faces
