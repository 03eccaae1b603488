#include "gltf/vrm_expressions.h"

#include "rig/arkit_names.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::gltf {
namespace {

std::vector<std::string> Arkit() {
  std::vector<std::string> names;
  for (const std::string_view name : rig::ArkitNames()) names.emplace_back(name);
  return names;
}

TEST(VrmExpressions, HaveAllPresetsAndACustomOneATarget) {
  const Json expressions = VrmExpressions({3}, Arkit());
  const std::set<std::string> expected = {"happy",   "angry",      "sad",    "relaxed",  "surprised", "aa",
                                          "ih",      "ou",         "ee",     "oh",       "blink",     "blinkLeft",
                                          "neutral", "blinkRight", "lookUp", "lookDown", "lookLeft",  "lookRight"};
  std::set<std::string> found;
  for (const auto& [name, unused] : expressions["preset"].items()) found.insert(name);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(expressions["custom"].size(), 52u);
  const Json& jaw = expressions["custom"]["JawOpen"]["morphTargetBinds"];
  EXPECT_EQ(jaw, Json::array({{{"node", 3}, {"index", 17}, {"weight", 1.0}}}));
  EXPECT_FALSE(expressions["preset"]["neutral"].contains("morphTargetBinds")) << "an empty list is not valid";
}

TEST(VrmExpressions, BindTargetsOfTheRightSide) {
  const Json expressions = VrmExpressions({0}, Arkit());
  const auto names = [&](const char* preset) {
    std::set<std::string> bound;
    for (const Json& bind : expressions["preset"][preset]["morphTargetBinds"]) {
      bound.insert(Arkit()[bind["index"].get<size_t>()]);
      EXPECT_GT(bind["weight"], 0);
      EXPECT_LE(bind["weight"], 1);
    }
    return bound;
  };
  EXPECT_EQ(names("blinkLeft"), (std::set<std::string>{"eyeBlinkLeft"}));
  EXPECT_EQ(names("blink"), (std::set<std::string>{"eyeBlinkLeft", "eyeBlinkRight"}));
  EXPECT_EQ(names("lookLeft"), (std::set<std::string>{"eyeLookOutLeft", "eyeLookInRight"}));
  EXPECT_TRUE(names("aa").contains("jawOpen"));
  EXPECT_TRUE(names("happy").contains("mouthSmileRight"));
}

TEST(VrmExpressions, LeaveOutPresetsOfTargetsThatTheHeadLacks) {
  const Json expressions = VrmExpressions({0}, {"eyeBlinkLeft"});
  EXPECT_TRUE(expressions["preset"].contains("blinkLeft"));
  EXPECT_TRUE(expressions["preset"].contains("neutral"));
  EXPECT_EQ(expressions["preset"].size(), 2u);
  EXPECT_EQ(expressions["custom"].size(), 1u);
}

}  // namespace
}  // namespace daumier::gltf
