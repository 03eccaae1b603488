#pragma once
#include "core/options.h"
#include "fitting/curve_pull.h"
#include "fitting/projected_curves.h"
#include "geometry/operators.h"
#include "render/strokes.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <memory>
#include <span>
#include <vector>

namespace daumier::fitting {

struct StrokeDeformationOptions {
  int rounds = 10;
  double first_weight = 1e-5, last_weight = 0.1;
  double first_reach_px = 32, last_reach_px = 8;
  double max_angle = 30;

  template <class V>
  void Visit(V&& visit) {
    visit("rounds", rounds, Range{0, 100}, "How often curves are drawn to the strokes and the surface follows.");
    visit("first_weight", first_weight, Range{1e-9, 1e9},
          "Of a drawn point relative to smoothness, in the first round.");
    visit("last_weight", last_weight, Range{1e-9, 1e9}, "The same in the last round; between them it grows evenly.");
    visit("first_reach_px", first_reach_px, Range{0.1, 256},
          "From how far a curve is drawn to a stroke in the first round, pixels of the canvas.");
    visit("last_reach_px", last_reach_px, Range{0.1, 256}, "The same in the last round.");
    visit("max_angle", max_angle, Range{0, 90},
          "Greatest angle between a curve and the stroke it is drawn to, degrees.");
  }
};

/// Moves a face's surface until its curves lie on the strokes, beyond what any model of faces can say: a non-rigid
/// iterated closest point [Amberg et al. 2007] in the plane of the drawing. Depths stay unchanged, since a front view
/// does not determine them. In each round curve points are drawn to strokes without labels (PullOf), and vertices move
/// by the d (pixels of the canvas) that minimise
///   sum_i |d_i - mean of d over the neighbours of i|^2 + w sum_k t_k |d_v(k) - (s_k - p_k)|^2 + 1e-8 sum_i |d_i|^2,
/// p_k the curve points of the face that came in, s_k where they are drawn to and t_k how strongly, w from soft to
/// stiff strokes. The last term holds parts of the mesh that no curve passes. The first and last are factorised once
/// as A. With C the rows of the curves' vertices, K = C A^-1 C^T, and W and r the middle term's weights and means
/// there,
///   d = A^-1 C^T (W^-1 + K)^-1 r,
/// so that a round is a dense solve of as many unknowns as curves have vertices within reach.
class StrokeDeformer {
 public:
  /// @throws Error if the camera is in perspective.
  StrokeDeformer(const geometry::Triangles& triangles, int num_vertices, const ProjectedCurves& curves,
                 const StrokeDeformationOptions& options = {});

  /// face: 3V, cm. strokes: on the canvas, where they stay. Without a stroke within reach the face is returned
  /// unchanged.
  /// @throws Error if a number of coordinates differs.
  std::vector<float> Deform(std::span<const float> face, const std::vector<render::Stroke>& strokes) const;

 private:
  /// (W^-1 + K)^-1 r, a row a handle, 0 where none of its points is drawn.
  Eigen::MatrixX2d Forces(const CurvePull& pull, const Eigen::VectorXf& start, double weight) const;

  ProjectedCurves curves_;
  StrokeDeformationOptions options_;
  Eigen::Index num_vertices_;
  std::vector<int> handles_;                                                   ///< The curves' vertices, each once.
  std::vector<Eigen::Index> handle_of_point_;                                  ///< K, into handles_.
  std::unique_ptr<Eigen::SimplicialLDLT<geometry::SparseMatrix>> smoothness_;  ///< A
  Eigen::MatrixXd compliance_;                                                 ///< K
};

}  // namespace daumier::fitting
