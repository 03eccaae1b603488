#include "datasets/gallery/control_sheets.h"

#include "core/files.h"
#include "core/json.h"
#include "core/manifest.h"
#include "render/image.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(ControlSheets, ShowEachControlAtFiveValues) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const faces::FaceControls controls(face);
  const testing::TempDir folder;
  WriteControlSheets(controls, face, folder.path());
  const Json described = ReadJson(folder / "controls.json");
  EXPECT_EQ(described.at("controls").size(), 60u);
  EXPECT_EQ(described.at("composition").at("most").size(), 20u);
  EXPECT_GT(described.at("composition").at("most")[0].at("max_mm"), 1.0);
  for (const Json& control : described.at("controls")) {
    EXPECT_GT(control.at("max_mm"), 0.1) << control.at("name");
    EXPECT_EQ(control.at("values").size(), control.at("sides") == "paired" ? 2u : 1u);
  }
  for (const std::string& name : ControlSheetNames(controls)) {
    const render::Image sheet = render::ReadImage(folder / name);
    EXPECT_GT(sheet.width, 9 * 190) << name << ": five values from the front and from the side";
  }
  EXPECT_NO_THROW(VerifyChecksums(folder.path(), ReadManifest(folder.path(), kControlSheetsKind)));
}

TEST(ControlSheets, StopBetweenPictures) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const testing::TempDir folder;
  EXPECT_THROW(WriteControlSheets(faces::FaceControls(face), face, folder.path(), testing::CancelledTask()), Cancelled);
}

}  // namespace
}  // namespace daumier::datasets
