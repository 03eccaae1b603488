#include "rig/head_charts.h"

#include "core/error.h"
#include "faces/eyeball.h"
#include "geometry/corner_uv.h"
#include "geometry/topology.h"
#include "rig/atlas_layout.h"
#include "rig/head_unwrap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace daumier::rig {
namespace {

constexpr int kMostIslands = 4, kOverlapTexels = 1024;
constexpr double kLeastEyeShare = 0.2, kBackOfHeadSize = 0.6;
constexpr int kFirstFaceLandmark = 17, kRightEyeLandmark = 36, kLeftEyeLandmark = 45;

Eigen::RowVector2d OnDisc(double turns, double radius) {
  const double angle = 2 * std::numbers::pi * turns;
  return {0.5 + 0.5 * radius * std::cos(angle), 0.5 + 0.5 * radius * std::sin(angle)};
}

/// The triangles of a chart that its UV connects, each as a piece; the one with most landmarks first.
std::vector<ChartPiece> IslandsOf(const geometry::TriangleMesh& skin, const std::vector<bool>& is_landmark) {
  const int num_rows = int(skin.uv.rows());
  const std::vector<int> island_of_row =
      geometry::ConnectedComponents(geometry::VertexNeighbours(skin.uv_triangles, num_rows));
  std::vector<std::vector<int>> triangles;
  triangles.resize(size_t(num_rows));
  for (Eigen::Index t = 0; t < skin.triangles.rows(); ++t)
    triangles[size_t(island_of_row[size_t(skin.uv_triangles(t, 0))])].push_back(int(t));
  std::erase_if(triangles, [](const std::vector<int>& of) { return of.empty(); });
  struct Island {
    ChartPiece piece;
    int num_landmarks;
    double extent;
  };
  std::vector<Island> islands;
  for (const std::vector<int>& of : triangles) {
    geometry::TriangleMesh part{{}, skin.triangles(of, Eigen::all), skin.uv, skin.uv_triangles(of, Eigen::all)};
    geometry::RemoveUnusedUv(part);
    const auto corners = part.triangles.reshaped();
    const int num_landmarks =
        int(std::count_if(corners.begin(), corners.end(), [&](int v) { return is_landmark[size_t(v)]; }));
    const double extent = (part.uv.colwise().maxCoeff() - part.uv.colwise().minCoeff()).maxCoeff();
    islands.push_back({{TextureChart::kSkin, part.triangles, part.uv, part.uv_triangles, 1}, num_landmarks, extent});
  }
  std::stable_sort(islands.begin(), islands.end(),
                   [](const Island& a, const Island& b) { return a.num_landmarks > b.num_landmarks; });
  std::vector<ChartPiece> pieces;
  for (Island& island : islands) {
    island.piece.size = (island.num_landmarks > 0 ? 1 : kBackOfHeadSize) * island.extent / islands.front().extent;
    pieces.push_back(std::move(island.piece));
  }
  return pieces;
}

/// The row of a piece's UV at a vertex, if it has one.
int RowAt(const ChartPiece& piece, int vertex) {
  for (Eigen::Index i = 0; i < piece.triangles.size(); ++i)
    if (piece.triangles.data()[i] == vertex) return piece.uv_triangles.data()[i];
  return -1;
}

/// How far apart two vertices are in a piece, as a share of its longer side; 0 unless both are there.
double ShareBetween(const ChartPiece& piece, int a, int b) {
  const int first = RowAt(piece, a), second = RowAt(piece, b);
  if (first < 0 || second < 0) return 0;
  return (piece.uv.row(first) - piece.uv.row(second)).norm() /
         (piece.uv.colwise().maxCoeff() - piece.uv.colwise().minCoeff()).maxCoeff();
}

bool HasFolds(const geometry::TriangleMesh& mesh) {
  return std::any_of(mesh.uv_triangles.rowwise().begin(), mesh.uv_triangles.rowwise().end(), [&](const auto& t) {
    const Eigen::RowVector2d a = mesh.uv.row(t[0]), b = mesh.uv.row(t[1]) - a, c = mesh.uv.row(t[2]) - a;
    return b.x() * c.y() - b.y() * c.x() <= 0;
  });
}

}  // namespace

