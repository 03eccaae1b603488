#include "faces/neck_cut.h"

#include "geometry/topology.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

constexpr int kOrders = 3;
constexpr double kFarthestEdges = 4, kClearEdges = 0.3;
constexpr int kSmoothings = 6;

/// The cap's rings: size as a share of the loop's, height as a share of the loop's radius, and the share of the loop's
/// own heights over its plane that is left.
struct CapRing {
  double scale, height, unevenness;
};
constexpr std::array<CapRing, kCapRings> kRings = {
    {{0.985, 0.035, 0.95}, {0.94, 0.06, 0.8}, {0.66, 0.06, 0.2}, {0.33, 0.055, 0.0}}};
constexpr double kCapMiddle = 0.055;

/// The sum of the cross products of a loop's edges: twice its area vector, to the side away from the surface.
geometry::Vector3 AreaVector(const geometry::Points& loop, const geometry::Vector3& centre) {
  geometry::Vector3 sum = geometry::Vector3::Zero();
  for (Eigen::Index i = 0; i < loop.rows(); ++i) {
    const geometry::Vector3 a = loop.row(i).transpose() - centre,
                            b = loop.row((i + 1) % loop.rows()).transpose() - centre;
    sum += b.cross(a);
  }
  return sum;
}

double MeanEdge(const geometry::Points& loop) {
  double sum = 0;
  for (Eigen::Index i = 0; i < loop.rows(); ++i) sum += (loop.row(i) - loop.row((i + 1) % loop.rows())).norm();
  return sum / double(loop.rows());
}

/// Heights over the best plane of a border as a function of the angle.
class BorderFit {
 public:
  explicit BorderFit(const geometry::Points& border) : centre_(border.colwise().mean().transpose()) {
    const geometry::Points centred = border.rowwise() - centre_.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred.transpose() * centred);
    frame_ = axes.eigenvectors();  // The first is the plane's normal.
    if (frame_.col(0).dot(AreaVector(border, centre_)) < 0) frame_.col(0) = -frame_.col(0);
    Eigen::MatrixXd terms(border.rows(), 2 * kOrders + 1);
    for (Eigen::Index i = 0; i < border.rows(); ++i) terms.row(i) = Terms(Local(border.row(i).transpose()));
    weights_ = terms.colPivHouseholderQr().solve(centred * frame_.col(0));
  }

  /// How far a point lies beyond the fit, away from the head.
  double Beyond(const geometry::Vector3& point) const {
    const geometry::Vector3 local = Local(point);
    return local.x() - Terms(local).dot(weights_);
  }

 private:
  geometry::Vector3 Local(const geometry::Vector3& point) const { return frame_.transpose() * (point - centre_); }

  static Eigen::RowVectorXd Terms(const geometry::Vector3& local) {
    const double angle = std::atan2(local.z(), local.y());
    Eigen::RowVectorXd terms(2 * kOrders + 1);
    terms[0] = 1;
    for (int k = 1; k <= kOrders; ++k) {
      terms[2 * k - 1] = std::cos(k * angle);
      terms[2 * k] = std::sin(k * angle);
    }
    return terms;
  }

  geometry::Vector3 centre_;
  Eigen::Matrix3d frame_;
  Eigen::VectorXd weights_;
};

/// Values on the vertices, positive on those that are connected to the border where `values` are.
Eigen::VectorXd ConnectedTo(const std::vector<int>& border, const Eigen::VectorXd& values,
                            const geometry::Adjacency& neighbours) {
  Eigen::VectorXd connected = values.cwiseMin(0.0);
  std::vector<int> open(border);
  for (const int v : border) connected[v] = values[v];
  while (!open.empty()) {
    const int v = open.back();
    open.pop_back();
    for (const int next : neighbours[v]) {
      if (values[next] <= 0 || connected[next] > 0) continue;
      connected[next] = values[next];
      open.push_back(next);
    }
  }
  return connected;
}

}  // namespace

