#include "export/model_card.h"

#include "tests/support/sketch_run_folder.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::exporting {
namespace {

TEST(ModelCard, TellsUnitsLicencesErrorsAndExactness) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder.path());
  const auto run = sketch::LoadSketchRun(folder.path());
  const auto expect = [](const std::string& card, const std::string& part) {
    EXPECT_NE(card.find(part), std::string::npos) << part;
  };
  const ParityReport compared{"onnxruntime 9", {1}, {"u"}, {2e-6}};
  const auto card =
      ModelCard(run, compared, Json{{"mean_vertex_error_mm", 1.25}, {"split", "test"}, {"rows", Json::array()}});
  expect(card, "(N, 1, 32, 32) float32");
  expect(card, "in centimetres");
  expect(card, "| synthetic | 1 | CC0-1.0 | 0 |");
  expect(card, "| mean_vertex_error_mm | 1.25 |");
  expect(card, "differ by at most 2e-06");
  EXPECT_EQ(card.find("| rows |"), std::string::npos);
  const auto unmeasured = ModelCard(run, {std::nullopt, {1}, {"u"}, {}}, std::nullopt);
  expect(unmeasured, "`daumier eval` has not been run");
  expect(unmeasured, "It was not run in ONNX Runtime");
}

}  // namespace
}  // namespace daumier::exporting
