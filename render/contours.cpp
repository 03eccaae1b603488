#include "render/contours.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace daumier::render {
namespace {

using Eigen::Vector3d;
using geometry::Points;
using geometry::TriangleMesh;

/// P x 3: unit vectors from the points towards the viewer.
Points TowardsViewer(const Camera& camera, const Points& points) {
  const Vector3d axis = camera.camera_from_world.row(2);  // Away from the viewer.
  if (!camera.perspective) return (-axis.transpose()).replicate(points.rows(), 1);
  const Vector3d eye = -camera.camera_from_world.transpose() * camera.translation;
  return ((-points).rowwise() + eye.transpose()).rowwise().normalized();
}

/// The line value = 0 across a triangle: two points on its edges, each `share` of the way between two of its corners.
struct Crossing {
  std::array<int, 2> corners;
  double share;

  template <class Values>
  double Of(const Values& values, const Eigen::RowVector3i& triangle) const {
    return (1 - share) * values[triangle[corners[0]]] + share * values[triangle[corners[1]]];
  }
  Vector3d On(const TriangleMesh& mesh, int f) const {
    return (1 - share) * mesh.vertices.row(mesh.triangles(f, corners[0])) +
           share * mesh.vertices.row(mesh.triangles(f, corners[1]));
  }
  std::array<int, 2> EdgeIn(const Eigen::RowVector3i& triangle) const {
    const auto [low, high] = std::minmax({triangle[corners[0]], triangle[corners[1]]});
    return {low, high};
  }
};

/// The crossings on the edges from the corner whose sign is alone to the two others; nothing where signs agree.
std::optional<std::array<Crossing, 2>> ZeroLine(const Eigen::VectorXd& values, const Eigen::RowVector3i& triangle) {
  std::array<bool, 3> is_negative;
  for (int k = 0; k < 3; ++k) is_negative[k] = values[triangle[k]] < 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    if (is_negative[next] != is_negative[last] || is_negative[k] == is_negative[next]) continue;
    const auto crossing = [&](int other) {
      const double here = values[triangle[k]], there = values[triangle[other]];
      return Crossing{{k, other}, here / (here - there)};
    };
    return std::array{crossing(next), crossing(last)};
  }
  return std::nullopt;
}

/// A number that runs linearly from one end of a segment to the other.
struct Along {
  double from, to;

  double at(double share) const { return (1 - share) * from + share * to; }
};

/// Appends the parts of the line between two crossings on which numerator / denominator and `margin` are not negative.
void AppendWherePositive(const TriangleMesh& mesh, int f, const std::array<Crossing, 2>& line, const Along& numerator,
                         const Along& denominator, const Along& margin, std::vector<ContourSegment>& segments) {
  std::vector<double> cuts = {0.0, 1.0};
  for (const Along& values : {numerator, denominator, margin}) {
    if ((values.from < 0) != (values.to < 0)) cuts.push_back(values.from / (values.from - values.to));
  }
  std::sort(cuts.begin(), cuts.end());
  const Vector3d a = line[0].On(mesh, f), b = line[1].On(mesh, f);
  const auto end_at = [&](double share) {
    ContourEnd end{(1 - share) * a + share * b, numerator.at(share) / denominator.at(share)};
    if (share == 0.0) end.edge = line[0].EdgeIn(mesh.triangles.row(f));
    if (share == 1.0) end.edge = line[1].EdgeIn(mesh.triangles.row(f));
    return end;
  };
  for (size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
    const bool is_kept = numerator.at(middle) * denominator.at(middle) >= 0 && margin.at(middle) >= 0;
    if (is_kept && cuts[i + 1] > cuts[i]) segments.push_back({f, end_at(cuts[i]), end_at(cuts[i + 1])});
  }
}

}  // namespace

double FeatureSize(const TriangleMesh& mesh, const geometry::PrincipalCurvatures& curvatures) {
  const auto num_vertices = static_cast<uint32_t>(mesh.vertices.rows());
  DAUMIER_CHECK(num_vertices > 0, "a mesh without vertices has no features");
  constexpr uint32_t kMaxSamples = 500;
  constexpr double kPercentile = 0.1;
  std::vector<double> magnitudes;
  uint32_t random = 0;  // The generator of Numerical Recipes, so that the sample is always the same.
  for (uint32_t i = 0; i < std::min(kMaxSamples, num_vertices); ++i) {
    random = 1664525u * random + 1013904223u;
    const auto v = static_cast<Eigen::Index>(random % num_vertices);
    magnitudes.insert(magnitudes.end(), {std::abs(curvatures.k1[v]), std::abs(curvatures.k2[v])});
  }
  const auto rank = magnitudes.begin() + static_cast<std::ptrdiff_t>(kPercentile * double(magnitudes.size()));
  std::nth_element(magnitudes.begin(), rank, magnitudes.end());
  const Eigen::RowVector3d middle = 0.5 * (mesh.vertices.colwise().minCoeff() + mesh.vertices.colwise().maxCoeff());
  const double radius = (mesh.vertices.rowwise() - middle).rowwise().norm().maxCoeff();
  const double size = *rank > 0 ? std::min(0.01 / *rank, 0.05 * radius) : 0.05 * radius;
  DAUMIER_CHECK(size > 0, "all vertices lie in one point");
  return size;
}

