#include "geometry/principal_curvature.h"

#include "core/error.h"
#include "geometry/normals.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <vector>

namespace daumier::geometry {
namespace {

/// An orthonormal basis of a tangent plane.
struct TangentFrame {
  Vector3 u, v;

  Vector3 normal() const { return u.cross(v); }
  /// The same basis turned, about the axis that needs the least turn, into the plane of another normal. The rotation
  /// that takes the unit vector a to b takes x, normal to a, to x - (b . x) / (1 + a . b) (a + b).
  TangentFrame TurnedTo(const Vector3& other_normal) const {
    const Vector3 sum = normal() + other_normal;
    const double one_plus_cosine = 0.5 * sum.squaredNorm();
    if (one_plus_cosine < 1e-12) return {u, -v};
    return {u - other_normal.dot(u) / one_plus_cosine * sum, v - other_normal.dot(v) / one_plus_cosine * sum};
  }
};

/// Entries uu, uv and vv of a symmetric tensor in a tangent frame.
using Tensor2 = Vector3;
/// Entries uuu, uuv, uvv and vvv of a tensor that is symmetric in all three indices.
using Tensor3 = Eigen::Vector4d;

/// A tensor seen in another frame; the frames' planes are first made one.
Tensor2 InFrame(const Tensor2& tensor, const TangentFrame& from, const TangentFrame& to) {
  const TangentFrame turned = to.TurnedTo(from.normal());
  const double u1 = turned.u.dot(from.u), v1 = turned.u.dot(from.v);
  const double u2 = turned.v.dot(from.u), v2 = turned.v.dot(from.v);
  const auto [uu, uv, vv] = std::array{tensor[0], tensor[1], tensor[2]};
  return {uu * u1 * u1 + 2 * uv * u1 * v1 + vv * v1 * v1, uu * u1 * u2 + uv * (u1 * v2 + u2 * v1) + vv * v1 * v2,
          uu * u2 * u2 + 2 * uv * u2 * v2 + vv * v2 * v2};
}

Tensor3 InFrame(const Tensor3& tensor, const TangentFrame& from, const TangentFrame& to) {
  const TangentFrame turned = to.TurnedTo(from.normal());
  const double u1 = turned.u.dot(from.u), v1 = turned.u.dot(from.v);
  const double u2 = turned.v.dot(from.u), v2 = turned.v.dot(from.v);
  const auto entry = [&](double ua, double va, double ub, double vb, double uc, double vc) {
    return tensor[0] * ua * ub * uc + tensor[1] * (ua * ub * vc + ua * vb * uc + va * ub * uc) +
           tensor[2] * (ua * vb * vc + va * ub * vc + va * vb * uc) + tensor[3] * va * vb * vc;
  };
  return {entry(u1, v1, u1, v1, u1, v1), entry(u1, v1, u1, v1, u2, v2), entry(u1, v1, u2, v2, u2, v2),
          entry(u2, v2, u2, v2, u2, v2)};
}

/// Edge k runs from corner k + 1 to corner k + 2; the frame's u lies along edge 0.
struct Triangle {
  std::array<int, 3> corners;
  TangentFrame frame;
  std::array<Eigen::Vector2d, 3> edges;  ///< In the frame.
};

/// False for a triangle without area.
bool Open(const TriangleMesh& mesh, int f, Triangle& triangle) {
  std::array<Vector3, 3> points;
  for (int k = 0; k < 3; ++k) {
    triangle.corners[k] = mesh.triangles(f, k);
    points[k] = mesh.vertices.row(triangle.corners[k]);
  }
  const Vector3 first = points[2] - points[1], normal = first.cross(points[0] - points[2]);
  if (!(normal.squaredNorm() > 0)) return false;
  triangle.frame.u = first.normalized();
  triangle.frame.v = normal.cross(triangle.frame.u).normalized();
  for (int k = 0; k < 3; ++k) {
    const Vector3 edge = points[(k + 2) % 3] - points[(k + 1) % 3];
    triangle.edges[k] = {edge.dot(triangle.frame.u), edge.dot(triangle.frame.v)};
  }
  return true;
}

TangentFrame AnyFrame(const Vector3& normal) {
  const Vector3 u = normal.unitOrthogonal();
  return {u, normal.cross(u)};
}

/// V: what CornerAreas give to each vertex.
Eigen::VectorXd AreasAround(const TriangleMesh& mesh, const Points& corner_areas) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.vertices.rows());
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) areas[mesh.triangles(f, k)] += corner_areas(f, k);
  }
  return areas;
}

template <int N>
bool SolveByLdlt(const Eigen::Matrix<double, N, N>& w, Eigen::Matrix<double, N, 1>& m_then_x) {
  Eigen::Matrix<double, N, N> lower;  // Below the diagonal alone.
  Eigen::Matrix<double, N, 1> pivots;
  for (int i = 0; i < N; ++i) {
    pivots[i] = w(i, i);
    for (int k = 0; k < i; ++k) pivots[i] -= lower(i, k) * lower(i, k) * pivots[k];
    if (!(pivots[i] > 0)) return false;
    for (int j = i + 1; j < N; ++j) {
      lower(j, i) = w(j, i);
      for (int k = 0; k < i; ++k) lower(j, i) -= lower(j, k) * lower(i, k) * pivots[k];
      lower(j, i) /= pivots[i];
    }
  }
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k < i; ++k) m_then_x[i] -= lower(i, k) * m_then_x[k];
  }
  for (int i = N - 1; i >= 0; --i) {
    m_then_x[i] /= pivots[i];
    for (int k = i + 1; k < N; ++k) m_then_x[i] -= lower(k, i) * m_then_x[k];
  }
  return true;
}

}  // namespace

