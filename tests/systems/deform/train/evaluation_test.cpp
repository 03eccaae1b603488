#include "systems/deform/train/evaluation.h"

#include "core/even_choice.h"
#include "eval/metrics.h"
#include "datasets/read/run_data.h"
#include "tests/systems/deform/train/run_fixture.h"
#include "tests/support/expect_error.h"

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

class DeformEvalTest : public DeformRunFixture {
 protected:
  /// Few faces, few steps.
  static DeformEvalOptions Quick() { return {.max_faces = 3, .adam_faces = 2, .adam_steps = 2}; }
};

TEST_F(DeformEvalTest, WritesTheKeysThatAreAgreedOnAndAReport) {
  const fs::path out = *folder_ / "report";
  const Json metrics = EvaluateDeformRun(*folder_ / "run", out, Quick());
  EXPECT_EQ(Json::parse(ReadFile(out / "metrics.json")), metrics);
  for (const char* key : {"mean_vertex_error", "surface_sample_error", "mean_vertex_error_mm", "percent_of_head_height",
                          "p95_vertex_error", "normal_error_degrees", "seconds"})
    EXPECT_GT(metrics.at(key).get<double>(), 0) << key;
  EXPECT_EQ(metrics.at("num_faces"), 3);
  EXPECT_EQ(metrics.at("unit"), "model units");
  EXPECT_EQ(metrics.at("split"), "test");
  EXPECT_NEAR(metrics.at("percent_of_head_height").get<double>(),
              metrics.at("mean_vertex_error").get<double>() / 2.1 * 100, 1e-9);
  EXPECT_LE(metrics.at("interval")[0], metrics.at("mean_vertex_error"));
  EXPECT_NEAR(eval::Mean(metrics.at("face_errors").get<std::vector<double>>()), metrics.at("mean_vertex_error").get<double>(),
              1e-9);
  EXPECT_EQ(metrics.at("groups").size(), 3u);
  std::vector<std::string> names;
  for (const Json& row : metrics.at("table")) names.push_back(row.at("name"));
  EXPECT_EQ(names,
            (std::vector<std::string>{"network", "network, first faces by Gauss-Newton", "network, first faces by Adam",
                                      "template", "mean face", "nearest training face", "linear model"}));
  for (const char* file : {"sheet.png", "mean_error.png", "errors.svg", "index.html", "table.md"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  VerifyChecksums(out, ReadManifest(out, "report"));
}

TEST_F(DeformEvalTest, FacesAreSpreadEvenlyOverTheSide) {
  const Json metrics = EvaluateDeformRun(*folder_ / "run", *folder_ / "spread",
                                         {.split = "validation", .max_faces = 3, .adam_faces = 0, .baselines = false});
  const faces::FaceDatabase faces(*folder_ / "faces");
  const datasets::Split split = datasets::SplitOfRun(*folder_ / "run", ReadManifest(*folder_ / "run", "run"),
                                           LoadConfig(*folder_ / "run" / "resolved.toml"), faces);
  EXPECT_EQ(metrics.at("faces").get<std::vector<int>>(), EvenChoice(split.validation, 3));
  EXPECT_EQ(metrics.at("table").size(), 1u);
  EXPECT_TRUE(metrics.at("ridge").is_null());
}

TEST_F(DeformEvalTest, EqualRunsGiveEqualErrors) {
  const auto errors = [&](const char* out) {
    return EvaluateDeformRun(*folder_ / "run", *folder_ / out, {.max_faces = 2, .adam_faces = 0, .baselines = false})
        .at("face_errors");
  };
  EXPECT_EQ(errors("once"), errors("twice"));
}

TEST_F(DeformEvalTest, OtherFacesAreAllMeasuredAndNamed) {
  testing::BuildSyntheticFaces(*folder_ / "two", 1);
  DeformEvalOptions options{.faces = (*folder_ / "two").string(), .max_faces = 1, .adam_faces = 0, .baselines = false};
  const Json metrics = EvaluateDeformRun(*folder_ / "run", *folder_ / "other", options);
  EXPECT_EQ(metrics.at("num_faces"), faces::FaceDatabase(*folder_ / "two").num_faces());
  EXPECT_TRUE(metrics.at("split").is_null());
  EXPECT_EQ(metrics.at("data_hash").at("other_faces"), DataHash(*folder_ / "two"));
  EXPECT_NE(ReadFile(*folder_ / "other" / "index.html").find("on other faces"), std::string::npos);
}

TEST_F(DeformEvalTest, RefusesARunOfAnotherProduct) {
  WriteRun(*folder_ / "sketch");
  Manifest manifest = ReadManifest(*folder_ / "sketch", "run");
  manifest.details.erase("product");
  WriteManifest(*folder_ / "sketch", manifest);
  testing::ExpectError([&] { EvaluateDeformRun(*folder_ / "sketch", *folder_ / "none"); }, "not of a deformable model");
}

}  // namespace
}  // namespace daumier::deform
