#include "geometry/orientation.h"

#include "geometry/normals.h"
#include "geometry/topology.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace daumier::geometry {
namespace {

/// Outwardness below which a surface is inside out.
constexpr double kInsideOut = -0.05;
/// Share of the edges between two patches along which the surface has to be smooth.
constexpr double kSmoothShare = 0.9;
/// Share of a patch's border that these edges have to be, of the patch with the shorter border.
constexpr double kBorderShare = 0.25;

/// Two triangles at an edge that no third one has.
struct EdgePair {
  int a, b;
  bool is_alike;  ///< They run along the edge in opposite directions.
};

std::vector<EdgePair> PairsAtEdges(const Triangles& triangles) {
  struct Edge {
    int low, high, triangle;
    bool is_upwards;
  };
  std::vector<Edge> edges;
  edges.reserve(static_cast<size_t>(triangles.size()));
  for (int f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = triangles(f, k), to = triangles(f, (k + 1) % 3);
      edges.push_back({std::min(from, to), std::max(from, to), f, from < to});
    }
  }
  const auto key = [](const Edge& edge) { return std::pair(edge.low, edge.high); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& x, const Edge& y) {
    return std::pair(key(x), x.triangle) < std::pair(key(y), y.triangle);
  });
  std::vector<EdgePair> pairs;
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && key(edges[end]) == key(edges[begin])) ++end;
    const Edge &x = edges[begin], &y = edges[end - 1];
    if (end - begin == 2 && x.triangle != y.triangle)
      pairs.push_back({x.triangle, y.triangle, x.is_upwards != y.is_upwards});
  }
  return pairs;
}

/// Labels 0, 1, ... of items that links connect.
std::vector<int> Components(const std::vector<std::pair<int, int>>& links, int num_items) {
  Adjacency neighbours;
  neighbours.offsets.assign(num_items + 1, 0);
  for (const auto& [a, b] : links) {
    ++neighbours.offsets[a + 1];
    ++neighbours.offsets[b + 1];
  }
  std::partial_sum(neighbours.offsets.begin(), neighbours.offsets.end(), neighbours.offsets.begin());
  neighbours.values.resize(2 * links.size());
  std::vector<int> next(neighbours.offsets.begin(), neighbours.offsets.end() - 1);
  for (const auto& [a, b] : links) {
    neighbours.values[next[a]++] = b;
    neighbours.values[next[b]++] = a;
  }
  return ConnectedComponents(neighbours);
}

/// Parts of a surface that are wound alike, and which of them have to be turned against each other.
struct Patches {
  std::vector<int> of_triangle;
  int size = 0;
  std::vector<std::pair<int, int>> opposed;
};

Patches PatchesOf(const std::vector<EdgePair>& pairs, const Points& normals) {
  const int num_triangles = static_cast<int>(normals.rows());
  std::vector<std::pair<int, int>> alike;
  for (const EdgePair& pair : pairs) {
    if (pair.is_alike) alike.emplace_back(pair.a, pair.b);
  }
  Patches patches{Components(alike, num_triangles)};
  for (const int patch : patches.of_triangle) patches.size = std::max(patches.size, patch + 1);
  std::vector<int> border(patches.size, 0);
  for (const int patch : patches.of_triangle) border[patch] += 3;
  for (const auto& [a, b] : alike) border[patches.of_triangle[a]] -= 2;
  struct Seam {
    int num_edges = 0, num_smooth = 0;
  };
  std::map<std::pair<int, int>, Seam> seams;
  for (const EdgePair& pair : pairs) {
    const auto [low, high] = std::minmax({patches.of_triangle[pair.a], patches.of_triangle[pair.b]});
    if (pair.is_alike || low == high) continue;
    Seam& seam = seams[{low, high}];
    ++seam.num_edges;
    if (normals.row(pair.a).dot(normals.row(pair.b)) < 0) ++seam.num_smooth;
  }
  for (const auto& [key, seam] : seams) {
    if (seam.num_smooth >= kSmoothShare * seam.num_edges &&
        seam.num_smooth >= kBorderShare * std::min(border[key.first], border[key.second]))
      patches.opposed.push_back(key);
  }
  return patches;
}

