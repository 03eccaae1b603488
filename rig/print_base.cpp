#include "rig/print_base.h"

#include "geometry/closed_surface.h"
#include "geometry/ear_clipping.h"
#include "geometry/level_cut.h"
#include "geometry/normals.h"
#include "geometry/submesh.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace daumier::rig {
namespace {

constexpr double kOpeningDegrees = 60, kCapDegrees = 50, kLeastCapArea = 4;  // cm^2
constexpr double kNearLowest = 0.15, kCutShare = 0.01;                       // Of the height.

double CosineOf(double degrees) {
  return std::cos(degrees * std::numbers::pi / 180);
}

geometry::TriangleMesh WithRows(const geometry::TriangleMesh& mesh, const std::vector<int>& rows) {
  geometry::TriangleMesh part{mesh.vertices, mesh.triangles(rows, Eigen::all), {}, {}};
  part.uv_triangles.resize(0, 3);
  return part;
}

/// The largest disc of connected triangles that look down, of those that reach near the lowest point; empty if that is small.
std::vector<int> CapOf(const geometry::TriangleMesh& shell) {
  const geometry::Points normals = geometry::AreaNormals(shell);
  const double low = shell.vertices.col(1).minCoeff(), high = shell.vertices.col(1).maxCoeff();
  std::vector<int> looking_down;
  for (int f = 0; f < normals.rows(); ++f)
    if (-normals(f, 1) > CosineOf(kCapDegrees) * normals.row(f).norm()) looking_down.push_back(f);
  const std::vector<int> labels = geometry::ConnectedComponents(
      geometry::VertexNeighbours(WithRows(shell, looking_down).triangles, int(shell.vertices.rows())));
  struct Patch {
    std::vector<int> rows;
    double area = 0, lowest = std::numeric_limits<double>::infinity();
  };
  std::map<int, Patch> patches;
  for (const int f : looking_down) {
    Patch& patch = patches[labels[size_t(shell.triangles(f, 0))]];
    patch.rows.push_back(f);
    patch.area -= 0.5 * normals(f, 1);
    for (const int v : shell.triangles.row(f)) patch.lowest = std::min(patch.lowest, shell.vertices(v, 1));
  }
  const Patch* best = nullptr;
  for (const auto& [label, patch] : patches)
    if (patch.lowest < low + kNearLowest * (high - low) && (best == nullptr || patch.area > best->area)) best = &patch;
  if (best == nullptr || best->area < kLeastCapArea ||
      geometry::EulerCharacteristic(WithRows(shell, best->rows).triangles) != 1)
    return {};
  return best->rows;
}

/// A loop seen from below, x to the left: counter-clockwise for one with the surface on its left and above it.
geometry::FlatPolygon SeenFromBelow(const geometry::Points& vertices, const std::vector<int>& loop) {
  geometry::FlatPolygon polygon(std::ssize(loop), 2);
  for (size_t i = 0; i < loop.size(); ++i) {  // A loop walks against the winding of what closes it.
    const int v = loop[loop.size() - 1 - i];
    polygon.row(Eigen::Index(i)) << vertices(v, 0), vertices(v, 2);
  }
  return polygon;
}

bool IsExtendable(const geometry::TriangleMesh& shell, const std::vector<int>& loop) {
  const geometry::FlatPolygon polygon = SeenFromBelow(shell.vertices, loop);
  return geometry::IsSimple(polygon) && geometry::SignedArea(polygon) > 0;
}

/// A wall from a loop down to `level`, and the base; no wall if the loop is there.
void CloseFlat(const std::vector<int>& loop, std::optional<double> level, geometry::TriangleMesh& shell) {
  const geometry::Triangles base = geometry::ClipEars(SeenFromBelow(shell.vertices, loop));
  const auto n = int(loop.size());
  const Eigen::Index first = shell.triangles.rows();
  const auto first_vertex = int(shell.vertices.rows());
  shell.triangles.conservativeResize(first + base.rows() + (level ? 2 * n : 0), Eigen::NoChange);
  if (level) {
    const geometry::Points at_loop = shell.vertices(loop, Eigen::all);
    shell.vertices.conservativeResize(first_vertex + n, Eigen::NoChange);
    shell.vertices.bottomRows(n) = at_loop;
    shell.vertices.bottomRows(n).col(1).setConstant(*level);
    for (int i = 0; i < n; ++i) {
      const int a = loop[size_t(i)], b = loop[size_t((i + 1) % n)], low_a = first_vertex + i,
                low_b = first_vertex + (i + 1) % n;
      shell.triangles.row(first + base.rows() + 2 * i) << b, a, low_a;
      shell.triangles.row(first + base.rows() + 2 * i + 1) << b, low_a, low_b;
    }
  }
  const auto vertex = [&](int corner) {
    const int i = n - 1 - corner;
    return level ? first_vertex + i : loop[size_t(i)];
  };
  shell.triangles.middleRows(first, base.rows()) = base.unaryExpr(vertex);
}

void RemoveUnused(geometry::TriangleMesh& mesh) {
  const std::vector<int> used(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
  mesh = geometry::Submesh(mesh, geometry::MapKept(used, int(mesh.vertices.rows())));
}

void CutLowest(geometry::TriangleMesh& shell) {
  const double low = shell.vertices.col(1).minCoeff(), high = shell.vertices.col(1).maxCoeff();
  const double level = low + kCutShare * (high - low);
  const geometry::LevelCut cut = geometry::CutPositive(shell, level - shell.vertices.col(1).array());
  shell.vertices = geometry::WithEdgePoints(shell.vertices, cut.points);
  shell.vertices.col(1).tail(std::ssize(cut.points)).setConstant(level);  // Shares of edges are limited.
  shell.triangles = cut.triangles;
  RemoveUnused(shell);
  for (const std::vector<int>& loop : geometry::BoundaryLoops(shell.triangles, int(shell.vertices.rows()))) {
    if (IsExtendable(shell, loop)) {
      CloseFlat(loop, std::nullopt, shell);
    } else {
      geometry::FillHole(loop, shell);
    }
  }
}

}  // namespace

std::optional<size_t> OpeningTowards(const geometry::TriangleMesh& shell, const std::vector<std::vector<int>>& loops,
                                     const geometry::Vector3& down) {
  std::optional<size_t> longest;
  double length = 0;
  for (size_t i = 0; i < loops.size(); ++i) {
    double of_loop = 0;
    for (size_t j = 0; j < loops[i].size(); ++j)
      of_loop += (shell.vertices.row(loops[i][j]) - shell.vertices.row(loops[i][(j + 1) % loops[i].size()])).norm();
    if (of_loop > length) length = of_loop, longest = i;
  }
  if (!longest) return std::nullopt;
  const geometry::Points points = shell.vertices(loops[*longest], Eigen::all);
  const geometry::Vector3 centre = points.colwise().mean();
  geometry::Vector3 area = geometry::Vector3::Zero();
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const geometry::Vector3 a = points.row(i).transpose() - centre,
                            b = points.row((i + 1) % points.rows()).transpose() - centre;
    area += b.cross(a);
  }
  if (area.dot(down) <= CosineOf(kOpeningDegrees) * area.norm()) return std::nullopt;
  return longest;
}

PrintBase AddFlatBase(const std::vector<int>& opening, double level, geometry::TriangleMesh& shell) {
  if (!opening.empty() && IsExtendable(shell, opening)) {
    CloseFlat(opening, level, shell);
    return PrintBase::kOpening;
  }
  if (!opening.empty()) geometry::FillHole(opening, shell);
  const std::vector<int> cap = CapOf(shell);
  if (!cap.empty()) {
    std::vector<bool> is_cap(size_t(shell.triangles.rows()), false);
    for (const int f : cap) is_cap[size_t(f)] = true;
    std::vector<int> rest;
    for (int f = 0; f < shell.triangles.rows(); ++f)
      if (!is_cap[size_t(f)]) rest.push_back(f);
    geometry::TriangleMesh open = geometry::CutToManifold(WithRows(shell, rest)).mesh;
    const std::vector<std::vector<int>> loops = geometry::BoundaryLoops(open.triangles, int(open.vertices.rows()));
    if (loops.size() == 1 && IsExtendable(open, loops[0])) {
      CloseFlat(loops[0], level, open);
      shell = std::move(open);
      return PrintBase::kCap;
    }
  }
  CutLowest(shell);
  return PrintBase::kCut;
}

}  // namespace daumier::rig
