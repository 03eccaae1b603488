#include "reports/evaluation.h"

#include "core/files.h"
#include "tests/reports/report_fixture.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

namespace daumier::reports {
namespace {

namespace fs = std::filesystem;

Evaluation MakeEvaluation() {
  Evaluation evaluation;
  evaluation.table = {.columns = {{.key = "error", .title = "mm", .unit = "mm"}}, .faces = {0}, .groups = {0}};
  evaluation.table.rows = {MakeRow(evaluation.table, "network", {{"error", {1.5}}}, 1)};
  evaluation.metrics = {{"num_faces", 1}, {"table", TableJson(evaluation.table)}};
  evaluation.report = SyntheticReport();
  evaluation.manifest.kind = "report";
  evaluation.manifest.verb = "eval";
  const ReportSample& sample = evaluation.report.samples[0];
  evaluation.predictions =
      Predictions{evaluation.report.surface, {{0, sample.sketch, sample.truth, sample.prediction, sample.error_mm}}};
  return evaluation;
}

TEST(Evaluation, IsWrittenWholeWithChecksumsOfAllFiles) {
  const testing::TempDir folder;
  const Evaluation evaluation = MakeEvaluation();
  WriteEvaluation(folder / "report", evaluation);
  EXPECT_EQ(ReadMetrics(folder / "report"), evaluation.metrics);
  EXPECT_EQ(ReadReportPredictions(folder / "report")->faces[0].face, 0);
  EXPECT_EQ(ReadFile(folder / "report/table.md"), "| predictor | mm |\n|---|---:|\n| network | 1.500 |\n");
  const Manifest manifest = ReadManifest(folder / "report", "report");
  VerifyChecksums(folder / "report", manifest);
  for (const char* file : {"metrics.json", "table.md", "sheet.png", "mean_error.png", "errors.svg", "index.html",
                           "predictions.safetensors"})
    EXPECT_EQ(manifest.checksums.count(file), 1u) << file;
  EXPECT_EQ(manifest.checksums.size(), 7u);
}

TEST(Evaluation, ReplacesAnEarlierReportAndNothingElse) {
  const testing::TempDir folder;
  Evaluation evaluation = MakeEvaluation();
  WriteEvaluation(folder / "report", evaluation);
  evaluation.predictions.reset();
  WriteEvaluation(folder / "report", evaluation);
  EXPECT_FALSE(ReadReportPredictions(folder / "report").has_value());
  MakeDirectory(folder / "notes");
  WriteFileAtomically(folder / "notes/a.txt", "mine");
  testing::ExpectError([&] { CheckReportDirectory(folder / "notes"); }, "is not empty and holds no earlier report");
  testing::ExpectError([&] { WriteEvaluation(folder / "notes", evaluation); }, "holds no earlier report");
  EXPECT_EQ(ReadFile(folder / "notes/a.txt"), "mine");
}

TEST(Evaluation, ThatCannotBeDrawnLeavesTheEarlierReport) {
  const testing::TempDir folder;
  Evaluation evaluation = MakeEvaluation();
  WriteEvaluation(folder / "report", evaluation);
  evaluation.report.samples.clear();
  testing::ExpectError([&] { WriteEvaluation(folder / "report", evaluation); }, "needs a sample");
  VerifyChecksums(folder / "report", ReadManifest(folder / "report", "report"));
}

TEST(Evaluation, WithASheetOfItsOwnHasNoOtherPicture) {
  const testing::TempDir folder;
  Evaluation evaluation = MakeEvaluation();
  evaluation.predictions.reset();
  evaluation.sheet = Evaluation::Sheet{render::Image(8, 8, 3), "Each row: a drawing."};
  WriteEvaluation(folder / "report", evaluation);
  EXPECT_NE(ReadFile(folder / "report/index.html").find("Each row: a drawing."), std::string::npos);
  EXPECT_EQ(render::ReadImage(folder / "report/sheet.png").height, 8);
  EXPECT_FALSE(fs::exists(folder / "report/mean_error.png"));
}

TEST(Evaluation, FurtherPicturesAreOnThePageAndInTheManifest) {
  const testing::TempDir folder;
  Evaluation evaluation = MakeEvaluation();
  evaluation.predictions.reset();
  evaluation.sheet = Evaluation::Sheet{render::Image(8, 8, 3), "Each row: a drawing."};
  evaluation.pictures = {{"Portraits", "portraits.jpg", {render::Image(16, 24, 3, 80), "A portrait a row."}}};
  WriteEvaluation(folder / "report", evaluation);
  const std::string page = ReadFile(folder / "report/index.html");
  for (const char* text : {"sheet.png", "portraits.jpg", "A portrait a row."})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(render::ReadImage(folder / "report/portraits.jpg").width, 24);
  EXPECT_EQ(ReadManifest(folder / "report", "report").checksums.count("portraits.jpg"), 1u);
}

TEST(Evaluation, RefusesAManifestOfAnotherKindAndDamagedMetrics) {
  const testing::TempDir folder;
  Evaluation evaluation = MakeEvaluation();
  evaluation.manifest.kind = "run";
  testing::ExpectError([&] { WriteEvaluation(folder / "report", evaluation); }, "of kind 'run'");
  MakeDirectory(folder / "report");
  WriteFileAtomically(folder / "report/metrics.json", "{");
  testing::ExpectError([&] { ReadMetrics(folder / "report"); }, "metrics.json: not JSON");
}

}  // namespace
}  // namespace daumier::reports
