#pragma once
#include "faces/face_model.h"
#include "geometry/normals.h"
#include "geometry/path.h"
#include "geometry/topology.h"
#include "geometry/triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

/// A small face that is known exactly: an ellipsoid with nose, chin, brow ridge and ears, holes at eyes, mouth and
/// neck, and a full annotation. Exactly symmetric, the same on every call; SyntheticFace() has some 950 vertices.
namespace daumier::testing {

/// The grid of the synthetic head: columns i = -17 .. 18 run around it from its right (x < 0) over the front (0) to the
/// back (18), rows j = 0 .. 26 from the neck to the crown, which a last vertex closes.
class SyntheticGrid {
 public:
  static constexpr int kHalf = 18, kRows = 27;

  SyntheticGrid() {
    std::vector<geometry::Vector3> points;
    for (int j = 0; j < kRows; ++j) {
      for (int i = 1 - kHalf; i <= kHalf; ++i) {
        vertex_[Column(i)][j] = -1;
        if (IsHole(i, j)) continue;
        vertex_[Column(i)][j] = static_cast<int>(points.size());
        points.push_back(Position(i, j));
      }
    }
    crown_ = static_cast<int>(points.size());
    points.emplace_back(0, kHeight, 0);
    mesh_.vertices.resize(crown_ + 1, 3);
    for (int v = 0; v <= crown_; ++v) mesh_.vertices.row(v) = points[v];
    AddPolygons();
  }

  /// The vertex of column i, row j; -1 inside a hole.
  int at(int i, int j) const { return vertex_[Column(i)][j]; }
  const geometry::PolygonMesh& mesh() const { return mesh_; }

  /// Mirror map of the grid.
  std::vector<int> Mirror() const {
    std::vector<int> mirror(mesh_.vertices.rows());
    for (int j = 0; j < kRows; ++j) {
      for (int i = 1 - kHalf; i <= kHalf; ++i) {
        if (at(i, j) >= 0) mirror[at(i, j)] = at(i == kHalf ? i : -i, j);
      }
    }
    mirror[crown_] = crown_;
    return mirror;
  }

  /// Vertices with low_i <= |i| <= high_i and low_j <= j <= high_j, ascending.
  std::vector<int> Block(int low_i, int high_i, int low_j, int high_j) const {
    std::vector<int> block;
    for (int j = low_j; j <= high_j; ++j) {
      for (int i = 1 - kHalf; i <= kHalf; ++i) {
        if (std::abs(i) >= low_i && std::abs(i) <= high_i && at(i, j) >= 0) block.push_back(at(i, j));
      }
    }
    std::sort(block.begin(), block.end());
    return block;
  }

 private:
  static constexpr double kWidth = 7.5, kHeight = 11.0, kDepth = 9.0;  // Half axes, cm.

  static int Column(int i) { return i + kHalf - 1; }
  static bool IsHole(int i, int j) {
    return (j == 12 && std::abs(i) >= 4 && std::abs(i) <= 6) || (j == 6 && std::abs(i) <= 2);
  }

  /// Turns the box of a hole (centre, half extents in cells) into an ellipse that is `openness` times as high, fading
  /// out at twice its size.
  static void RoundHole(double centre_i, double centre_j, double half_i, double half_j, double openness, double& i,
                        double& j) {
    const double u = (i - centre_i) / half_i, v = (j - centre_j) / half_j, box = std::max(std::abs(u), std::abs(v));
    if (box == 0 || box >= 2) return;
    const double blend = box <= 1 ? 1.0 : 2.0 - box;
    const double shrink = 1 + blend * (box / std::hypot(u, v) - 1);
    i = centre_i + shrink * u * half_i;
    j = centre_j + shrink * (1 - blend * (1 - openness)) * v * half_j;
  }

  static double Bump(double longitude, double latitude, double at_longitude, double at_latitude, double wide,
                     double high) {
    return std::exp(-0.5 *
                    (std::pow((longitude - at_longitude) / wide, 2) + std::pow((latitude - at_latitude) / high, 2)));
  }

