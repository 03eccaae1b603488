#include "fitting/surface_point_model.h"

#include "core/error.h"

#include <cmath>

namespace daumier::fitting {

SurfacePointModel::SurfacePointModel(const CodeModel& model, const std::vector<TrianglePoint>& points) : model_(model) {
  const geometry::Triangles& triangles = model.face_template().triangles;
  for (const TrianglePoint& point : points) {
    DAUMIER_CHECK(point.triangle >= 0 && point.triangle < triangles.rows(),
                  "triangle {} does not exist (the face has {})", point.triangle, triangles.rows());
    const Eigen::Vector3d& weights = point.weights;
    DAUMIER_CHECK(weights.minCoeff() >= 0 && std::abs(weights.sum() - 1) < 1e-6,
                  "weights {}, {}, {} of the corners of a triangle, expected none negative and a sum of 1", weights[0],
                  weights[1], weights[2]);
    points_.push_back({triangles.row(point.triangle).transpose(), weights});
  }
}

std::vector<int> SurfacePointModel::OwnPoints(std::span<const int> points) const {
  const int num_own = model_.num_points();
  std::vector<int> own;
  for (const int point : points) {
    if (point < num_own) {
      own.push_back(point);
      continue;
    }
    const Corners& corners = points_[size_t(point - num_own)];
    own.insert(own.end(), corners.vertices.begin(), corners.vertices.end());
  }
  return own;
}

Eigen::MatrixXd SurfacePointModel::Mixed(const Eigen::MatrixXd& of_own, std::span<const int> points) const {
  const int num_own = model_.num_points();
  Eigen::MatrixXd mixed(3 * std::ssize(points), of_own.cols());
  Eigen::Index from = 0;
  for (size_t p = 0; p < points.size(); ++p) {
    auto rows = mixed.middleRows<3>(3 * Eigen::Index(p));
    if (points[p] < num_own) {
      rows = of_own.middleRows<3>(from);
      from += 3;
      continue;
    }
    const Eigen::Vector3d& weights = points_[size_t(points[p] - num_own)].weights;
    rows.setZero();
    for (int k = 0; k < 3; ++k, from += 3) rows += weights[k] * of_own.middleRows<3>(from);
  }
  return mixed;
}

Eigen::VectorXd SurfacePointModel::Positions(const Eigen::VectorXd& code, std::span<const int> points) const {
  return Mixed(model_.Positions(code, OwnPoints(points)), points);
}

Eigen::MatrixXd SurfacePointModel::Derivative(const Eigen::VectorXd& code, std::span<const int> points) const {
  return Mixed(model_.Derivative(code, OwnPoints(points)), points);
}

}  // namespace daumier::fitting
