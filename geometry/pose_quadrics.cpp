#include "geometry/pose_quadrics.h"

#include "core/error.h"

#include <Eigen/Geometry>

#include <cmath>

namespace daumier::geometry {
namespace {

constexpr size_t kLanes = 8;
using Lanes = Eigen::Array<float, int(kLanes), 1>;
using ConstMap = Eigen::Map<const Lanes>;

constexpr float kLeastCosine = 0.5f;      // Of a triangle's turn in pose 0.
constexpr float kLeastThickness = 0.05f;  // Twice the area by the sum of squared edges; 0.29 of equal sides.

struct Lanes3 {
  Lanes x, y, z;
};

Lanes3 At(const float* vertex, size_t stride, size_t lane) {
  return {ConstMap(vertex + lane), ConstMap(vertex + stride + lane), ConstMap(vertex + 2 * stride + lane)};
}
Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Lanes3 Cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Lanes Dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// quadric += scale n n^T.
void AddPlane(float* quadric, size_t stride, size_t lane, const Lanes3& n, const Lanes& scale) {
  const auto add = [&](int k, const Lanes& value) { Eigen::Map<Lanes>(quadric + size_t(k) * stride + lane) += value; };
  add(0, scale * n.x * n.x);
  add(1, scale * n.x * n.y);
  add(2, scale * n.x * n.z);
  add(3, scale * n.y * n.y);
  add(4, scale * n.y * n.z);
  add(5, scale * n.z * n.z);
}

/// A d of a quadric's matrix.
Lanes3 Product(const float* quadric, size_t stride, size_t lane, const Lanes3& d) {
  const auto at = [&](int k) { return ConstMap(quadric + size_t(k) * stride + lane); };
  return {at(0) * d.x + at(1) * d.y + at(2) * d.z, at(1) * d.x + at(3) * d.y + at(4) * d.z,
          at(2) * d.x + at(4) * d.y + at(5) * d.z};
}

}  // namespace

PoseQuadrics::PoseQuadrics(const Points& rest, const Eigen::MatrixXf& offsets)
    : num_poses_(int(offsets.cols()) + 1), stride_((size_t(num_poses_) + kLanes - 1) / kLanes * kLanes) {
  const Eigen::Index num_vertices = rest.rows();
  DAUMIER_CHECK(offsets.cols() == 0 || offsets.rows() == 3 * num_vertices, "{} offsets for {} vertices, expected {}",
                offsets.rows(), num_vertices, 3 * num_vertices);
  positions_.resize(size_t(num_vertices) * 3 * stride_);
  quadrics_.resize(size_t(num_vertices) * 10 * stride_, 0.0f);
  for (Eigen::Index i = 0; i < 3 * num_vertices; ++i) {
    float* const row = positions_.data() + size_t(i) * stride_;
    const auto at_rest = float(rest.data()[i]);
    std::fill(row, row + stride_, at_rest);
    for (Eigen::Index t = 0; t < offsets.cols(); ++t) row[t + 1] = at_rest + offsets(i, t);
  }
}

void PoseQuadrics::AddTriangle(int a, int b, int c, float weight) {
  for (size_t lane = 0; lane < stride_; lane += kLanes) {
    const Lanes3 p = At(PositionOf(a), stride_, lane);
    const Lanes3 n = Cross(At(PositionOf(b), stride_, lane) - p, At(PositionOf(c), stride_, lane) - p);
    const Lanes length = Dot(n, n).sqrt();
    const Lanes scale =
        (length > 0).select(weight / 6 / length.max(1e-30f), 0.0f);  // weight area / 3, n of unit length.
    for (const int v : {a, b, c}) AddPlane(QuadricOf(v), stride_, lane, n, scale);
  }
}

void PoseQuadrics::AddEdge(int a, int b, int c, float weight) {
  for (size_t lane = 0; lane < stride_; lane += kLanes) {
    const Lanes3 p = At(PositionOf(a), stride_, lane), edge = At(PositionOf(b), stride_, lane) - p;
    const Lanes3 n = Cross(edge, Cross(edge, At(PositionOf(c), stride_, lane) - p));
    const Lanes squared = Dot(n, n);
    const Lanes scale = (squared > 1e-24f).select(weight * Dot(edge, edge) / squared.max(1e-24f), 0.0f);
    for (const int v : {a, b}) AddPlane(QuadricOf(v), stride_, lane, n, scale);
  }
}

float PoseQuadrics::Cost(int from, int to) const {
  const float* const quadric = QuadricOf(from);
  const float* const constant = QuadricOf(to) + 9 * stride_;
  Lanes sum = Lanes::Zero(), most = Lanes::Zero();
  for (size_t lane = 0; lane < stride_; lane += kLanes) {
    const Lanes3 d = At(PositionOf(to), stride_, lane) - At(PositionOf(from), stride_, lane);
    Lanes3 product = Product(quadric, stride_, lane, d);
    const auto at = [&](int k) { return ConstMap(quadric + size_t(k) * stride_ + lane); };
    product = {product.x + 2 * at(6), product.y + 2 * at(7), product.z + 2 * at(8)};
    const Lanes value = (Dot(product, d) + at(9)).max(0.0f) + ConstMap(constant + lane);
    most = most.max(value);
    sum += value;
  }
  return sum.sum() / float(stride_) + most.maxCoeff();
}

void PoseQuadrics::Merge(int from, int to) {
  const float* const source = QuadricOf(from);
  float* const target = QuadricOf(to);
  for (size_t lane = 0; lane < stride_; lane += kLanes) {
    const Lanes3 d = At(PositionOf(to), stride_, lane) - At(PositionOf(from), stride_, lane);
    const Lanes3 product = Product(source, stride_, lane, d);
    const auto at = [&](int k) { return ConstMap(source + size_t(k) * stride_ + lane); };
    const auto add = [&](int k, const Lanes& value) {
      Eigen::Map<Lanes>(target + size_t(k) * stride_ + lane) += value;
    };
    for (int k = 0; k < 6; ++k) add(k, at(k));
    add(6, at(6) + product.x);
    add(7, at(7) + product.y);
    add(8, at(8) + product.z);
    const Lanes3 moved = {product.x + 2 * at(6), product.y + 2 * at(7), product.z + 2 * at(8)};
    add(9, (Dot(moved, d) + at(9)).max(0.0f));
  }
}

bool PoseQuadrics::MayMove(int from, int to, int a, int b) const {
  for (size_t lane = 0; lane < stride_; lane += kLanes) {
    const Lanes3 p = At(PositionOf(a), stride_, lane), edge = At(PositionOf(b), stride_, lane) - p;
    const Lanes3 before = At(PositionOf(from), stride_, lane) - p, after = At(PositionOf(to), stride_, lane) - p;
    const Lanes3 old_normal = Cross(edge, before), normal = Cross(edge, after);
    const Lanes cosine = Dot(old_normal, normal);
    if ((cosine < 0).any()) return false;
    if (lane > 0) continue;
    const float old_area = std::sqrt(Dot(old_normal, old_normal)[0]), area = std::sqrt(Dot(normal, normal)[0]);
    if (old_area > 0 && cosine[0] <= kLeastCosine * old_area * area) return false;
    const auto thickness = [&](float twice_area, const Lanes3& side) {
      const Lanes3 other = side - edge;
      return twice_area / (Dot(edge, edge)[0] + Dot(side, side)[0] + Dot(other, other)[0]);
    };
    const float thin = thickness(area, after);
    if (thin < kLeastThickness && thin < thickness(old_area, before)) return false;
  }
  return true;
}

}  // namespace daumier::geometry