ViewCurvature ComputeViewCurvature(const TriangleMesh& mesh, const geometry::PrincipalCurvatures& curvatures,
                                   const geometry::CurvatureDerivatives& derivatives, const Camera& camera,
                                   double threshold) {
  const auto num_vertices = mesh.vertices.rows();
  DAUMIER_CHECK(curvatures.k1.size() == num_vertices && derivatives.rows() == num_vertices,
                "curvatures of {} and derivatives of {} vertices for a mesh of {}", curvatures.k1.size(),
                derivatives.rows(), num_vertices);
  const Points towards = TowardsViewer(camera, mesh.vertices);
  ViewCurvature view{Eigen::VectorXd(num_vertices), Eigen::VectorXd(num_vertices), Eigen::VectorXd(num_vertices)};
  for (Eigen::Index i = 0; i < num_vertices; ++i) {
    const double u = towards.row(i).dot(curvatures.direction1.row(i));
    const double v = towards.row(i).dot(curvatures.direction2.row(i));
    const double k1 = curvatures.k1[i], k2 = curvatures.k2[i], sine2 = u * u + v * v;
    view.n_dot_v[i] = towards.row(i).dot(curvatures.normals.row(i));
    view.radial[i] = k1 * u * u + k2 * v * v;
    double along = 0;  // D_w kappa_r sin(theta): the tensor's derivative along w, and the turning of w itself.
    if (sine2 > 0) {
      const auto c = derivatives.row(i);
      const double twist = (k2 - k1) * u * v / sine2;
      along = (u * u * (u * c[0] + 3 * v * c[1]) + v * v * (3 * u * c[2] + v * c[3])) / sine2 -
              2 * view.n_dot_v[i] * twist * twist;
    }
    view.rise[i] = along - threshold * view.n_dot_v[i];
  }
  return view;
}

std::vector<ContourSegment> SuggestiveContours(const TriangleMesh& mesh, const ViewCurvature& view,
                                               double max_n_dot_v) {
  std::vector<ContourSegment> segments;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::RowVector3i triangle = mesh.triangles.row(f);
    const auto faces_away = [&](int v) { return view.n_dot_v[v] <= 0; };
    if (std::all_of(triangle.begin(), triangle.end(), faces_away)) continue;
    const auto line = ZeroLine(view.radial, triangle);
    if (!line) continue;
    const auto& [a, b] = *line;
    const Along n_dot_v{a.Of(view.n_dot_v, triangle), b.Of(view.n_dot_v, triangle)};
    AppendWherePositive(mesh, f, *line, {a.Of(view.rise, triangle), b.Of(view.rise, triangle)}, n_dot_v,
                        {max_n_dot_v - n_dot_v.from, max_n_dot_v - n_dot_v.to}, segments);
  }
  return segments;
}

std::vector<ContourSegment> OccludingContours(const TriangleMesh& mesh, const ViewCurvature& view) {
  std::vector<ContourSegment> segments;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::RowVector3i triangle = mesh.triangles.row(f);
    const auto line = ZeroLine(view.n_dot_v, triangle);
    if (!line) continue;
    const auto& [a, b] = *line;
    AppendWherePositive(mesh, f, *line, {a.Of(view.radial, triangle), b.Of(view.radial, triangle)}, {1.0, 1.0},
                        {1.0, 1.0}, segments);
  }
  return segments;
}

std::vector<ContourSegment> Borders(const TriangleMesh& mesh) {
  std::map<std::array<int, 2>, int> num_triangles;
  const auto edge_of = [&](int f, int k) {
    const auto [low, high] = std::minmax({mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)});
    return std::array{low, high};
  };
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) ++num_triangles[edge_of(f, k)];
  }
  std::vector<ContourSegment> segments;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (num_triangles.at(edge_of(f, k)) != 1) continue;
      const int from = mesh.triangles(f, k), to = mesh.triangles(f, (k + 1) % 3);
      segments.push_back({f, {mesh.vertices.row(from), 0, {from, from}}, {mesh.vertices.row(to), 0, {to, to}}});
    }
  }
  return segments;
}

}  // namespace daumier::render
