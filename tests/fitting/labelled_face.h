#pragma once
#include "core/random.h"
#include "faces/face_gaussian.h"
#include "fitting/labelled_fit.h"
#include "render/camera.h"
#include "tests/support/synthetic_face.h"

#include <cmath>
#include <numbers>

/// Drawings of the synthetic face whose every point is known.
namespace daumier::fitting {

/// Faces about the synthetic one: symmetric and asymmetric smooth changes of some millimetres.
inline faces::FaceGaussian SmoothFaces(const faces::FaceTemplate& face_template, int num_symmetric = 8,
                                       int num_asymmetric = 3) {
  Rng rng(17);
  const geometry::Points& neutral = face_template.neutral;
  const auto& mirror = face_template.annotation.mirror;
  const Eigen::Index num_vertices = neutral.rows();
  std::vector<Eigen::VectorXf> shapes;
  for (int i = 0; i < 60; ++i) {
    Eigen::VectorXf face(3 * num_vertices);
    const Eigen::Matrix3d frequency = Eigen::Matrix3d::NullaryExpr([&] { return 0.15 * rng.Normal(); });
    const Eigen::RowVector3d phase = Eigen::RowVector3d::NullaryExpr([&] { return 3 * rng.Normal(); });
    const geometry::Points moved = neutral + 0.6 * ((neutral * frequency).rowwise() + phase).array().sin().matrix();
    for (Eigen::Index v = 0; v < num_vertices; ++v) face.segment<3>(3 * v) = moved.row(v).cast<float>().transpose();
    shapes.push_back(face);
  }
  return faces::FitFaceGaussian(
      int(shapes.size()), int(3 * num_vertices),
      [&](int i) { return std::span<const float>(shapes[size_t(i)].data(), size_t(3 * num_vertices)); }, mirror,
      {num_symmetric, num_asymmetric});
}

struct LabelledFace {
  faces::FaceTemplate face_template = testing::SyntheticFace();
  faces::FaceGaussian gaussian = SmoothFaces(face_template);
  faces::FacePointVertices points = faces::FindFacePoints(face_template);
  render::Camera camera = render::FrontalCamera({0, 1, 0}, 13, 256);

  Eigen::MatrixX2d OnSheet(const Eigen::VectorXf& face) const {
    geometry::Points vertices(face.size() / 3, 3);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) vertices.row(v) = face.segment<3>(3 * v).cast<double>();
    return render::Project(camera, vertices).leftCols<2>();
  }
  Eigen::VectorXf Face(uint64_t seed, double size = 1) const {
    Rng rng(seed);
    return faces::Reconstruct(
        gaussian, Eigen::VectorXf::NullaryExpr(gaussian.size(), [&] { return float(size * rng.Normal()); }));
  }
  /// All points of a face in a frame, states and view unknown.
  LabelledDrawing PointsOf(const Eigen::VectorXf& face, const render::Placement& frame = {}) const {
    const Eigen::MatrixX2d on_sheet = OnSheet(face);
    LabelledDrawing drawing;
    for (int i = 0; i < faces::kNumLandmarkPoints; ++i) {
      const auto point = faces::FacePoint(i);
      const auto contour = faces::ContourOf(point);
      const Eigen::Vector2d near =
          contour ? Eigen::Vector2d(on_sheet.row(points.contours[size_t(*contour)][4])) : Eigen::Vector2d::Zero();
      drawing.points[size_t(i)] = {render::ToCanvas(frame, faces::ProjectedFacePoint(points, point, on_sheet, near)),
                                   1.0};
    }
    return drawing;
  }
  /// A curve of a face as a stroke of one label.
  LabelledStroke StrokeOf(const Eigen::VectorXf& face, const std::string& curve, faces::LineLabel label,
                          const render::Placement& frame = {}) const {
    const Eigen::MatrixX2d on_sheet = OnSheet(face);
    LabelledStroke stroke;
    for (const faces::FeatureCurve& c : face_template.annotation.curves) {
      if (c.name != curve) continue;
      for (const int vertex : c.vertices) {
        const Eigen::Vector2d p = render::ToCanvas(frame, on_sheet.row(vertex).transpose());
        stroke.points.push_back({float(p.x()), float(p.y())});
        stroke.labels.push_back(label);
      }
    }
    return stroke;
  }
};

/// Mean distance of the points of a fitted face, in its frame, from those of a face in another frame; pixels.
inline double MeanPointDistance(const LabelledFace& face, const LabelledFit& fit, const LabelledDrawing& truth) {
  const Eigen::MatrixX2d on_sheet =
      face.OnSheet(Eigen::Map<const Eigen::VectorXf>(fit.vertices.data(), Eigen::Index(fit.vertices.size())));
  double sum = 0;
  for (int i = 0; i < faces::kNumLandmarkPoints; ++i) {
    const Eigen::Vector2d position = truth.points[size_t(i)].position;
    const Eigen::Vector2d near = render::ToSheet(fit.frame, position);
    sum += (render::ToCanvas(fit.frame, faces::ProjectedFacePoint(face.points, faces::FacePoint(i), on_sheet, near)) -
            position)
               .norm();
  }
  return sum / faces::kNumLandmarkPoints;
}

}  // namespace daumier::fitting
