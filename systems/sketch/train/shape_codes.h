#pragma once
#include "systems/sketch/shape_input.h"
#include "systems/sketch/train/test_set.h"

#include <map>
#include <optional>
#include <vector>

namespace daumier::sketch {

/// Curve coefficients of the sketches of a test set, each computed once: given, from labelled strokes, and recovered,
/// from drawn strokes and the face that a network without curve coefficients predicts.
class ShapeCodes {
 public:
  /// start: the predictions of that network for the test faces; absent: nothing can be recovered. Given coefficients of
  /// training and validation faces are computed too if `with_training`. Nothing is computed if neither the run's
  /// network reads coefficients nor `with_training`. `test` has to outlive it.
  ShapeCodes(const SketchTestSet& test, std::optional<StoredCoefficients> start, bool with_training);

  bool can_recover() const { return start_.has_value(); }
  /// @throws Error unless can_recover().
  const StoredCoefficients& without_shape() const;
  /// Of a face of the database. @throws Error if it was not computed.
  const faces::CurveCode& given(int face) const;
  /// Of test face number `position`. @throws Error if it was not computed.
  const faces::CurveCode& recovered(size_t position) const;
  /// The curve coefficients of the predicted faces of a block themselves, which snap to no stroke.
  std::vector<faces::CurveCode> Predicted(const FaceBlock& block) const { return Recover(block, {.snaps = 0}); }
  /// Mean distance in pixels between the points of a code and those of the sketch of a face.
  double ErrorPx(const faces::CurveCode& code, int face) const;

 private:
  std::vector<faces::CurveCode> Recover(const FaceBlock& block, const fitting::CurveRecoveryOptions& options) const;
  void EncodeGiven(bool with_training);

  const SketchTestSet& test_;
  const ShapeInput input_;
  std::optional<StoredCoefficients> start_;
  std::map<int, faces::CurveCode> given_;
  std::vector<faces::CurveCode> recovered_;
};

}  // namespace daumier::sketch