geometry::LevelCut CutBorder(const geometry::TriangleMesh& neutral, const std::vector<int>& border,
                             const std::vector<int>& kept) {
  const int num_vertices = static_cast<int>(neutral.vertices.rows());
  const geometry::LevelCut whole{{}, neutral.triangles, neutral.uv, neutral.uv_triangles};
  if (border.size() < 2 * kOrders + 2) return whole;
  const geometry::Points points = LoopPoints(neutral.vertices, border);
  const BorderFit fit(points);
  double deepest = 0;
  for (const auto& row : points.rowwise()) deepest = std::min(deepest, fit.Beyond(row.transpose()));
  const double edge = MeanEdge(points), level = deepest - kClearEdges * edge;
  if (-level > kFarthestEdges * edge) return whole;

  Eigen::VectorXd values(num_vertices);
  for (int v = 0; v < num_vertices; ++v) values[v] = fit.Beyond(neutral.vertices.row(v).transpose()) - level;
  values = ConnectedTo(border, values, geometry::VertexNeighbours(neutral.triangles, num_vertices));
  for (const int v : kept)
    if (values[v] > 0) return whole;
  geometry::LevelCut cut = geometry::CutPositive(neutral, values);
  const auto num_holes = [](const geometry::Triangles& triangles, size_t num_points) {
    return geometry::BoundaryLoops(triangles, static_cast<int>(num_points)).size();
  };
  const size_t num_old = size_t(num_vertices);
  const bool is_same = num_holes(cut.triangles, num_old + cut.points.size()) == num_holes(neutral.triangles, num_old);
  return is_same ? cut : whole;
}

geometry::Points SmoothlyMoved(const geometry::Points& neutral_loop, const geometry::Points& loop) {
  const Eigen::Index n = loop.rows();
  const auto before = [n](Eigen::Index row) { return (row + n - 1) % n; };
  const auto after = [n](Eigen::Index row) { return (row + 1) % n; };
  Eigen::VectorXd share_after(n);  // Of the neighbour after a point in the line between its neighbours at its place.
  for (Eigen::Index row = 0; row < n; ++row) {
    const double from = (neutral_loop.row(row) - neutral_loop.row(before(row))).norm(),
                 to = (neutral_loop.row(after(row)) - neutral_loop.row(row)).norm();
    share_after[row] = from + to > 0 ? from / (from + to) : 0.5;
  }
  geometry::Points moved = loop - neutral_loop;
  for (int i = 0; i < kSmoothings; ++i) {
    const geometry::Points old = moved;
    for (Eigen::Index row = 0; row < n; ++row)
      moved.row(row) =
          0.5 * (old.row(row) + (1 - share_after[row]) * old.row(before(row)) + share_after[row] * old.row(after(row)));
  }
  return neutral_loop + moved;
}

geometry::Points CapPoints(const geometry::Points& loop) {
  const geometry::Vector3 centre = loop.colwise().mean().transpose(), area = AreaVector(loop, centre);
  const double length = area.norm(), radius = std::sqrt(length / (2 * std::numbers::pi));
  const geometry::Vector3 normal = length > 0 ? geometry::Vector3(area / length) : geometry::Vector3::Zero();
  const geometry::Vector3 out = radius * normal;
  const geometry::Points centred = loop.rowwise() - centre.transpose();
  const geometry::Points heights = centred * normal * normal.transpose();
  geometry::Points points(kCapRings * loop.rows() + 1, 3);
  Eigen::Index row = 0;
  for (const CapRing& ring : kRings) {
    const geometry::Vector3 moved = centre + ring.height * out;
    points.middleRows(row, loop.rows()) =
        (ring.scale * (centred - heights) + ring.unevenness * heights).rowwise() + moved.transpose();
    row += loop.rows();
  }
  points.row(points.rows() - 1) = (centre + kCapMiddle * out).transpose();
  return points;
}

}  // namespace daumier::faces
