#include "fitting/stroke_deformation.h"

#include "core/error.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::fitting {
namespace {

using geometry::SparseMatrix;

constexpr double kRest = 1e-8;

/// L^T L + kRest, L the displacement less the mean of the neighbours'.
SparseMatrix Smoothness(const geometry::Triangles& triangles, int num_vertices) {
  SparseMatrix laplacian = geometry::UniformLaplacian(triangles, num_vertices);
  const Eigen::VectorXd degrees = Eigen::VectorXd(laplacian.diagonal()).cwiseMax(1.0);
  laplacian = degrees.cwiseInverse().asDiagonal() * laplacian;
  SparseMatrix rest(num_vertices, num_vertices);
  rest.setIdentity();
  return SparseMatrix(laplacian.transpose()) * laplacian + kRest * rest;
}

/// From the first value to the last, in equal ratios.
double Between(double first, double last, int round, int rounds) {
  return rounds == 1 ? last : first * std::pow(last / first, double(round) / (rounds - 1));
}

/// C^T of some columns: 1 where a handle of these is.
Eigen::MatrixXd Columns(std::span<const int> handles, Eigen::Index num_vertices) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(num_vertices, Eigen::Index(handles.size()));
  for (size_t i = 0; i < handles.size(); ++i) columns(handles[i], Eigen::Index(i)) = 1;
  return columns;
}

}  // namespace

StrokeDeformer::StrokeDeformer(const geometry::Triangles& triangles, int num_vertices, const ProjectedCurves& curves,
                               const StrokeDeformationOptions& options)
    : curves_(curves), options_(options), num_vertices_(num_vertices), handles_(curves.vertices) {
  DAUMIER_CHECK(!curves.camera.perspective, "a surface follows strokes in the plane of an orthographic camera alone");
  std::sort(handles_.begin(), handles_.end());
  handles_.erase(std::unique(handles_.begin(), handles_.end()), handles_.end());
  for (const int vertex : curves.vertices)
    handle_of_point_.push_back(std::lower_bound(handles_.begin(), handles_.end(), vertex) - handles_.begin());

  smoothness_ = std::make_unique<Eigen::SimplicialLDLT<SparseMatrix>>(Smoothness(triangles, num_vertices));
  compliance_.resize(Eigen::Index(handles_.size()), Eigen::Index(handles_.size()));
  constexpr size_t kBlock = 64;
  for (size_t first = 0; first < handles_.size(); first += kBlock) {
    const auto block = std::span<const int>(handles_).subspan(first, std::min(kBlock, handles_.size() - first));
    const Eigen::MatrixXd columns = Columns(block, num_vertices_), solved = smoothness_->solve(columns);
    compliance_.middleCols(Eigen::Index(first), Eigen::Index(block.size())) = solved(handles_, Eigen::all);
  }
}

Eigen::MatrixX2d StrokeDeformer::Forces(const CurvePull& pull, const Eigen::VectorXf& start, double weight) const {
  const auto num_handles = Eigen::Index(handles_.size());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(num_handles);
  Eigen::MatrixX2d weighted = Eigen::MatrixX2d::Zero(num_handles, 2), forces = weighted;
  for (size_t k = 0; k < pull.weights.size(); ++k) {
    const double strength = weight * double(pull.weights[k]);
    const Eigen::Vector2f drawn(pull.points[2 * k], pull.points[2 * k + 1]);
    weights[handle_of_point_[k]] += strength;
    weighted.row(handle_of_point_[k]) += strength * (drawn - start.segment<2>(2 * Eigen::Index(k))).cast<double>();
  }
  std::vector<Eigen::Index> active;
  for (Eigen::Index i = 0; i < num_handles; ++i) {
    if (weights[i] > 0) active.push_back(i);
  }
  Eigen::MatrixXd system = compliance_(active, active);
  system.diagonal() += weights(active).cwiseInverse();
  const Eigen::MatrixX2d means = weights(active).cwiseInverse().asDiagonal() * weighted(active, Eigen::all);
  const Eigen::LLT<Eigen::MatrixXd> factor(system);
  DAUMIER_CHECK(factor.info() == Eigen::Success, "the system of {} pulled points is singular", active.size());
  forces(active, Eigen::all) = factor.solve(means).eval();
  return forces;
}

std::vector<float> StrokeDeformer::Deform(std::span<const float> face,
                                          const std::vector<render::Stroke>& strokes) const {
  DAUMIER_CHECK(Eigen::Index(face.size()) == 3 * num_vertices_, "a face of {} coordinates for a mesh of {} vertices",
                face.size(), num_vertices_);
  const std::vector<float> projected = Project(curves_, face);
  const Eigen::VectorXf start = Eigen::Map<const Eigen::VectorXf>(projected.data(), Eigen::Index(projected.size()));
  const SegmentGrid grid(SegmentsOf(strokes), float(std::max(options_.first_reach_px, options_.last_reach_px)));
  const auto least_cosine = float(std::cos(options_.max_angle * std::numbers::pi / 180));

  Eigen::MatrixX2d forces = Eigen::MatrixX2d::Zero(Eigen::Index(handles_.size()), 2);
  Eigen::VectorXf curves = start;
  for (int round = 0; round < options_.rounds; ++round) {
    const auto at = [&](double first, double last) { return Between(first, last, round, options_.rounds); };
    const double weight = at(options_.first_weight, options_.last_weight);
    const CurvePull pull =
        PullOf(grid, curves_.offsets, curves, float(at(options_.first_reach_px, options_.last_reach_px)), least_cosine);
    if (!pull.any()) break;
    forces = Forces(pull, start, weight);
    const Eigen::MatrixX2f moves = (compliance_ * forces).cast<float>();
    for (size_t k = 0; k < pull.weights.size(); ++k) {
      const auto at_point = 2 * Eigen::Index(k);
      curves.segment<2>(at_point) = start.segment<2>(at_point) + moves.row(handle_of_point_[k]).transpose();
    }
  }

  Eigen::MatrixX2d spread = Eigen::MatrixX2d::Zero(num_vertices_, 2);
  spread(handles_, Eigen::all) = forces;
  const Eigen::MatrixX2d moves = smoothness_->solve(spread);
  const render::Camera& camera = curves_.camera;
  const geometry::Points offsets = moves * camera.camera_from_world.topRows<2>() / camera.scale;
  std::vector<float> deformed(face.begin(), face.end());
  for (Eigen::Index i = 0; i < offsets.size(); ++i) deformed[size_t(i)] += float(offsets.data()[i]);
  return deformed;
}

}  // namespace daumier::fitting
