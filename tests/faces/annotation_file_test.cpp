#include "faces/annotation_file.h"

#include "core/json.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace daumier::faces {
namespace {

using testing::ExpectError;

Json SmallAnnotation() {
  return {{"format", 1},
          {"source", "small"},
          {"landmarks", std::vector<int>(68, 7)},
          {"hairline", 3},
          {"crop",
           {{"seed", 5},
            {"cuts", {{{"name", "neck"}, {"waypoints", {1, 2, 3}}}, {{"name", "other"}, {"mirror_of", "neck"}}}}}},
          {"regions", {{"face", {{"range", {0, 9}}}}, {"nose", {{"loop", {1, 2, 3}}, {"seed", 4}}}}},
          {"curves",
           {{{"name", "brow_left"},
             {"kind", "brow"},
             {"view", "side"},
             {"closed", true},
             {"waypoints", {4, 5, 6}},
             {"mirror", true}}}}};
}

void ExpectRefused(const std::function<void(Json&)>& spoil, const std::string& part) {
  Json json = SmallAnnotation();
  spoil(json);
  ExpectError([&] { ParseAnnotationFile(json.dump(), "small.json"); }, part);
}

TEST(AnnotationFile, EveryEntryIsRead) {
  const AnnotationFile file = ParseAnnotationFile(SmallAnnotation().dump(), "small.json");
  EXPECT_EQ(file.landmarks[67], 7);
  EXPECT_EQ(file.hairline, 3);
  EXPECT_EQ(file.crop_seed, 5);
  ASSERT_EQ(file.cuts.size(), 2u);
  EXPECT_EQ(file.cuts[0].waypoints, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(file.cuts[1].mirror_of, "neck");
  ASSERT_EQ(file.regions.size(), 2u);
  EXPECT_EQ(file.regions[0].range->second, 9);
  EXPECT_EQ(file.regions[1].seed, 4);
  ASSERT_EQ(file.curves.size(), 1u);
  EXPECT_EQ(file.curves[0].curve.view, View::kSide);
  EXPECT_TRUE(file.curves[0].curve.closed && file.curves[0].mirror);
}

TEST(AnnotationFile, FaultsAreRefusedByFileAndKey) {
  ExpectError([] { ParseAnnotationFile("{ no json", "small.json"); }, "small.json");
  ExpectRefused([](Json& json) { json["format"] = 2; }, "small.json: format 2 is not known");
  ExpectRefused([](Json& json) { json.erase("hairline"); }, "'hairline' is missing");
  ExpectRefused([](Json& json) { json["hair"] = 1; }, "unknown key 'hair'");
  ExpectRefused([](Json& json) { json["landmarks"].erase(0); }, "67 landmarks, expected 68");
  ExpectRefused([](Json& json) { json["hairline"] = "top"; }, "'hairline' has the wrong type");
  ExpectRefused([](Json& json) { json["curves"][0]["kind"] = "beard"; },
                "unknown kind 'beard', expected one of silhouette");
  ExpectRefused([](Json& json) { json["curves"][0]["view"] = "back"; }, "view 'back'");
  ExpectRefused([](Json& json) { json["regions"]["nose"].erase("seed"); }, "region nose");
  ExpectRefused([](Json& json) { json["regions"]["face"]["range"] = {9, 0}; }, "range [9, 0] is empty");
  ExpectRefused([](Json& json) { json["cm_per_unit"] = -1; }, "'cm_per_unit' is -1");
}

TEST(AnnotationFile, LandmarksAndHairlineAreEnough) {
  const Json json = {{"format", 1}, {"landmarks", std::vector<int>(68, 7)}, {"hairline", 3}};
  const AnnotationFile file = ParseAnnotationFile(json.dump(), "least.json");
  EXPECT_FALSE(file.crop_seed.has_value() || file.cm_per_unit.has_value());
  EXPECT_TRUE(file.cuts.empty() && file.regions.empty() && file.curves.empty());
}

TEST(AnnotationFile, RegionsMayBeListsAndUnitsSpecified) {
  Json json = SmallAnnotation();
  json["cm_per_unit"] = 2.5;
  json["regions"]["eyes"] = {{"vertices", {4, 2}}};
  const AnnotationFile file = ParseAnnotationFile(json.dump(), "small.json");
  EXPECT_EQ(file.cm_per_unit, 2.5);
  EXPECT_EQ(file.regions.back().vertices, (std::vector<int>{4, 2}));
}

TEST(ExpressionFile, FirstIsNeutralAndNamesAreUnique) {
  const auto text = [](const std::string& expressions) {
    return R"({"format": 1, "source": "small", "expressions": [)" + expressions + "]}";
  };
  const std::string neutral = R"({"name": "neutral", "weights": {}})",
                    smile = R"({"name": "smile", "weights": {"up": 0.5}})";
  const auto recipes = ParseExpressionFile(text(neutral + "," + smile), "e.json");
  ASSERT_EQ(recipes.size(), 2u);
  EXPECT_EQ(recipes[1].weights, (std::vector<std::pair<std::string, float>>{{"up", 0.5f}}));
  ExpectError([&] { ParseExpressionFile(text(smile), "e.json"); }, "neutral");
  ExpectError([&] { ParseExpressionFile(text(neutral + "," + smile + "," + smile), "e.json"); }, "comes twice");
  ExpectError([&] { ParseExpressionFile(text(neutral + R"(,{"name": "a", "weights": {"up": "x"}})"), "e.json"); },
              "no number");
}

TEST(EmbeddedAnnotation, BothSourcesAreCompiledIn) {
  for (const std::string source : {"makehuman", "ict"}) {
    const AnnotationFile file = ParseAnnotationFile(EmbeddedAnnotation(source), source);
    std::set<std::string> frontal;
    for (const CurveRule& rule : file.curves) {
      if (rule.curve.view == View::kFrontal) frontal.insert(rule.curve.kind);
    }
    for (const std::string& kind : CurveKinds())
      EXPECT_EQ(frontal.count(kind), kind == "side_silhouette" ? 0u : 1u) << source << " " << kind;
    EXPECT_EQ(ParseExpressionFile(EmbeddedAnnotation(source + "_expressions"), source).size(), 25u);
  }
  ExpectError([] { EmbeddedAnnotation("nobody"); }, "without the annotation nobody");
}

}  // namespace
}  // namespace daumier::faces