ChartPiece ClosureChart(const faces::HoleClosure& closure, TextureChart chart, double size) {
  const int num = closure.size(), num_rings = closure.num_rings;
  ChartPiece piece{chart, {}, {}, {}, size};
  piece.uv.resize((num_rings + 1) * num + 1, 2);
  for (int ring = 0; ring <= num_rings; ++ring)
    for (int i = 0; i < num; ++i)  // Clockwise: the loop runs against the patch.
      piece.uv.row(ring * num + i) = OnDisc(-double(i) / num, 1 - double(ring) / (num_rings + 1));
  piece.uv.row((num_rings + 1) * num) = OnDisc(0, 0);
  const auto triangles = closure.Triangles();
  piece.triangles.resize(Eigen::Index(triangles.size()), 3);
  piece.uv_triangles.resize(Eigen::Index(triangles.size()), 3);
  std::vector<std::pair<int, int>> of_loop;  // Vertex, row.
  for (int i = 0; i < num; ++i) of_loop.emplace_back(closure.loop[size_t(i)], i);
  std::sort(of_loop.begin(), of_loop.end());
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int vertex = triangles[t][k];
      piece.triangles(Eigen::Index(t), k) = vertex;
      piece.uv_triangles(Eigen::Index(t), k) =
          vertex >= closure.first_vertex && vertex <= closure.apex()
              ? num + vertex - closure.first_vertex
              : std::lower_bound(of_loop.begin(), of_loop.end(), std::pair(vertex, 0))->second;
    }
  }
  return piece;
}

ChartPiece EyeChart(TextureChart chart, int first_vertex) {
  const faces::EyeballMesh& ball = faces::EyeballTopology();
  const int rear = faces::NumEyeballVertices() - 1;
  ChartPiece piece{chart, {}, faces::EyeballUv(), {}, kEyeChartSize};
  piece.triangles.resize(Eigen::Index(ball.triangles.size()), 3);
  piece.uv_triangles = piece.triangles;
  for (size_t t = 0; t < ball.triangles.size(); ++t) {
    Eigen::RowVector3i rows = ball.triangles[t].transpose();
    piece.triangles.row(Eigen::Index(t)) = rows.array() + first_vertex;
    for (int k = 0; k < 3; ++k) {
      if (rows[k] != rear) continue;
      // Each triangle at the rear pole has a row of its own there, on the rim between its other corners.
      const Eigen::RowVector2d between =
          piece.uv.row(rows[(k + 1) % 3]) + piece.uv.row(rows[(k + 2) % 3]) - Eigen::RowVector2d::Ones();
      rows[k] = int(piece.uv.rows());
      piece.uv.conservativeResize(piece.uv.rows() + 1, 2);
      piece.uv.bottomRows(1) = 0.5 * between.normalized() + Eigen::RowVector2d::Constant(0.5);
    }
    piece.uv_triangles.row(Eigen::Index(t)) = rows;
  }
  return piece;
}

std::vector<ChartPiece> SkinCharts(const geometry::TriangleMesh& skin, const faces::Annotation& annotation) {
  const auto& landmarks = annotation.landmarks;
  if (skin.has_uv() && !HasFolds(skin)) {
    std::vector<bool> is_landmark(size_t(skin.vertices.rows()), false);
    for (const int v : landmarks) is_landmark[size_t(v)] = true;
    const auto islands = IslandsOf(skin, is_landmark);
    if (int(islands.size()) <= kMostIslands &&
        ShareBetween(islands.front(), landmarks[kRightEyeLandmark], landmarks[kLeftEyeLandmark]) >= kLeastEyeShare &&
        NumOverlappingTexels(AssembleCharts(islands), kOverlapTexels) == 0)
      return islands;
  }
  const std::vector<int> inner(landmarks.begin() + kFirstFaceLandmark, landmarks.end());
  const geometry::TriangleMesh surface{skin.vertices, skin.triangles};
  geometry::TriangleMesh flat = UnwrapHead(surface, FaceDensity(surface, skin.vertices(inner, Eigen::all)));
  geometry::RemoveUnusedUv(flat);
  return {{TextureChart::kSkin, flat.triangles, flat.uv, flat.uv_triangles, 1}};
}

TextureSpace AssembleCharts(const std::vector<ChartPiece>& pieces) {
  std::vector<AtlasPiece> shapes;
  Eigen::Index num_triangles = 0, num_rows = 0;
  for (const ChartPiece& piece : pieces) {
    shapes.push_back({piece.uv, piece.size});
    num_triangles += piece.triangles.rows();
    num_rows += piece.uv.rows();
  }
  const auto placed = LayOut(shapes, kGutter);
  TextureSpace space;
  space.triangles.resize(num_triangles, 3);
  space.uv_triangles.resize(num_triangles, 3);
  space.uv.resize(num_rows, 2);
  num_triangles = num_rows = 0;
  for (size_t i = 0; i < pieces.size(); ++i) {
    space.triangles.middleRows(num_triangles, pieces[i].triangles.rows()) = pieces[i].triangles;
    space.uv_triangles.middleRows(num_triangles, pieces[i].triangles.rows()) =
        pieces[i].uv_triangles.array() + int(num_rows);
    space.uv.middleRows(num_rows, placed[i].rows()) = placed[i];
    space.charts.insert(space.charts.end(), size_t(pieces[i].triangles.rows()), pieces[i].chart);
    num_triangles += pieces[i].triangles.rows();
    num_rows += placed[i].rows();
  }
  return space;
}

}  // namespace daumier::rig