/// Whether each patch is turned, so that opposed ones differ and the first of each piece is not; none of a piece where
/// that is impossible, since it is one-sided.
std::vector<bool> TurnsOf(const Patches& patches, const std::vector<int>& piece_of_patch) {
  // Two copies of every patch, unturned and turned: a patch that is connected to its own copy is one-sided.
  std::vector<std::pair<int, int>> links;
  for (const auto& [a, b] : patches.opposed) {
    links.emplace_back(a, b + patches.size);
    links.emplace_back(a + patches.size, b);
  }
  const std::vector<int> copies = Components(links, 2 * patches.size);
  std::map<int, int> first_of_piece;
  std::vector<bool> is_turned(patches.size);
  for (int p = 0; p < patches.size; ++p) {
    const int first = first_of_piece.try_emplace(piece_of_patch[p], p).first->second;
    is_turned[p] = copies[p] != copies[first];
    if (copies[p] == copies[p + patches.size]) is_turned[p] = false;
  }
  return is_turned;
}

/// Middles and area normals of triangles.
struct Facets {
  Points middles, normals;
  Eigen::VectorXd areas;
};

Facets FacetsOf(const TriangleMesh& mesh) {
  Facets facets{Points(mesh.triangles.rows(), 3), 0.5 * AreaNormals(mesh), {}};
  facets.areas = facets.normals.rowwise().norm();
  for (int f = 0; f < mesh.triangles.rows(); ++f)
    facets.middles.row(f) = mesh.vertices(mesh.triangles.row(f), Eigen::all).colwise().mean();
  return facets;
}

/// Outwardness of some triangles, of which some are turned.
double OutwardnessOf(const Facets& facets, const std::vector<int>& triangles, const std::vector<bool>& is_turned) {
  double area = 0, flux = 0, reach = 0;
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
  for (const int f : triangles) {
    area += facets.areas[f];
    centre += facets.areas[f] * facets.middles.row(f);
  }
  if (!(area > 0)) return 0;
  centre /= area;
  for (const int f : triangles) {
    const Eigen::RowVector3d arm = facets.middles.row(f) - centre;
    flux += (is_turned[f] ? -1 : 1) * arm.dot(facets.normals.row(f));
    reach += facets.areas[f] * arm.norm();
  }
  return reach > 0 ? flux / reach : 0;
}

void TurnAll(const std::vector<int>& triangles, std::vector<bool>& is_turned) {
  for (const int f : triangles) is_turned[f] = !is_turned[f];
}

}  // namespace

double Outwardness(const TriangleMesh& mesh) {
  std::vector<int> all(mesh.triangles.rows());
  std::iota(all.begin(), all.end(), 0);
  return OutwardnessOf(FacetsOf(mesh), all, std::vector<bool>(all.size(), false));
}

OrientedSurface OrientOutwards(const TriangleMesh& mesh) {
  const int num_triangles = static_cast<int>(mesh.triangles.rows());
  const Facets facets = FacetsOf(mesh);
  const std::vector<EdgePair> pairs = PairsAtEdges(mesh.triangles);
  const Patches patches = PatchesOf(pairs, facets.normals);
  const std::vector<int> piece_of_patch = Components(patches.opposed, patches.size);
  const std::vector<bool> is_patch_turned = TurnsOf(patches, piece_of_patch);

  std::vector<std::vector<int>> pieces(patches.size);
  std::vector<bool> is_turned(num_triangles);
  std::vector<int> num_neighbours(num_triangles, 0);
  const auto piece_of = [&](int f) { return piece_of_patch[patches.of_triangle[f]]; };
  for (int f = 0; f < num_triangles; ++f) {
    pieces[piece_of(f)].push_back(f);
    is_turned[f] = is_patch_turned[patches.of_triangle[f]];
  }
  for (const EdgePair& pair : pairs) {
    if (piece_of(pair.a) != piece_of(pair.b)) continue;
    ++num_neighbours[pair.a];
    ++num_neighbours[pair.b];
  }
  std::vector<int> open;
  for (const std::vector<int>& piece : pieces) {
    double area = 0;
    for (const int f : piece) area += is_turned[f] ? -facets.areas[f] : facets.areas[f];
    if (area < 0) TurnAll(piece, is_turned);
    const bool is_closed = std::all_of(piece.begin(), piece.end(), [&](int f) { return num_neighbours[f] == 3; });
    if (!is_closed) {
      open.insert(open.end(), piece.begin(), piece.end());
    } else if (OutwardnessOf(facets, piece, is_turned) < kInsideOut) {
      TurnAll(piece, is_turned);
    }
  }
  if (OutwardnessOf(facets, open, is_turned) < kInsideOut) TurnAll(open, is_turned);

  OrientedSurface result{mesh.triangles};
  for (int f = 0; f < num_triangles; ++f) {
    if (!is_turned[f]) continue;
    std::swap(result.triangles(f, 1), result.triangles(f, 2));
    ++result.num_turned;
  }
  return result;
}

}  // namespace daumier::geometry
