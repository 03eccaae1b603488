#include "rig/arkit_names.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace daumier::rig {
namespace {

int Index(std::string_view name) {
  return FindArkitName(name).value();
}

TEST(ArkitNames, AreAppleInOrder) {
  EXPECT_EQ(ArkitNames()[0], "eyeBlinkLeft");
  EXPECT_EQ(ArkitNames()[17], "jawOpen");
  EXPECT_EQ(ArkitNames()[43], "browInnerUp");
  EXPECT_EQ(ArkitNames()[51], "tongueOut");
  EXPECT_EQ(std::set<std::string_view>(ArkitNames().begin(), ArkitNames().end()).size(), 52u);
}

TEST(ArkitNames, AreSpeltInThreeWays) {
  EXPECT_EQ(SpellArkitName(0, ArkitSpelling::kSides), "eyeBlink_L");
  EXPECT_EQ(SpellArkitName(0, ArkitSpelling::kPascalCase), "EyeBlinkLeft");
  EXPECT_EQ(SpellArkitName(15, ArkitSpelling::kSides), "jawLeft");
  EXPECT_EQ(SpellArkitName(22, ArkitSpelling::kSides), "mouthRight");
  EXPECT_EQ(SpellArkitName(50, ArkitSpelling::kSides), "noseSneer_R");
  EXPECT_EQ(SpellArkitName(51, ArkitSpelling::kSides), "tongueOut");
  testing::ExpectError([] { SpellArkitName(52, ArkitSpelling::kSides); }, "no ARKit name 52");
}

TEST(ArkitNames, AreFoundInEverySpellingAndCase) {
  for (int i = 0; i < kNumArkitNames; ++i) {
    for (const auto spelling : {ArkitSpelling::kCamelCase, ArkitSpelling::kSides, ArkitSpelling::kPascalCase})
      EXPECT_EQ(FindArkitName(SpellArkitName(i, spelling)), i);
  }
  EXPECT_EQ(FindArkitName("EYEBLINK_l"), 0);
  EXPECT_EQ(FindArkitName("BROWINNERUP"), 43);
  EXPECT_EQ(FindArkitName("browInnerUp_L"), std::nullopt);
  EXPECT_EQ(FindArkitName("_neutral"), std::nullopt);
}

TEST(ArkitNames, HaveTwentyPairsOfSides) {
  int num_single = 0;
  for (int i = 0; i < kNumArkitNames; ++i) {
    EXPECT_EQ(ArkitPartner(ArkitPartner(i)), i);
    num_single += ArkitPartner(i) == i;
  }
  EXPECT_EQ(num_single, 12);
  EXPECT_EQ(ArkitPartner(Index("jawLeft")), Index("jawRight"));
  EXPECT_EQ(ArkitPartner(Index("mouthLowerDownRight")), Index("mouthLowerDownLeft"));
}

TEST(ArkitNames, NameTheShapesOfIct) {
  std::set<std::string> shapes;
  for (int i = 0; i < kNumArkitNames; ++i)
    for (const std::string& shape : IctShapesOf(i)) shapes.insert(shape);
  EXPECT_EQ(shapes.size(), 53u);
  EXPECT_EQ(IctShapesOf(Index("cheekPuff")), (std::vector<std::string>{"cheekPuff_L", "cheekPuff_R"}));
  EXPECT_EQ(IctShapesOf(Index("mouthLeft")), std::vector<std::string>{"mouthLeft"});
  EXPECT_TRUE(IctShapesOf(Index("tongueOut")).empty());
}

TEST(ArkitNames, MediaPipeSortsThemByLetters) {
  const auto& order = MediaPipeOrder();
  EXPECT_EQ(order[0], Index("browDownLeft"));     // Category 1.
  EXPECT_EQ(order[8], Index("eyeBlinkLeft"));     // 9
  EXPECT_EQ(order[24], Index("jawOpen"));         // 25
  EXPECT_EQ(order[26], Index("mouthClose"));      // 27
  EXPECT_EQ(order[50], Index("noseSneerRight"));  // 51
  EXPECT_EQ(std::ranges::count(order, Index("tongueOut")), 0);
}

}  // namespace
}  // namespace daumier::rig
