#include "rig/makehuman_units.h"

#include "core/error.h"
#include "rig/arkit_names.h"
#include "rig/mouth_shares.h"

#include <algorithm>
#include <map>

namespace daumier::rig {
namespace {

enum class UnitPart { kWhole, kLeft, kUpper, kLower, kLeftUpper, kLeftLower };

struct UnitTerm {
  std::string unit;  ///< Of the left side where it has sides.
  float weight = 1;  ///< Or cm, along `direction`.
  UnitPart part = UnitPart::kWhole;
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< Zero: as the unit moves.
};

/// Of the left side and of expressions without sides; the right side takes the other side's units and parts.
const std::map<std::string, std::vector<UnitTerm>, std::less<>>& UnitTable() {
  using enum UnitPart;
  const Eigen::Vector3f left(1, 0, 0), up(0, 1, 0), front(0, 0, 1);
  static const std::map<std::string, std::vector<UnitTerm>, std::less<>> table = {
      {"eyeBlinkLeft", {{"eye-left-closure"}}},
      {"eyeLookDownLeft", {{"eye-left-closure", 0.35f}}},
      {"eyeLookUpLeft", {{"eye-left-opened-up", 0.9f}}},
      {"eyeLookInLeft", {{"eye-left-closure", -0.06f, kWhole, left}}},
      {"eyeLookOutLeft", {{"eye-left-closure", 0.06f, kWhole, left}}},
      {"eyeSquintLeft", {{"eye-left-slit", 0.7f}}},
      {"eyeWideLeft", {{"eye-left-opened-up"}}},
      {"jawForward", {{"mouth-open", 0.7f, kWhole, front}}},
      {"jawLeft", {{"mouth-open", 0.9f, kWhole, left}}},
      {"jawOpen", {{"mouth-open"}}},
      {"mouthFunnel", {{"mouth-protusion"}}},
      {"mouthPucker", {{"mouth-pursing"}}},
      {"mouthLeft", {{"mouth-pursing", 0.8f, kWhole, left}}},
      {"mouthSmileLeft", {{"mouth-corner-puller", 1, kLeft}}},
      {"mouthFrownLeft", {{"mouth-depression", 1, kLeft}}},
      {"mouthDimpleLeft", {{"mouth-retraction", 0.8f, kLeft}}},
      {"mouthStretchLeft", {{"mouth-retraction", 1, kLeft}, {"mouth-depression", 0.3f, kLeft}}},
      {"mouthRollLower", {{"mouth-compression", 0.7f, kLower}}},
      {"mouthRollUpper", {{"mouth-compression", 0.7f, kUpper}}},
      {"mouthShrugLower", {{"mouth-elevation", 1, kLower}}},
      {"mouthShrugUpper", {{"mouth-elevation", 1, kUpper}}},
      {"mouthPressLeft", {{"mouth-compression", 0.5f, kLeft}}},
      {"mouthLowerDownLeft", {{"mouth-part-later", 1, kLeftLower}}},
      {"mouthUpperUpLeft", {{"mouth-part-later", 1, kLeftUpper}}},
      {"browDownLeft", {{"eyebrows-left-down"}}},
      {"browInnerUp", {{"eyebrows-left-inner-up"}, {"eyebrows-right-inner-up"}}},
      {"browOuterUpLeft", {{"eyebrows-left-extern-up"}}},
      {"cheekSquintLeft", {{"mouth-upward-retraction", 0.3f, kLeft}}},
      {"noseSneerLeft", {{"nose-left-elevation"}}},
  };
  return table;
}

std::string OnTheRight(std::string unit) {
  const std::string left = "-left-";
  if (const auto at = unit.find(left); at != std::string::npos) unit.replace(at, left.size(), "-right-");
  return unit;
}

}  // namespace

MakeHumanUnits::MakeHumanUnits(const faces::FaceModel& model)
    : names_(model.expression_shape_names),
      units_(model.expression_shapes),
      left_(ShareOfLeftSide(model.face_template)),
      upper_(ShareOfUpperLip(model.face_template)) {
  for (int e = 0; e < kNumArkitNames; ++e) Shape(e);
}

Eigen::VectorXf MakeHumanUnits::UnitOf(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  DAUMIER_CHECK(found != names_.end(), "the source makehuman has no expression unit '{}'. Set it up with ./dev setup",
                name);
  return units_.col(found - names_.begin());
}

Eigen::VectorXf MakeHumanUnits::Shape(int index) const {
  using enum UnitPart;
  Eigen::VectorXf shape = Eigen::VectorXf::Zero(units_.rows());
  const std::string_view name = ArkitNames()[size_t(index)];
  const bool is_right = name.ends_with("Right");
  const auto row = UnitTable().find(is_right ? ArkitNames()[size_t(ArkitPartner(index))] : name);
  if (row == UnitTable().end()) return shape;
  for (const UnitTerm& term : row->second) {
    const Eigen::VectorXf unit = UnitOf(is_right ? OnTheRight(term.unit) : term.unit);
    const Eigen::VectorXf lengths =
        Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(unit.data(), left_.size(), 3)
            .rowwise()
            .norm();
    const float longest = lengths.maxCoeff();
    Eigen::Vector3f direction = term.direction;
    if (is_right) direction.x() = -direction.x();
    for (Eigen::Index v = 0; v < left_.size(); ++v) {
      float share = term.weight;
      if (term.part == kLeft || term.part == kLeftUpper || term.part == kLeftLower)
        share *= is_right ? 1 - left_[v] : left_[v];
      if (term.part == kUpper || term.part == kLeftUpper) share *= upper_[v];
      if (term.part == kLower || term.part == kLeftLower) share *= 1 - upper_[v];
      const Eigen::Vector3f move = direction.isZero() ? Eigen::Vector3f(unit.segment<3>(3 * v))
                                                      : Eigen::Vector3f(direction * (lengths[v] / longest));
      shape.segment<3>(3 * v) += share * move;
    }
  }
  return shape;
}

}  // namespace daumier::rig
