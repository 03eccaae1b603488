#pragma once
#include "faces/face_model.h"
#include "geometry/deformation_transfer.h"

#include <optional>
#include <vector>

namespace daumier::faces {

/// Carries expressions of a model's template to other neutral faces of its topology by deformation transfer [Sumner and
/// Popovic 2004], so that a face that was exaggerated also smiles with its own mouth. Vertices that no expression moves
/// on the template stay where they are.
/// Expressions that move every vertex, as the modes of statistical models do, leave nothing to pin: they are added as
/// they are, which is what such a model means by them.
/// Promises: on the template itself every expression is the linear one; neutral moves nothing.
class ExpressionTransfer {
 public:
  /// Keeps the deformation gradients of every expression. @throws Error if a number of weights differs.
  ExpressionTransfer(const FaceModel& model, const std::vector<Expression>& expressions);

  /// 3V x E: the displacement of each expression on a neutral face (V x 3, cm), on up to `max_threads` cores.
  /// @throws Error if `neutral` has another number of vertices, or a triangle without area.
  Eigen::MatrixXf Offsets(const geometry::Points& neutral, unsigned max_threads = 1) const;
  /// The same of expressions that are `wanted` (E entries); the columns of others are zero.
  Eigen::MatrixXf Offsets(const geometry::Points& neutral, const std::vector<bool>& wanted,
                          unsigned max_threads = 1) const;

  int num_expressions() const { return static_cast<int>(gradients_.size()); }

  /// A neutral face that is ready for any mix of expressions: one factorisation, then one solve a mix.
  class Target {
   public:
    /// The face (V x 3, cm): neutral + sum_e weights_e offset_e, offset_e a column of Offsets. Thread-safe.
    /// @throws Error unless there is a weight of each expression.
    geometry::Points Face(const Eigen::VectorXf& weights) const;

   private:
    friend class ExpressionTransfer;
    const ExpressionTransfer* transfer_;
    geometry::Points neutral_;
    std::optional<geometry::DeformationTransfer> solver_;  ///< Absent where offsets are linear or all is pinned.
  };
  /// The transfer has to outlive it. @throws Error as Offsets.
  Target On(const geometry::Points& neutral) const;

 private:
  geometry::Triangles triangles_;
  Eigen::Index num_vertices_;
  std::vector<int> pinned_;
  Eigen::MatrixXf linear_offsets_;  ///< 3V x E where nothing can be pinned, else empty.
  std::vector<geometry::DeformationGradients> gradients_;
};

}  // namespace daumier::faces
