#pragma once

#include "faces/face_model.h"

namespace daumier::rig {

/// ARKit's expressions from MakeHuman's expression units, which are fewer: most of the mouth move both sides and both
/// lips at once, and none moves a jaw sideways or forward or puffs a cheek.
/// A unit is taken whole, or its left or right part (a smooth step over x, as wide as 1.2 mouths), or the part of the
/// upper or the lower lip and its surroundings (a harmonic function between the contours of the lips, made steeper);
/// such parts add up to the unit. Or its vertices move along one direction, by their share of the unit's largest
/// displacement: so a jaw that opens also moves sideways.
class MakeHumanUnits {
 public:
  MakeHumanUnits() = default;
  /// @throws Error if `model` lacks a unit of the table, or as faces::FindLipContours.
  explicit MakeHumanUnits(const faces::FaceModel& model);

  /// 3V: the displacement of expression `index` of ArkitNames(), cm; zero where no unit gives it.
  Eigen::VectorXf Shape(int index) const;

 private:
  Eigen::VectorXf UnitOf(const std::string& name) const;

  std::vector<std::string> names_;
  Eigen::MatrixXf units_;
  Eigen::VectorXf left_;   ///< V: the share of the left side, +x.
  Eigen::VectorXf upper_;  ///< V: the share of the upper lip.
};

}  // namespace daumier::rig
