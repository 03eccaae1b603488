#include "gltf/triangle_runs.h"

#include <gtest/gtest.h>

namespace daumier::gltf {
namespace {

using faces::HeadMaterial;

TEST(TriangleRuns, CountEqualNeighbours) {
  const Json runs =
      TriangleRuns({HeadMaterial::kSkin, HeadMaterial::kSkin, HeadMaterial::kTooth, HeadMaterial::kSkin}, {0, 1, 3});
  EXPECT_EQ(runs.dump(), R"({"materials":[["skin",2],["tooth",1],["skin",1]],"neckCap":[[0,2],[3,1]]})");
  EXPECT_FALSE(TriangleRuns({HeadMaterial::kSkin}, {}).contains("neckCap"));
}

TEST(TriangleRuns, ParseUndoesThem) {
  const std::vector<HeadMaterial> materials = {HeadMaterial::kThroat, HeadMaterial::kSkin, HeadMaterial::kSkin};
  const auto read = ParseTriangleRuns(TriangleRuns(materials, {1, 2}), 3);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->materials, materials);
  EXPECT_EQ(read->neck_cap, (std::vector<int>{1, 2}));
}

TEST(TriangleRuns, ParseRefusesWhatDoesNotFit) {
  const auto is_read = [](const char* text, int64_t count) {
    return ParseTriangleRuns(Json::parse(text), count).has_value();
  };
  EXPECT_TRUE(is_read(R"({"materials": [["skin", 2]]})", 2));
  EXPECT_FALSE(is_read(R"({"materials": [["skin", 2]]})", 3));
  EXPECT_FALSE(is_read(R"({"materials": [["skin", 4]]})", 3));
  EXPECT_FALSE(is_read(R"({"materials": [["skin", -1], ["skin", 3]]})", 2));
  EXPECT_FALSE(is_read(R"({"materials": [["wood", 2]]})", 2));
  EXPECT_FALSE(is_read(R"({"materials": "skin"})", 2));
  EXPECT_FALSE(is_read("[]", 2));
  EXPECT_FALSE(is_read(R"({"materials": [["skin", 2]], "neckCap": [[1, 2]]})", 2));
  EXPECT_FALSE(is_read(R"({"materials": [["skin", 2]], "neckCap": [[1, 1], [0, 1]]})", 2));
}

}  // namespace
}  // namespace daumier::gltf
