#include "export/model_card.h"

#include <gtest/gtest.h>

namespace daumier::exporting {
namespace {

TEST(ModelCard, HoldsTheTextLicencesErrorsAndExactness) {
  const CardText text{.title = "A model",
                      .summary = "It computes.",
                      .inputs_and_outputs = "| `sketch` | (N, 1, 32, 32) float32 |\n\n",
                      .limits = {"It errs.", "It guesses."}};
  Manifest run;
  run.seed = 5;
  run.sources = Json::array({{{"name", "synthetic"}, {"version", "1"}, {"checksum", "0"}, {"licence", "CC0-1.0"}}});
  const auto expect = [](const std::string& card, const std::string& part) {
    EXPECT_NE(card.find(part), std::string::npos) << part;
  };
  const ParityReport compared{"onnxruntime 9", {1}, {"u"}, {2e-6}};
  const auto card =
      ModelCard(text, run, compared, Json{{"mean_vertex_error_mm", 1.25}, {"split", "test"}, {"rows", Json::array()}});
  expect(card, "# A model\n\nIt computes.\n\n## Input and outputs\n\n| `sketch`");
  expect(card, "| synthetic | 1 | CC0-1.0 | 0 |");
  expect(card, "- seed: 5");
  expect(card, "| mean_vertex_error_mm | 1.25 |");
  expect(card, "differ by at most 2e-06");
  expect(card, "## Limits\n\n- It errs.\n- It guesses.\n");
  EXPECT_EQ(card.find("| rows |"), std::string::npos);
  expect(CardErrors(Json{{"pictures", {{"median", 0.06}, {"list", Json::array()}}}, {"negatives", nullptr}}),
         "|---|---|\n| pictures.median | 0.06 |\n\n");
  const auto unmeasured = ModelCard(text, run, {std::nullopt, {1}, {"u"}, {}}, std::nullopt);
  expect(unmeasured, "`daumier eval` has not been run");
  expect(unmeasured, "It was not run in ONNX Runtime");
}

TEST(ModelCard, ListsEveryRuntimeThatWasTried) {
  const auto card = [](const OtherRuntime& other) {
    return ModelCard({}, {}, {"onnxruntime 9", {1}, {"u"}, {2e-6}, {other}}, std::nullopt);
  };
  const OtherRuntime same{"OpenCV 4", {1, 2, 7}, 3e-7, std::nullopt}, wrong{"OpenCV 4", {1}, 0.3, std::nullopt},
      refused{"OpenCV 4", {1}, std::nullopt, "no Sin here"};
  EXPECT_NE(card(same).find("OpenCV 4, batch sizes 1, 2, 7: outputs differ from LibTorch's by at most 3e-07 of"),
            std::string::npos);
  EXPECT_EQ(card(same).find("do not use it"), std::string::npos);
  EXPECT_NE(card(wrong).find("too much: do not use it there"), std::string::npos);
  EXPECT_NE(card(refused).find("does not run it. no Sin here"), std::string::npos);
}

}  // namespace
}  // namespace daumier::exporting
