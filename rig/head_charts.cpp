#include "rig/head_charts.h"

#include "faces/eyeball.h"
#include "geometry/corner_uv.h"
#include "rig/atlas_layout.h"
#include "rig/head_unwrap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::rig {
namespace {

constexpr int kFirstInnerLandmark = 17;  // Behind those of the contour.

Eigen::RowVector2d OnDisc(double turns, double radius) {
  const double angle = 2 * std::numbers::pi * turns;
  return {0.5 + 0.5 * radius * std::cos(angle), 0.5 + 0.5 * radius * std::sin(angle)};
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

ChartPiece SkinChart(const geometry::TriangleMesh& skin, const faces::Annotation& annotation) {
  const std::vector<int> inner(annotation.landmarks.begin() + kFirstInnerLandmark, annotation.landmarks.end());
  geometry::TriangleMesh flat = UnwrapHead(skin, FaceDensity(skin, skin.vertices(inner, Eigen::all)));
  geometry::RemoveUnusedUv(flat);
  return {TextureChart::kSkin, flat.triangles, flat.uv, flat.uv_triangles, 1};
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
