#include "export/run_export.h"

#include "core/error.h"
#include "core/files.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/run.h"
#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"
#include "tests/support/sketch_run_folder.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::exporting {
namespace {

namespace fs = std::filesystem;

class RunExportTest : public ::testing::Test {
 protected:
  RunExportTest() {
    testing::AllowWarnings();  // There may be no runtime.
    testing::WriteSketchRun(folder_ / "run");
    run_ = sketch::LoadSketchRun(folder_ / "run");
  }

  RunExport Export() const {
    return {.run_directory = folder_ / "run",
            .run_manifest = run_.manifest,
            .module = *run_.network,
            .function = sketch::SketchFunction(run_.network),
            .face_template = run_.face_template,
            .counts = {{"parts", 3}},
            .details = {{"colour", "blue"}},
            .write_rest =
                [](const fs::path& folder) {
                  WriteFileAtomically(folder / "more.txt", "more");
                  return std::map<std::string, std::string>{{"more.txt", Sha256("more")}};
                },
            .model_card =
                [](const ParityReport&, const std::optional<Json>& metrics) {
                  return metrics.has_value() ? "measured" : "not measured";
                }};
  }

  const testing::TempDir folder_;
  const WithoutNpmPackage without_;
  sketch::SketchRun run_;
};

TEST_F(RunExportTest, ManifestTellsWhatIsThereAndWhatTheCallerAdds) {
  WriteExport(Export(), folder_ / "out");
  const Manifest manifest = ReadManifest(folder_ / "out", "export");
  VerifyChecksums(folder_ / "out", manifest);
  EXPECT_EQ(manifest.checksums.count("more.txt"), 1u);
  EXPECT_EQ(manifest.counts.at("parts"), 3);
  EXPECT_EQ(manifest.details.at("colour"), "blue");
  EXPECT_EQ(manifest.details.at("opset"), 13);
  EXPECT_EQ(ReadFile(folder_ / "out/model_card.md"), "not measured");
}

TEST_F(RunExportTest, TheCardSeesTheRunsMetrics) {
  MakeDirectory(folder_ / "run/report");
  WriteFileAtomically(folder_ / "run/report/metrics.json", "{}");
  WriteExport(Export(), folder_ / "out");
  EXPECT_EQ(ReadFile(folder_ / "out/model_card.md"), "measured");
}

TEST_F(RunExportTest, AFailureReplacesNothing) {
  WriteExport(Export(), folder_ / "out");
  const std::string before = ReadFile(folder_ / "out/manifest.json");
  RunExport fails = Export();
  fails.write_rest = [](const fs::path&) -> std::map<std::string, std::string> { throw Error("no room left"); };
  testing::ExpectError([&] { WriteExport(fails, folder_ / "out"); }, "no room left");
  EXPECT_EQ(ReadFile(folder_ / "out/manifest.json"), before);
}

}  // namespace
}  // namespace daumier::exporting
