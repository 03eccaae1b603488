#include "faces/face_model.h"

#include "core/error.h"
#include "geometry/alignment.h"
#include "geometry/coordinates.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {

namespace {

void DrawControl(const IdentityControl& control, double sigma, Rng& rng, Eigen::VectorXf& weights) {
  switch (control.kind) {
    case IdentityControl::Kind::kGaussian:
      weights[control.shapes[0]] = static_cast<float>(sigma * rng.Normal());
      break;
    case IdentityControl::Kind::kBipolar: {
      const double value = std::clamp(sigma * rng.Normal(), -1.0, 1.0);
      const int shape = control.shapes[value < 0 ? 0 : 1];
      if (shape >= 0) weights[shape] = static_cast<float>(std::abs(value));
      break;
    }
    case IdentityControl::Kind::kSimplex: {
      double sum = 0;
      for (const int shape : control.shapes) {
        weights[shape] = static_cast<float>(std::pow(-std::log(1 - rng.Uniform()), sigma));
        sum += weights[shape];
      }
      for (const int shape : control.shapes) weights[shape] /= static_cast<float>(sum);
      break;
    }
  }
}

}  // namespace

geometry::TriangleMesh SurfaceMesh(const FaceTemplate& face_template, const geometry::Points& vertices) {
  DAUMIER_CHECK(vertices.rows() == face_template.num_vertices(), "a face of {} vertices, expected {}", vertices.rows(),
                face_template.num_vertices());
  return {vertices, face_template.triangles, face_template.uv, face_template.uv_triangles};
}

double MillimetresPerCm(const FaceTemplate& face_template) {
  const double height = face_template.neutral(face_template.annotation.hairline_vertex, 1) -
                        face_template.neutral(face_template.annotation.landmarks[kChinLandmark], 1);
  DAUMIER_CHECK(height > 0, "the hairline of {} is not above its chin", face_template.source);
  return 200.0 / height;
}

Eigen::VectorXf DrawIdentity(const FaceModel& model, Rng& rng, double spread) {
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(model.identity_shapes.cols());
  for (const IdentityControl& control : model.identity_controls)
    DrawControl(control, spread * control.sigma, rng, weights);
  return weights;
}

geometry::Points IdentityFace(const FaceModel& model, const Eigen::VectorXf& identity_weights) {
  DAUMIER_CHECK(identity_weights.size() == model.identity_shapes.cols(), "{} identity weights, the model has {} shapes",
                identity_weights.size(), model.identity_shapes.cols());
  const geometry::Points& neutral = model.face_template.neutral;
  const Eigen::VectorXf offset = model.identity_shapes * identity_weights;
  const geometry::Points face = neutral + geometry::PointsFrom({offset.data(), size_t(offset.size())});
  if (!model.align_identities) return face;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(neutral.rows());
  for (const int vertex : RegionFor(model.face_template.annotation, "face", "errors")) weights[vertex] = 1;
  return geometry::AlignSimilarity(face, neutral, weights).Apply(face);
}

Eigen::VectorXf ExpressionOffset(const FaceModel& model, const Eigen::VectorXf& expression_weights) {
  DAUMIER_CHECK(expression_weights.size() == model.expression_shapes.cols(),
                "{} expression weights, the model has {} shapes", expression_weights.size(),
                model.expression_shapes.cols());
  return model.expression_shapes * expression_weights;
}

}  // namespace daumier::faces