  static geometry::Vector3 Position(int column, int row) {
    double i = std::abs(column), j = row;
    RoundHole(5, 12, 2, 1, 0.8, i, j);
    RoundHole(0, 6, 3, 1, 0.4, i, j);
    const double share = i / kHalf;
    const double longitude = 180 * share * (0.55 + 0.45 * share * share);  // Degrees; denser in front.
    const double latitude = -52 + j * 134 / kRows;
    const double a = longitude * std::numbers::pi / 180, b = latitude * std::numbers::pi / 180;
    geometry::Vector3 p(kWidth * std::sin(a) * std::cos(b), kHeight * std::sin(b), kDepth * std::cos(a) * std::cos(b));
    p.z() += 2.2 * Bump(longitude, latitude, 0, -5, 8, 9) + 0.8 * Bump(longitude, latitude, 0, -42, 15, 8);
    p.z() += 0.4 * Bump(longitude, latitude, 25, 20, 15, 6);
    p.x() += 1.4 * Bump(longitude, latitude, 95, 5, 9, 12);
    if (column == 0 || column == kHalf) p.x() = 0;
    if (column < 0) p.x() = -p.x();
    return p;
  }

  void AddPolygon(std::initializer_list<int> corners) {
    if (std::min(corners) < 0) return;
    mesh_.corners.insert(mesh_.corners.end(), corners);
    mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
  }

  void AddPolygons() {
    for (int i = 1 - kHalf; i <= kHalf; ++i) {
      const int next = i == kHalf ? 1 - kHalf : i + 1;
      for (int j = 0; j + 1 < kRows; ++j) AddPolygon({at(i, j), at(next, j), at(next, j + 1), at(i, j + 1)});
      AddPolygon({at(i, kRows - 1), at(next, kRows - 1), crown_});
    }
  }

  geometry::PolygonMesh mesh_;
  int vertex_[2 * kHalf][kRows] = {};
  int crown_ = 0;
};

/// The annotation of the synthetic face.
class SyntheticAnnotation {
 public:
  SyntheticAnnotation(const SyntheticGrid& grid, const geometry::Triangles& triangles)
      : grid_(grid), neighbours_(geometry::VertexNeighbours(triangles, static_cast<int>(grid.mesh().vertices.rows()))) {
    annotation_.mirror = grid.Mirror();
    annotation_.hairline_vertex = grid.at(0, 21);
    SetLandmarks();
    AddCurves();
    SetRegions();
  }

  const faces::Annotation& get() const { return annotation_; }

 private:
  using Cells = std::vector<std::pair<int, int>>;

  void SetLandmarks() {
    // Landmarks on the face's right (x < 0) or its middle, and the one on the other side.
    struct Entry {
      int right, left, i, j;
    };
    static const Entry kEntries[] = {
        {0, 16, 11, 12}, {1, 15, 11, 10}, {2, 14, 10, 8},  {3, 13, 9, 6},   {4, 12, 8, 5},   {5, 11, 6, 4},
        {6, 10, 4, 3},   {7, 9, 2, 2},    {8, 8, 0, 2},    {17, 26, 7, 15}, {18, 25, 6, 15}, {19, 24, 5, 15},
        {20, 23, 4, 15}, {21, 22, 3, 15}, {27, 27, 0, 13}, {28, 28, 0, 12}, {29, 29, 0, 11}, {30, 30, 0, 10},
        {31, 35, 2, 9},  {32, 34, 1, 9},  {33, 33, 0, 9},  {36, 45, 7, 12}, {37, 44, 6, 13}, {38, 43, 4, 13},
        {39, 42, 3, 12}, {40, 47, 4, 11}, {41, 46, 6, 11}, {48, 54, 4, 6},  {49, 53, 3, 8},  {50, 52, 1, 8},
        {51, 51, 0, 8},  {59, 55, 3, 4},  {58, 56, 1, 4},  {57, 57, 0, 4},  {60, 64, 3, 6},  {61, 63, 1, 7},
        {62, 62, 0, 7},  {67, 65, 1, 5},  {66, 66, 0, 5}};
    for (const Entry& entry : kEntries) {
      annotation_.landmarks[entry.right] = grid_.at(-entry.i, entry.j);
      annotation_.landmarks[entry.left] = grid_.at(entry.i, entry.j);
    }
  }

