#include "systems/portrait/train/picture_evaluation.h"

#include "core/files.h"
#include "systems/portrait/portrait_metrics.h"
#include "tests/support/expect_error.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

void WriteLandmarkText(const std::filesystem::path& file, const std::vector<float>& landmarks) {
  std::string text;
  for (size_t n = 0; n < 68; ++n) text += fmt::format("{} {}\n", landmarks[2 * n], landmarks[2 * n + 1]);
  WriteFileAtomically(file, text);
}

TEST(PictureEvaluation, MeasuresFacesByLandmarksOfPictures) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  const testing::TempDir folder;
  for (const char* name : {"pictures", "detected"}) MakeDirectory(folder / name);
  for (const int image : {2, 5}) {
    render::WriteImage(folder / fmt::format("pictures/{}.png", image), portraits.picture(image));
    WriteLandmarkText(folder / fmt::format("pictures/{}.txt", image), portraits.landmarks(image));
  }
  render::WriteImage(folder / "pictures/alone.png", portraits.picture(0));  // Has no landmarks: left out.
  WriteLandmarkText(folder / "detected/2.txt", portraits.landmarks(2));
  PortraitRun run = LoadPortraitRun(testing::SmallPortraitRun());
  const PictureEvaluation evaluation = EvaluatePictures(folder / "pictures", folder / "detected", run);
  EXPECT_EQ(evaluation.table.rows.size(), 4U);
  const Json& pictures = evaluation.metrics.at("pictures");
  ASSERT_EQ(pictures.size(), 2U);
  for (const Json& row : evaluation.metrics.at("rows")) {
    const std::string name = row.at("name");
    EXPECT_EQ(row.at("num_pictures"), 2);
    EXPECT_NEAR(row.at("mean").get<double>(),
                (pictures.at("2").at(name).get<double>() + pictures.at("5").at(name).get<double>()) / 2, 1e-12);
  }
  // A detection that is the truth gives the same crop, and so the same face; without one the crop is another.
  const std::string detected = "network, detected landmarks";
  EXPECT_NEAR(pictures.at("2").at(detected).get<double>(), pictures.at("2").at(kPortraitNetworkRow).get<double>(),
              1e-6);
  EXPECT_NE(pictures.at("5").at(detected), pictures.at("5").at(kPortraitNetworkRow));
  // The fit sees what it is measured by, and the pictures show faces of the model.
  const std::string suffix = " to the given landmarks";
  EXPECT_LT(pictures.at("5").at(kLandmarkFitRow + suffix).get<double>(),
            0.5 * pictures.at("5").at(kMeanFaceRow + suffix).get<double>());
  EXPECT_GT(evaluation.all.width, 6 * 200) << "two pictures a row";
  EXPECT_LT(evaluation.all.height, 2 * 200);
  EXPECT_LT(evaluation.chosen.width, 4 * 224) << "one picture a row";
  EXPECT_GT(evaluation.chosen.height, 4 * 224) << "of median, 95th percentile, largest error, first";
}

TEST(PictureEvaluation, RefusesAFolderWithoutLandmarks) {
  const testing::TempDir folder;
  render::WriteImage(folder / "1.png", render::Image(9, 9, 3, 5));
  PortraitRun run = LoadPortraitRun(testing::SmallPortraitRun());
  testing::ExpectError([&] { EvaluatePictures(folder.path(), {}, run); }, "holds no picture with a landmark file");
}

}  // namespace
}  // namespace daumier::portrait
