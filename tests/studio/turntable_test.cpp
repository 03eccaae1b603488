#include "studio/turntable.h"

#include "render/image.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

TEST(Turntable, HasAPictureAStepOfAWholeTurn) {
  const testing::TempDir folder;
  const faces::FaceTemplate face = testing::SyntheticFace();
  const DisplayHead display(face);
  WriteTurntable(folder.path(), display, face.neutral, {.frames = 3, .size = 64}, Task());
  std::vector<render::Image> pictures;
  for (const char* name : {"turn_001.png", "turn_002.png", "turn_003.png"}) {
    pictures.push_back(render::ReadImage(folder / name));
    EXPECT_EQ(pictures.back().width, 64);
    EXPECT_EQ(pictures.back().height, 64);
  }
  EXPECT_NE(pictures[0], pictures[1]);
  EXPECT_NE(pictures[1], pictures[2]);
  EXPECT_FALSE(fs::exists(folder / "turn_004.png"));
  EXPECT_GT(render::ReadImage(folder / "turntable.png").width, 64);
  const testing::TempDir again;
  WriteTurntable(again.path(), display, face.neutral, {.frames = 2, .size = 64}, Task());
  EXPECT_EQ(render::ReadImage(again / "turn_001.png"), pictures[0]) << "the first is from the front";
}

TEST(Turntable, TheSheetHas12PicturesAtMost) {
  const testing::TempDir folder;
  const faces::FaceTemplate face = testing::SyntheticFace();
  const DisplayHead display(face);
  const auto pixels = [&](int frames) {
    WriteTurntable(folder.path(), display, face.neutral, {.frames = frames, .size = 64}, Task());
    const render::Image sheet = render::ReadImage(folder / "turntable.png");
    return sheet.width * sheet.height;
  };
  const int of_12 = pixels(12);
  EXPECT_LT(pixels(6), of_12);
  EXPECT_EQ(pixels(24), of_12);
}

TEST(Turntable, EndsWhenItIsCancelled) {
  const testing::TempDir folder;
  const faces::FaceTemplate face = testing::SyntheticFace();
  const DisplayHead display(face);
  EXPECT_THROW(WriteTurntable(folder.path(), display, face.neutral, {}, testing::CancelledTask()), Cancelled);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  testing::ExpectError(
      [&] { WriteTurntable(folder / "nothing", display, face.neutral, {.frames = 2, .size = 64}, Task()); },
      "turn_001.png");
}

}  // namespace
}  // namespace daumier::studio