  std::vector<int> Trace(const Cells& cells) const {
    std::vector<int> waypoints;
    for (const auto& [i, j] : cells) waypoints.push_back(grid_.at(i, j));
    return geometry::TracePath(grid_.mesh().vertices, neighbours_, waypoints, geometry::PathEnds::kOpen);
  }
  std::vector<int> MirrorOf(std::vector<int> path) const {
    for (int& v : path) v = annotation_.mirror[v];
    return path;
  }
  void Add(const std::string& name, const std::string& kind, bool closed, std::vector<int> path,
           faces::View view = faces::View::kFrontal) {
    annotation_.curves.push_back({name, kind, view, closed, std::move(path)});
  }
  /// A curve on each side; `cells` specify the left one.
  void AddPair(const std::string& name, const std::string& kind, const Cells& cells) {
    Add(name + "_left", kind, false, Trace(cells));
    Add(name + "_right", kind, false, MirrorOf(Trace(cells)));
  }
  /// A symmetric curve whose left half runs from the middle to the middle (closed) or ends aside (open).
  void AddSymmetric(const std::string& name, const std::string& kind, bool closed, const Cells& left_half) {
    std::vector<int> path = Trace(left_half);
    std::vector<int> other = MirrorOf(path);
    if (closed) {
      std::reverse(other.begin(), other.end());
      path.insert(path.end(), other.begin() + 1, other.end() - 1);
    } else {
      std::reverse(path.begin(), path.end());
      path.insert(path.end(), other.begin() + 1, other.end());
    }
    Add(name, kind, closed, std::move(path));
  }

  void AddCurves() {
    AddSymmetric(
        "silhouette", "silhouette", true,
        {{0, 2}, {2, 2}, {4, 3}, {6, 4}, {8, 5}, {9, 6}, {10, 8}, {11, 10}, {11, 16}, {9, 19}, {5, 20}, {0, 21}});
    AddPair("brow", "brow", {{3, 15}, {7, 15}});
    AddPair("upper_eye", "upper_eye", {{3, 12}, {3, 13}, {5, 13}, {7, 13}, {7, 12}});
    AddPair("lower_eye", "lower_eye", {{3, 12}, {3, 11}, {5, 11}, {7, 11}, {7, 12}});
    AddSymmetric("upper_mouth", "upper_mouth", false, {{0, 7}, {3, 7}, {3, 6}});
    AddSymmetric("lower_mouth", "lower_mouth", false, {{0, 5}, {3, 5}, {3, 6}});
    AddSymmetric("lips", "lips", true, {{0, 4}, {3, 4}, {4, 6}, {3, 8}, {0, 8}});
    AddPair("ear", "ear", {{12, 9}, {13, 12}, {12, 15}});
    AddSymmetric("nose", "nose", false, {{0, 9}, {2, 9}, {2, 10}});
    Add("profile_lower", "side_silhouette", false, Trace({{0, 0}, {0, 5}}), faces::View::kSide);
    Add("profile_upper", "side_silhouette", false, Trace({{0, 7}, {0, 21}}), faces::View::kSide);
  }

  void SetRegions() {
    auto& regions = annotation_.regions;
    const auto with_rings = [&](const std::vector<int>& seeds, int rings) {
      return geometry::VerticesWithin(neighbours_, seeds, rings);
    };
    regions["face"] = grid_.Block(0, 11, 2, 21);
    regions["eyes"] = with_rings(grid_.Block(3, 7, 11, 13), 2);
    regions["mouth"] = with_rings(grid_.Block(0, 3, 5, 7), 2);
    regions["neck_border"] = grid_.Block(0, SyntheticGrid::kHalf, 0, 0);
    regions["ears"] = grid_.Block(11, 14, 8, 16);
    regions["nose"] = grid_.Block(0, 2, 9, 13);
  }

  const SyntheticGrid& grid_;
  geometry::Adjacency neighbours_;
  faces::Annotation annotation_;
};

inline faces::FaceTemplate SyntheticFace() {
  const SyntheticGrid grid;
  faces::FaceTemplate face;
  face.source = "synthetic";
  face.provenance = {{"name", "synthetic"}, {"version", "1"}, {"checksum", ""}, {"licence", "Apache-2.0"}};
  face.neutral = grid.mesh().vertices;
  face.triangles = geometry::Triangulate(grid.mesh(), grid.Mirror());
  face.annotation = SyntheticAnnotation(grid, face.triangles).get();

  // Loops by length: neck, mouth, right eye, left eye. A loop has the surface on its left, so a fan along it is wound
  // the other way.
  const auto loops = geometry::BoundaryLoops(face.triangles, face.num_vertices());
  std::vector<std::array<int, 3>> closing;
  for (const int l : {2, 3, 1}) {
    for (size_t k = 1; k + 1 < loops[l].size(); ++k) closing.push_back({loops[l][0], loops[l][k + 1], loops[l][k]});
    if (l == 3) face.num_eye_closing_triangles = static_cast<int>(closing.size());
  }
  face.closing_triangles.resize(static_cast<int>(closing.size()), 3);
  for (size_t t = 0; t < closing.size(); ++t)
    face.closing_triangles.row(t) << closing[t][0], closing[t][1], closing[t][2];
  return face;
}

}  // namespace daumier::testing
