#include "systems/portrait/train/portrait_samples.h"

#include "tests/support/expect_error.h"
#include "tests/support/given_pictures.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

#include <numeric>

namespace daumier::portrait {
namespace {

TEST(CropSamples, AreTheDatabasesPortraitsInTheirCrops) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  PortraitTrainingOptions options = testing::SmallPortraitOptions();
  const CropSamples plain(portraits, {3, 5}, nullptr, options, Jitter::kNone, {true, true});
  const std::vector<int> both = {0, 1};
  const SampleBatch batch = plain.Get(both, 0);
  const std::vector<float> landmarks = portraits.landmarks(5);
  for (size_t k = 0; k < 136; ++k) EXPECT_NEAR(batch.arrays.at("landmarks").row(1)[k], landmarks[k], 1e-3);
  EXPECT_EQ(batch.arrays.at("known").values, (std::vector<float>{1, 1}));
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(batch.arrays.at("angles").row(0)[k], portraits.pose(3)[k], 1e-5);
  EXPECT_NEAR(batch.arrays.at("vertices").row(1)[4], portraits.vertices(5)(1, 1), 1e-5);
  EXPECT_EQ(batch.arrays.at("input").shape, (std::vector<int64_t>{2, 3, 64, 64}));
  EXPECT_EQ(batch.arrays.at("picture").shape, (std::vector<int64_t>{2, 3, 224, 224}));
  options.pictures.crop = "landmarks";
  options.pictures.shift = 10;
  const CropSamples jittered(portraits, {3, 5}, nullptr, options, Jitter::kRandom, {true, false});
  const SampleBatch first = jittered.Get(both, 0), again = jittered.Get(both, 0), next = jittered.Get(both, 1);
  EXPECT_EQ(first.arrays.at("input").values, again.arrays.at("input").values);
  EXPECT_NE(first.arrays.at("input").values, next.arrays.at("input").values);
}

TEST(CropSamples, HaveTheArraysThatAreAskedForAndPicturesWithoutTruthLast) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  const CropSamples samples(portraits, {6}, &portraits, testing::SmallPortraitOptions(), Jitter::kNone, {});
  EXPECT_EQ(samples.size(), 1 + 8);
  const std::vector<int> known_and_not = {0, 7};  // Image 6, twice.
  const SampleBatch batch = samples.Get(known_and_not, 0);
  EXPECT_FALSE(batch.arrays.contains("picture") || batch.arrays.contains("skin") || batch.arrays.contains("vertices"));
  const auto row = [&](const char* name, int64_t b) {
    const FloatArray& array = batch.arrays.at(name);
    return std::vector<float>(array.row(b), array.row(b) + array.row_size());
  };
  EXPECT_EQ(row("input", 0), row("input", 1));
  EXPECT_EQ(row("known", 1), std::vector<float>{0});
  EXPECT_EQ(row("light", 1), std::vector<float>(9));
  EXPECT_EQ(row("light", 0), std::vector<float>(portraits.light(6).begin(), portraits.light(6).end()));
  // All landmarks are seen: inner lips weigh 20, the chin 1.
  EXPECT_EQ(row("landmark_weights", 0)[66], 20);
  EXPECT_EQ(row("landmark_weights", 0)[8], 1);
  const std::vector<int> beyond = {9};
  testing::ExpectError([&] { samples.Get(beyond, 0); }, "portrait sample 9 of 9");
}

TEST(CropSamples, MixGivenPicturesInWithoutTheirFaces) {
  const testing::TempDir folder;
  testing::WriteGivenPictures(folder / "in");
  BuildGivenPortraits(testing::GivenDetector(), {}, folder / "in", {}, folder / "given");
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits"), given(folder / "given");
  const CropSamples samples(portraits, {6}, &given, testing::SmallPortraitOptions(), Jitter::kNone, {true, true});
  ASSERT_EQ(samples.size(), 1 + 3);
  const std::vector<int> both = {0, 2};
  const SampleBatch batch = samples.Get(both, 0);
  EXPECT_EQ(batch.arrays.at("known").values, (std::vector<float>{1, 0}));
  const FloatArray &vertices = batch.arrays.at("vertices"), &landmarks = batch.arrays.at("landmarks");
  EXPECT_EQ(std::vector<float>(vertices.row(1), vertices.row(1) + vertices.row_size()),
            std::vector<float>(size_t(vertices.row_size())));
  EXPECT_NEAR(landmarks.row(1)[60], given.landmarks(1)[60], 1e-3);
  const FloatArray& skin = batch.arrays.at("skin");
  EXPECT_GT(std::accumulate(skin.row(1), skin.row(1) + skin.row_size(), 0.0), 1000);
}

TEST(CropSamples, MoveLandmarksAndFaceTogether) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  PortraitTrainingOptions options = testing::SmallPortraitOptions();
  options.pictures.shift = 20;
  const std::vector<int> first = {0};
  const CropSamples plain(portraits, {2}, nullptr, options, Jitter::kNone, {true, false}),
      moved(portraits, {2}, nullptr, options, Jitter::kRandom, {true, false});
  const auto centre = [](const SampleBatch& batch, const char* what) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double count = 0;
    const float* const numbers = batch.arrays.at(what).row(0);
    if (what == std::string("landmarks")) {
      for (size_t n = 0; n < 68; ++n) sum += Eigen::Vector2d(numbers[2 * n], numbers[2 * n + 1]), ++count;
    } else {
      for (int p = 0; p < kPortraitSide * kPortraitSide; ++p)
        if (numbers[p] > 0) sum += Eigen::Vector2d(p % kPortraitSide, p / kPortraitSide), ++count;
    }
    return Eigen::Vector2d(sum / count);
  };
  const SampleBatch before = plain.Get(first, 3), after = moved.Get(first, 3);
  const Eigen::Vector2d by = centre(after, "landmarks") - centre(before, "landmarks");
  EXPECT_GT(by.norm(), 1);
  EXPECT_LT((centre(after, "skin") - centre(before, "skin") - by).norm(), 1);
}

TEST(PlainCrop, IsThePictureOrTheBoxOfItsLandmarks) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  PortraitPictureOptions options;
  options.crop = "none";
  EXPECT_TRUE(PlainCrop(portraits, 1, options).linear.isIdentity(1e-12));
  options.crop = "landmarks";
  options.size = 0.5;
  const std::vector<float> landmarks = MapLandmarks(portraits.landmarks(1), PlainCrop(portraits, 1, options));
  const auto points = Eigen::Map<const Eigen::Matrix<float, 68, 2, Eigen::RowMajor>>(landmarks.data());
  EXPECT_NEAR((points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff(), 112, 1e-2);
}

TEST(ImagesOfPersons, AreThoseOfTheWantedPersonsAndStyles) {
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  EXPECT_EQ(ImagesOfPersons(portraits, {3, 1}), (std::vector<int>{2, 3, 6, 7}));
  EXPECT_TRUE(ImagesOfPersons(portraits, {}).empty());
  EXPECT_TRUE(ImagesOfPersons(portraits, {0, 1}, {"plain"}).empty());
  EXPECT_EQ(ImagesOfPersons(portraits, {0}, {"bald"}), (std::vector<int>{0, 1}));
  testing::ExpectError([&] { ImagesOfPersons(portraits, {0}, {"oil"}); }, "no style 'oil' (expected bald or plain)");
}

}  // namespace
}  // namespace daumier::portrait