bool SolveLdlt(const Eigen::Matrix3d& w, Eigen::Vector3d& m_then_x) {
  return SolveByLdlt<3>(w, m_then_x);
}

PrincipalCurvatures ComputePrincipalCurvatures(const TriangleMesh& mesh, const TensorSolver& solve) {
  const auto num_vertices = mesh.vertices.rows();
  const Points corner_areas = CornerAreas(mesh);
  const Eigen::VectorXd areas = AreasAround(mesh, corner_areas);
  PrincipalCurvatures result{VertexNormals(mesh), Eigen::VectorXd::Zero(num_vertices),
                             Eigen::VectorXd::Zero(num_vertices), Points::Zero(num_vertices, 3),
                             Points::Zero(num_vertices, 3)};
  Points tensors = Points::Zero(num_vertices, 3);
  std::vector<TangentFrame> frames;
  for (const auto& normal : result.normals.rowwise()) frames.push_back(AnyFrame(normal));
  Triangle triangle;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    if (!Open(mesh, f, triangle)) continue;
    Eigen::Matrix3d w = Eigen::Matrix3d::Zero();
    Tensor2 tensor = Tensor2::Zero();
    for (int k = 0; k < 3; ++k) {
      const double u = triangle.edges[k].x(), v = triangle.edges[k].y();
      const Vector3 change =
          (result.normals.row(triangle.corners[(k + 2) % 3]) - result.normals.row(triangle.corners[(k + 1) % 3]))
              .transpose();
      const double du = change.dot(triangle.frame.u), dv = change.dot(triangle.frame.v);
      w(0, 0) += u * u;
      w(0, 1) += u * v;
      w(2, 2) += v * v;
      tensor += Vector3(du * u, du * v + dv * u, dv * v);
    }
    w(1, 1) = w(0, 0) + w(2, 2);
    w(1, 0) = w(1, 2) = w(2, 1) = w(0, 1);
    if (!solve(w, tensor)) continue;
    for (int k = 0; k < 3; ++k) {
      const int vertex = triangle.corners[k];
      if (!(areas[vertex] > 0)) continue;
      tensors.row(vertex) +=
          corner_areas(f, k) / areas[vertex] * InFrame(tensor, triangle.frame, frames[size_t(vertex)]).transpose();
    }
  }
  for (Eigen::Index v = 0; v < num_vertices; ++v) {
    if (!(areas[v] > 0)) continue;
    const TangentFrame& frame = frames[size_t(v)];
    const double uu = tensors(v, 0), uv = tensors(v, 1), vv = tensors(v, 2);
    const double angle = 0.5 * std::atan2(2 * uv, uu - vv);  // Of the direction of the larger curvature.
    const double mean = 0.5 * (uu + vv), half = std::hypot(0.5 * (uu - vv), uv);
    const bool larger_first = std::abs(mean + half) >= std::abs(mean - half);
    const Vector3 larger = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    const Vector3 smaller = std::cos(angle) * frame.v - std::sin(angle) * frame.u;
    result.k1[v] = larger_first ? mean + half : mean - half;
    result.k2[v] = larger_first ? mean - half : mean + half;
    const Vector3 first = larger_first ? larger : smaller;
    result.direction1.row(v) = first;
    result.direction2.row(v) = Vector3(result.normals.row(v)).cross(first);
  }
  return result;
}

CurvatureDerivatives ComputeCurvatureDerivatives(const TriangleMesh& mesh, const PrincipalCurvatures& curvatures) {
  const auto num_vertices = mesh.vertices.rows();
  DAUMIER_CHECK(curvatures.k1.size() == num_vertices, "curvatures of {} vertices for a mesh of {}",
                curvatures.k1.size(), num_vertices);
  const Points corner_areas = CornerAreas(mesh);
  const Eigen::VectorXd areas = AreasAround(mesh, corner_areas);
  const auto frame_of = [&](int v) { return TangentFrame{curvatures.direction1.row(v), curvatures.direction2.row(v)}; };
  CurvatureDerivatives derivatives = CurvatureDerivatives::Zero(num_vertices, 4);
  Triangle triangle;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    if (!Open(mesh, f, triangle)) continue;
    std::array<Tensor2, 3> tensors;
    for (int k = 0; k < 3; ++k) {
      const int v = triangle.corners[k];
      tensors[k] = areas[v] > 0 ? InFrame(Tensor2(curvatures.k1[v], 0, curvatures.k2[v]), frame_of(v), triangle.frame)
                                : Tensor2::Zero();
    }
    Eigen::Matrix4d w = Eigen::Matrix4d::Zero();
    Tensor3 tensor = Tensor3::Zero();
    for (int k = 0; k < 3; ++k) {
      const double u = triangle.edges[k].x(), v = triangle.edges[k].y();
      const Tensor2 change = tensors[(k + 2) % 3] - tensors[(k + 1) % 3];
      w(0, 0) += u * u;
      w(0, 1) += u * v;
      w(3, 3) += v * v;
      tensor +=
          Tensor3(u * change[0], v * change[0] + 2 * u * change[1], 2 * v * change[1] + u * change[2], v * change[2]);
    }
    w(1, 1) = 2 * w(0, 0) + w(3, 3);
    w(2, 2) = w(0, 0) + 2 * w(3, 3);
    w(1, 2) = w(2, 1) = 2 * w(0, 1);
    w(1, 0) = w(2, 3) = w(3, 2) = w(0, 1);
    if (!SolveByLdlt<4>(w, tensor)) continue;
    for (int k = 0; k < 3; ++k) {
      const int v = triangle.corners[k];
      if (!(areas[v] > 0)) continue;
      derivatives.row(v) += corner_areas(f, k) / areas[v] * InFrame(tensor, triangle.frame, frame_of(v)).transpose();
    }
  }
  return derivatives;
}

}  // namespace daumier::geometry
