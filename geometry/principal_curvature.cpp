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
  Vector3 u, v, normal;
};

TangentFrame AnyFrame(const Vector3& normal) {
  const Vector3 u = normal.unitOrthogonal();
  return {u, normal.cross(u), normal};
}

/// How far the u of one frame is turned against that of another, once their planes are made one about the axis that
/// needs the least turn.
struct Turn {
  double cosine, sine;

  Turn Back() const { return {cosine, -sine}; }
};

/// Where u of `to` lies in `from`. The rotation that takes the unit vector a to b takes x, normal to a, to
/// x - (b . x) / (1 + a . b) (a + b), and b is normal to u and v of `from`.
Turn TurnBetween(const TangentFrame& from, const TangentFrame& to) {
  const double one_plus_cosine = 1 + to.normal.dot(from.normal);
  if (one_plus_cosine < 1e-12) return {to.u.dot(from.u), to.u.dot(from.v)};
  const double share = from.normal.dot(to.u) / one_plus_cosine;
  return {to.u.dot(from.u) - share * to.normal.dot(from.u), to.u.dot(from.v) - share * to.normal.dot(from.v)};
}

/// Entries uu, uv and vv of a symmetric tensor in a tangent frame.
using Tensor2 = Vector3;
/// Entries uuu, uuv, uvv and vvv of a tensor that is symmetric in all three indices.
using Tensor3 = Eigen::Vector4d;

/// A tensor in the frame whose u is turned by `turn`.
Tensor2 Turned(const Tensor2& tensor, const Turn& turn) {
  const auto [c, s] = turn;
  const auto [uu, uv, vv] = std::array{tensor[0], tensor[1], tensor[2]};
  return {c * c * uu + 2 * c * s * uv + s * s * vv, c * s * (vv - uu) + (c * c - s * s) * uv,
          s * s * uu - 2 * c * s * uv + c * c * vv};
}

Tensor3 Turned(const Tensor3& tensor, const Turn& turn) {
  const auto [c, s] = turn;
  const auto entry = [&](double ua, double va, double ub, double vb, double uc, double vc) {
    return tensor[0] * ua * ub * uc + tensor[1] * (ua * ub * vc + ua * vb * uc + va * ub * uc) +
           tensor[2] * (ua * vb * vc + va * ub * vc + va * vb * uc) + tensor[3] * va * vb * vc;
  };
  return {entry(c, s, c, s, c, s), entry(c, s, c, s, -s, c), entry(c, s, -s, c, -s, c), entry(-s, c, -s, c, -s, c)};
}

/// A triangle that has area. Edge k runs from corner k + 1 to corner k + 2; the frame's u lies along edge 0.
struct Triangle {
  std::array<int, 3> corners;
  TangentFrame frame;
  std::array<Eigen::Vector2d, 3> edges;  ///< In the frame.
  std::array<double, 3> shares;          ///< Of each corner in the area around its vertex.
};

std::vector<Triangle> OpenTriangles(const TriangleMesh& mesh) {
  const Points corner_areas = CornerAreas(mesh);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.vertices.rows());
  std::vector<Triangle> triangles;
  triangles.reserve(static_cast<size_t>(mesh.triangles.rows()));
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    Triangle triangle;
    std::array<Vector3, 3> points;
    for (int k = 0; k < 3; ++k) {
      triangle.corners[k] = mesh.triangles(f, k);
      points[k] = mesh.vertices.row(triangle.corners[k]);
      triangle.shares[k] = corner_areas(f, k);
      areas[triangle.corners[k]] += corner_areas(f, k);
    }
    const Vector3 first = points[2] - points[1], normal = first.cross(points[0] - points[2]);
    if (!(normal.squaredNorm() > 0)) continue;
    triangle.frame.u = first.normalized();
    triangle.frame.normal = normal.normalized();
    triangle.frame.v = triangle.frame.normal.cross(triangle.frame.u);
    for (int k = 0; k < 3; ++k) {
      const Vector3 edge = points[(k + 2) % 3] - points[(k + 1) % 3];
      triangle.edges[k] = {edge.dot(triangle.frame.u), edge.dot(triangle.frame.v)};
    }
    triangles.push_back(triangle);
  }
  for (Triangle& triangle : triangles) {
    for (int k = 0; k < 3; ++k) {
      const double area = areas[triangle.corners[k]];
      triangle.shares[k] = area > 0 ? triangle.shares[k] / area : 0;
    }
  }
  return triangles;
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

