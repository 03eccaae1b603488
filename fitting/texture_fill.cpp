#include "fitting/texture_fill.h"

#include "core/error.h"
#include "core/parallel.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::fitting {
namespace {

void CheckTexels(size_t count, const TexelColours& colours) {
  DAUMIER_CHECK(colours.colours.size() == count && colours.weights.size() == count,
                "{} colours and {} weights of {} texels", colours.colours.size(), colours.weights.size(), count);
}

}  // namespace

VertexValues MeansAtVertices(const geometry::Triangles& triangles, int num_vertices, std::span<const int> triangle,
                             std::span<const Eigen::Vector3f> weights, const TexelColours& colours) {
  CheckTexels(triangle.size(), colours);
  DAUMIER_CHECK(weights.size() == triangle.size(), "{} texels with weights of {}", triangle.size(), weights.size());
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;
  Rows sums = Rows::Zero(num_vertices, 4);
  for (size_t i = 0; i < colours.weights.size(); ++i) {
    const int t = triangle[i];
    if (t < 0 || colours.weights[i] <= 0) continue;
    const Eigen::Vector3f &b = weights[i], &c = colours.colours[i];
    for (int k = 0; k < 3; ++k) {
      const float weight = colours.weights[i] * b[k];
      sums.row(triangles(t, k)) += Eigen::RowVector4f(weight * c[0], weight * c[1], weight * c[2], weight);
    }
  }
  VertexValues means{Eigen::MatrixXf::Zero(num_vertices, 3), sums.col(3)};
  for (int v = 0; v < num_vertices; ++v)
    if (sums(v, 3) > 0) means.values.row(v) = sums.row(v).head<3>() / sums(v, 3);
  return means;
}

SurfaceFill::SurfaceFill(const geometry::Triangles& triangles, int num_vertices) {
  // A diagonal without gaps, also where a vertex has no triangle.
  geometry::SparseMatrix diagonal(num_vertices, num_vertices);
  diagonal.setIdentity();
  const geometry::SparseMatrix laplacian = geometry::UniformLaplacian(triangles, num_vertices) + 0.0 * diagonal;
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
  Eigen::AMDOrdering<int>()(laplacian, inverse);
  order_ = inverse.inverse();
  laplacian_ = laplacian.twistedBy(order_);
}

Eigen::MatrixXf SurfaceFill::Solve(const VertexValues& known, const Eigen::MatrixXf& rest,
                                   const SurfaceFillOptions& options) const {
  const Eigen::Index num_vertices = laplacian_.rows();
  DAUMIER_CHECK(known.values.rows() == num_vertices && known.weights.size() == num_vertices &&
                    rest.rows() == num_vertices && rest.cols() == known.values.cols() && options.rest_weight > 0,
                "{} x {} values with {} weights of {} vertices, a rest of {} x {} and rest_weight {}",
                known.values.rows(), known.values.cols(), known.weights.size(), num_vertices, rest.rows(), rest.cols(),
                options.rest_weight);
  const Eigen::VectorXd weights = known.weights.cast<double>(), ordered = order_ * weights;
  geometry::SparseMatrix system = options.stiffness * laplacian_;
  system.diagonal().array() += ordered.array() + options.rest_weight;
  const Eigen::MatrixXd right =
      weights.asDiagonal() * known.values.cast<double>() + options.rest_weight * rest.cast<double>();
  const Eigen::SimplicialLDLT<geometry::SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(system);
  DAUMIER_CHECK(factor.info() == Eigen::Success, "a fill of a surface of {} vertices has no factor", num_vertices);
  const Eigen::MatrixXd solved = factor.solve(order_ * right);
  return (order_.inverse() * solved).cast<float>();
}

MirroredCorners FindMirroredCorners(const rig::TextureSpace& space, const std::vector<int>& mirror) {
  const int num_vertices = space.triangles.maxCoeff() + 1;
  DAUMIER_CHECK(int(mirror.size()) >= num_vertices, "a mirror map of {} vertices, expected {}", mirror.size(),
                num_vertices);
  // The different UV of each vertex.
  std::vector<std::vector<int>> uv_of(static_cast<size_t>(num_vertices));
  for (Eigen::Index t = 0; t < space.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      std::vector<int>& rows = uv_of[size_t(space.triangles(t, k))];
      if (std::ranges::find(rows, space.uv_triangles(t, k)) == rows.end()) rows.push_back(space.uv_triangles(t, k));
    }
  }
  const auto at = [&](int row) -> Eigen::Vector2f { return space.uv.row(row).transpose().cast<float>(); };
  const Eigen::Vector2f nowhere = Eigen::Vector2f::Constant(std::numeric_limits<float>::quiet_NaN());
  MirroredCorners mirrored;
  mirrored.uv.assign(size_t(space.triangles.rows()), {nowhere, nowhere, nowhere});
  for (Eigen::Index t = 0; t < space.triangles.rows(); ++t) {
    std::array<const std::vector<int>*, 3> choices{};
    bool has_image = true;
    for (int k = 0; k < 3; ++k) {
      const int image = mirror[size_t(space.triangles(t, k))];
      has_image = has_image && image >= 0 && image < num_vertices && !uv_of[size_t(image)].empty();
      if (has_image) choices[size_t(k)] = &uv_of[size_t(image)];
    }
    if (!has_image) continue;
    float shortest = std::numeric_limits<float>::infinity();
    for (const int a : *choices[0]) {
      for (const int b : *choices[1]) {
        for (const int c : *choices[2]) {
          const float length = (at(a) - at(b)).norm() + (at(b) - at(c)).norm() + (at(c) - at(a)).norm();
          if (length >= shortest) continue;
          shortest = length;
          mirrored.uv[size_t(t)] = {at(a), at(b), at(c)};
        }
      }
    }
  }
  return mirrored;
}

TexelColours MirrorTexels(const rig::TexelMap& texels, const MirroredCorners& mirrored, const TexelColours& colours) {
  CheckTexels(size_t(texels.num_texels()), colours);
  TexelColours images{std::vector<Eigen::Vector3f>(colours.colours.size(), Eigen::Vector3f::Zero()),
                      std::vector<float>(colours.weights.size(), 0.0F)};
  OnAllCores(texels.num_texels(), [&](int64_t i) {
    const int t = texels.triangles[size_t(i)];
    if (t < 0) return;
    const auto& corners = mirrored.uv[size_t(t)];
    const Eigen::Vector3f& b = texels.weights[size_t(i)];
    const Eigen::Vector2f uv = b[0] * corners[0] + b[1] * corners[1] + b[2] * corners[2];
    if (!uv.allFinite()) return;
    const float x = uv.x() * float(texels.size) - 0.5F, y = (1 - uv.y()) * float(texels.size) - 0.5F;
    const int column = std::clamp(int(std::floor(x)), 0, texels.size - 2);
    const int row = std::clamp(int(std::floor(y)), 0, texels.size - 2);
    const float on_x = std::clamp(x - float(column), 0.0F, 1.0F), on_y = std::clamp(y - float(row), 0.0F, 1.0F);
    Eigen::Vector3f colour = Eigen::Vector3f::Zero();
    float weight = 0;
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        const auto from = size_t(texels.index(row + r, column + c));
        const float share = (r == 1 ? on_y : 1 - on_y) * (c == 1 ? on_x : 1 - on_x) * colours.weights[from];
        weight += share;
        colour += share * colours.colours[from];
      }
    }
    if (weight <= 0) return;
    images.weights[size_t(i)] = weight;
    images.colours[size_t(i)] = colour / weight;
  });
  return images;
}

}  // namespace daumier::fitting
