#pragma once
#include "core/options.h"
#include "geometry/operators.h"
#include "geometry/topology.h"

#include <vector>

namespace daumier::geometry {

struct DetailOptions {
  double edges = 0.005;
  double thickness = 0.1;
  double max_thickness = 1.0;
  double max_scale = 3.0;

  template <class V>
  void Visit(V&& visit) {
    visit("edges", edges, Range{0.0, 1e3}, "Weight of an edge; the Laplacian detail of a vertex weighs 1.");
    visit("thickness", thickness, Range{0.0, 1e3},
          "Weight of a tie, which joins a vertex through the body to the surface behind it, so that lips, lids and "
          "ears keep their thickness.");
    visit("max_thickness", max_thickness, Range{0.0, 1e3}, "Length of the longest tie, cm.");
    visit("max_scale", max_scale, Range{1.0, 1e3},
          "Largest factor by which a region may grow or shrink without resistance.");
  }
};

/// How much a surface x' has lost of the shape of a mesh x, beyond turning and scaling each place of it:
///   E(x') = sum_i |T_i d_i - d'_i|^2 + w_e sum over edges ij |T_ij (x_i - x_j) - (x'_i - x'_j)|^2
///           + w_t the same sum over ties ij,
/// d_i = x_i minus the mean of its neighbours, T_i the similarity (scale within [1 / max_scale, max_scale]) that fits
/// best how the places around i have moved, over two rings and the ties, T_ij = (T_i + T_j) / 2. The details bend the
/// surface smoothly [Sorkine et al. 2004, with T_i fitted to the last x' as in Sorkine and Alexa 2007], the edges keep
/// cavities from bulging, and a tie joins a vertex to the nearest one that it sees through the inside of the body, so
/// that lids, lips, ears and the wings of the nose keep a thickness and what lies behind them does not come through.
/// With T held, E is quadratic with the matrix() (V x V for each axis), least where matrix() x' = Pull(x').
class DetailEnergy {
 public:
  /// @throws Error if a vertex has no triangle, or all of its neighbours lie in one point with it.
  DetailEnergy(const TriangleMesh& mesh, const DetailOptions& options);

  const SparseMatrix& matrix() const { return matrix_; }
  /// V x 3: the right-hand side, with the T_i of `now`. If `now` is x moved by one similarity, matrix() now ==
  /// Pull(now).
  Points Pull(const Points& now) const;

  /// Pairs of vertices i < j, ascending.
  struct Tie {
    int first, second;
    auto operator<=>(const Tie&) const = default;
  };
  const std::vector<Tie>& ties() const { return ties_; }

 private:
  std::vector<Eigen::Matrix3d> Similarities(const Points& now) const;

  DetailOptions options_;
  Points rest_, details_;
  Adjacency neighbours_;
  std::vector<Tie> ties_;
  SparseMatrix laplacian_, matrix_;
};

}  // namespace daumier::geometry