PrincipalCurvatures CurvaturesOf(const TriangleMesh& mesh, const std::vector<Triangle>& triangles,
                                 const TensorSolver& solve) {
  const auto num_vertices = mesh.vertices.rows();
  PrincipalCurvatures result{VertexNormals(mesh), Eigen::VectorXd::Zero(num_vertices),
                             Eigen::VectorXd::Zero(num_vertices), Points::Zero(num_vertices, 3),
                             Points::Zero(num_vertices, 3)};
  std::vector<TangentFrame> frames;
  std::vector<Tensor2> tensors(static_cast<size_t>(num_vertices), Tensor2::Zero());
  std::vector<bool> has_area(static_cast<size_t>(num_vertices));
  for (const auto& normal : result.normals.rowwise()) frames.push_back(AnyFrame(normal));
  for (const Triangle& triangle : triangles) {
    Eigen::Matrix3d w = Eigen::Matrix3d::Zero();
    Tensor2 tensor = Tensor2::Zero();
    for (int k = 0; k < 3; ++k) {
      const double u = triangle.edges[k].x(), v = triangle.edges[k].y();
      const Vector3 change =
          frames[size_t(triangle.corners[(k + 2) % 3])].normal - frames[size_t(triangle.corners[(k + 1) % 3])].normal;
      const double du = change.dot(triangle.frame.u), dv = change.dot(triangle.frame.v);
      w(0, 0) += u * u;
      w(0, 1) += u * v;
      w(2, 2) += v * v;
      tensor += Vector3(du * u, du * v + dv * u, dv * v);
    }
    w(1, 1) = w(0, 0) + w(2, 2);
    w(1, 0) = w(1, 2) = w(2, 1) = w(0, 1);
    const bool is_solved = solve(w, tensor);
    for (int k = 0; k < 3; ++k) {
      const auto vertex = static_cast<size_t>(triangle.corners[k]);
      has_area[vertex] = has_area[vertex] || triangle.shares[k] > 0;
      if (is_solved)
        tensors[vertex] += triangle.shares[k] * Turned(tensor, TurnBetween(triangle.frame, frames[vertex]));
    }
  }
  for (Eigen::Index v = 0; v < num_vertices; ++v) {
    if (!has_area[size_t(v)]) continue;
    const TangentFrame& frame = frames[size_t(v)];
    const Tensor2& tensor = tensors[size_t(v)];
    const double uu = tensor[0], uv = tensor[1], vv = tensor[2];
    const double angle = 0.5 * std::atan2(2 * uv, uu - vv);  // Of the direction of the larger curvature.
    const double mean = 0.5 * (uu + vv), half = std::hypot(0.5 * (uu - vv), uv);
    const bool larger_first = std::abs(mean + half) >= std::abs(mean - half);
    const Vector3 larger = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    const Vector3 smaller = std::cos(angle) * frame.v - std::sin(angle) * frame.u;
    result.k1[v] = larger_first ? mean + half : mean - half;
    result.k2[v] = larger_first ? mean - half : mean + half;
    const Vector3 first = larger_first ? larger : smaller;
    result.direction1.row(v) = first;
    result.direction2.row(v) = frame.normal.cross(first);
  }
  return result;
}

CurvatureDerivatives DerivativesOf(const TriangleMesh& mesh, const std::vector<Triangle>& triangles,
                                   const PrincipalCurvatures& curvatures) {
  CurvatureDerivatives derivatives = CurvatureDerivatives::Zero(mesh.vertices.rows(), 4);
  for (const Triangle& triangle : triangles) {
    std::array<Turn, 3> turns;  // From the triangle to its vertices.
    std::array<Tensor2, 3> tensors;
    for (int k = 0; k < 3; ++k) {
      const int v = triangle.corners[k];
      turns[k] = TurnBetween(triangle.frame,
                             {curvatures.direction1.row(v), curvatures.direction2.row(v), curvatures.normals.row(v)});
      tensors[k] = Turned(Tensor2(curvatures.k1[v], 0, curvatures.k2[v]), turns[k].Back());
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
    for (int k = 0; k < 3; ++k)
      derivatives.row(triangle.corners[k]) += triangle.shares[k] * Turned(tensor, turns[k]).transpose();
  }
  return derivatives;
}

}  // namespace

bool SolveLdlt(const Eigen::Matrix3d& w, Eigen::Vector3d& m_then_x) {
  return SolveByLdlt<3>(w, m_then_x);
}

PrincipalCurvatures ComputePrincipalCurvatures(const TriangleMesh& mesh, const TensorSolver& solve) {
  return CurvaturesOf(mesh, OpenTriangles(mesh), solve);
}

CurvatureDerivatives ComputeCurvatureDerivatives(const TriangleMesh& mesh, const PrincipalCurvatures& curvatures) {
  DAUMIER_CHECK(curvatures.k1.size() == mesh.vertices.rows(), "curvatures of {} vertices for a mesh of {}",
                curvatures.k1.size(), mesh.vertices.rows());
  return DerivativesOf(mesh, OpenTriangles(mesh), curvatures);
}

SurfaceCurvature ComputeSurfaceCurvature(const TriangleMesh& mesh) {
  const std::vector<Triangle> triangles = OpenTriangles(mesh);
  PrincipalCurvatures principal = CurvaturesOf(mesh, triangles, [](const auto& w, auto& m) { return SolveLdlt(w, m); });
  CurvatureDerivatives derivatives = DerivativesOf(mesh, triangles, principal);
  return {std::move(principal), std::move(derivatives)};
}

}  // namespace daumier::geometry
