#pragma once
#include "rig/arkit_names.h"
#include "rig/expression_map.h"

namespace daumier::testing {

/// Two signed expressions, `a` and `b`, and a constant one, `mean`: a opens the jaw by 1/2 or puckers by 1/4, b blinks and
/// squints with the left eye, mean opens the jaw by 1/8.
inline rig::ExpressionMap SmallExpressionMap() {
  const auto at = [](const char* name) { return *rig::FindArkitName(name); };
  rig::ExpressionMap map;
  map.expressions = {"a", "b", "mean"};
  map.kind = rig::CoefficientKind::kSigned;
  map.constant = 2;
  map.positive = map.negative = Eigen::MatrixXf::Zero(3, rig::kNumArkitNames);
  map.positive(0, at("jawOpen")) = 0.5f;
  map.negative(0, at("mouthPucker")) = 0.25f;
  map.positive(1, at("eyeBlinkLeft")) = 1;
  map.positive(1, at("eyeSquintLeft")) = 1;
  map.positive(2, at("jawOpen")) = 0.125f;
  for (const bool is_negative : {false, true})
    for (const std::string& name : map.expressions) map.mapped.push_back({name, is_negative, {}, {}});
  map.mapped[0].error = {0.06, 0.2};  // Of 0.1: explained 0.64.
  map.mapped[0].no_motion = {0.1, 0.5};
  map.mapped[0].gain = 1.5;
  map.model = {{"name", "Small"}, {"version", "1"}, {"checksum", ""}, {"licence", "mine"}};
  map.targets = {{"name", "ICT"}, {"version", "light"}, {"checksum", ""}, {"licence", "MIT"}};
  return map;
}

}  // namespace daumier::testing
