#pragma once
#include "core/random.h"
#include "datasets/build/expression_effects.h"
#include "faces/expression_transfer.h"
#include "faces/face_database.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace daumier::datasets {

/// Draws weights of expression shapes, few of them above 0, with eyes that close (both, or a wink), mouths that open,
/// smiles and brows more often than others. Which shape does what is read from its effect.
class ExpressionDrawer {
 public:
  explicit ExpressionDrawer(std::vector<ExpressionEffect> effects);
  /// E weights in [0, 1]; all 0 with a probability of 0.1. Shapes with a mirrored one are mostly drawn as pairs.
  Eigen::VectorXf Draw(Rng& rng) const;

 private:
  void Raise(Eigen::VectorXf& weights, int shape, double weight, double asymmetry, Rng& rng) const;

  std::vector<ExpressionEffect> effects_;
  std::vector<int> closers_, openers_, smilers_, brows_, others_;  ///< One of each pair.
};

/// The expressions of a database's faces: those of a source's model, carried to each face by deformation transfer, or
/// where there is no model, what the database itself holds of each person and level.
class PortraitExpressions {
 public:
  /// @throws Error if the model is of another topology than the database's template, or there are more shapes than
  /// PortraitSizes::kExpression.
  PortraitExpressions(const faces::FaceDatabase& database, const std::optional<faces::FaceModel>& model);

  const std::vector<std::string>& names() const { return names_; }
  Eigen::VectorXf Draw(Rng& rng) const { return drawer_->Draw(rng); }

  /// The face (V x 3, cm) of a person and level with weights (E) of the shapes:
  /// neutral + sum_e weights_e offset_e. Thread-safe. It refers to this object.
  using Face = std::function<geometry::Points(const Eigen::VectorXf& weights)>;
  Face FaceOf(int person, int level) const;
  /// The same on another neutral face of theirs.
  Face FaceOf(int person, int level, const geometry::Points& neutral) const;

 private:
  const faces::FaceDatabase& database_;
  std::vector<std::string> names_;
  std::unique_ptr<faces::ExpressionTransfer> transfer_;  ///< Null: the database's own expressions.
  std::optional<ExpressionDrawer> drawer_;
};

}  // namespace daumier::datasets
