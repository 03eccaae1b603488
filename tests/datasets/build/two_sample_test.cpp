#include "datasets/build/two_sample.h"

#include "core/random.h"
#include "geometry/alignment.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

namespace daumier::datasets {
namespace {

geometry::Points CloudOfPoints(Rng& rng, int count) {
  return geometry::Points::NullaryExpr(count, 3, [&] { return rng.Normal(); });
}

/// `count` shapes about `mean`, each a group of its own.
ShapeGroups ShapesAbout(const geometry::Points& mean, int count, double spread, Rng& rng) {
  ShapeGroups groups;
  for (int i = 0; i < count; ++i) groups.push_back({mean + spread * CloudOfPoints(rng, int(mean.rows()))});
  return groups;
}

TEST(TestTwoSamples, SetsOfOneDistributionGiveAHalf) {
  Rng rng(1);
  const geometry::Points mean = CloudOfPoints(rng, 12);
  const TwoSampleTest test =
      TestTwoSamples(ShapesAbout(mean, 200, 0.1, rng), ShapesAbout(mean, 200, 0.1, rng), 30, 100);
  EXPECT_NEAR(test.accuracy, 0.5, 0.04);
  EXPECT_NEAR(test.accuracy_spread, 0.065, 0.03) << "the root of 0.25 / 60";
  EXPECT_EQ(test.sample_size, 30);
}

TEST(TestTwoSamples, SetsThatAreApartGiveOne) {
  Rng rng(2);
  const TwoSampleTest test = TestTwoSamples(ShapesAbout(CloudOfPoints(rng, 12), 40, 0.05, rng),
                                            ShapesAbout(CloudOfPoints(rng, 12), 40, 0.05, rng), 30, 5);
  EXPECT_EQ(test.accuracy, 1);
  EXPECT_EQ(test.accuracy_spread, 0);
  EXPECT_EQ(test.first_accuracy, 1);
  EXPECT_EQ(test.second_accuracy, 1);
}

TEST(TestTwoSamples, ANarrowSetAmongAWideOneIsRecognisedOnItsOwn) {
  Rng rng(3);
  const geometry::Points mean = CloudOfPoints(rng, 12);
  const TwoSampleTest test = TestTwoSamples(ShapesAbout(mean, 40, 0.2, rng), ShapesAbout(mean, 40, 0.01, rng), 30, 10);
  EXPECT_LT(test.first_accuracy, 0.3) << "the nearest of a wide shape is near the mean";
  EXPECT_GT(test.second_accuracy, 0.9);
  EXPECT_NEAR(test.accuracy, 0.5 * (test.first_accuracy + test.second_accuracy), 1e-12);
}

TEST(TestTwoSamples, ASimilarityOfAnyShapeChangesNothing) {
  Rng rng(4);
  const geometry::Points mean = CloudOfPoints(rng, 12);
  const ShapeGroups first = ShapesAbout(mean, 20, 0.1, rng);
  ShapeGroups second = ShapesAbout(mean, 20, 0.12, rng);
  const TwoSampleTest before = TestTwoSamples(first, second, 15, 10);
  for (auto& group : second) {
    geometry::Similarity similarity;
    similarity.scale = rng.Uniform(0.1, 30);
    similarity.rotation =
        Eigen::Quaterniond(rng.Normal(), rng.Normal(), rng.Normal(), 1).normalized().toRotationMatrix();
    similarity.translation << rng.Normal(), 50 * rng.Normal(), rng.Normal();
    group.front() = similarity.Apply(group.front());
  }
  EXPECT_NEAR(TestTwoSamples(first, second, 15, 10).accuracy, before.accuracy, 0.01);
}

TEST(TestTwoSamples, DrawsOneShapeOfAGroup) {
  Rng rng(5);
  const geometry::Points mean = CloudOfPoints(rng, 12);
  ShapeGroups first = ShapesAbout(mean, 200, 0.1, rng), second = ShapesAbout(mean, 200, 0.1, rng);
  for (auto& group : second) group.push_back(group.front() + 1e-4 * CloudOfPoints(rng, 12));  // A twin.
  EXPECT_NEAR(TestTwoSamples(first, second, 30, 50).second_accuracy, 0.5, 0.1) << "1 if twins met";
}

TEST(TestTwoSamples, TakesFewerWhereThereAreFewer) {
  Rng rng(6);
  const geometry::Points mean = CloudOfPoints(rng, 12);
  EXPECT_EQ(TestTwoSamples(ShapesAbout(mean, 5, 0.1, rng), ShapesAbout(mean, 9, 0.1, rng), 30, 2).sample_size, 5);
}

TEST(TestTwoSamples, RefusesWhatItCannotCompare) {
  Rng rng(7);
  const geometry::Points mean = CloudOfPoints(rng, 12), other = CloudOfPoints(rng, 11);
  const ShapeGroups shapes = ShapesAbout(mean, 4, 0.1, rng);
  testing::ExpectError([&] { TestTwoSamples(shapes, ShapesAbout(other, 4, 0.1, rng), 3, 2); }, "12 and 11 points");
  testing::ExpectError([&] { TestTwoSamples(shapes, ShapesAbout(mean, 1, 0.1, rng), 3, 2); }, "found 1");
  testing::ExpectError([&] { TestTwoSamples({}, shapes, 3, 2); }, "no face");
  testing::ExpectError([&] { TestTwoSamples(shapes, {{mean}, {}}, 3, 2); }, "no face");
  testing::ExpectError([&] { TestTwoSamples(shapes, shapes, 1, 2); }, "2 draws of 1");
}

TEST(CompareLandmarks, RegularFacesOfOneModelAgreeAndAreApartFromItsExaggeratedOnes) {
  const testing::TempDir folder;
  FacesOptions options = testing::SyntheticFacesOptions(24);
  options.expressions = {"neutral"};
  options.exaggeration.gammas = {0.0, 0.8};
  options.levels = "parts";
  BuildFaces(testing::SyntheticModel(), options, folder / "faces");
  options.seed = 99;
  options.exaggeration.gammas = {0.0};
  options.levels = "whole";
  BuildFaces(testing::SyntheticModel(), options, folder / "others");
  const faces::FaceDatabase faces(folder / "faces"), others(folder / "others");
  const LandmarkComparison regular = CompareLandmarks(others, faces, {0}),
                           exaggerated = CompareLandmarks(others, faces, {});
  EXPECT_EQ(regular.neutral.sample_size, 24);
  EXPECT_NEAR(regular.neutral.accuracy, 0.5, 0.2);
  EXPECT_EQ(regular.all_expressions.accuracy, regular.neutral.accuracy) << "there is one expression";
  EXPECT_GT(exaggerated.neutral.first_accuracy, regular.neutral.first_accuracy + 0.2)
      << "regular faces are nearest to regular ones";
  EXPECT_LT(exaggerated.neutral.second_accuracy, 0.5) << "and so are faces that are far from each other";
  EXPECT_EQ(CompareLandmarks(others, faces, {1}).neutral.accuracy, exaggerated.neutral.accuracy);
  EXPECT_EQ(regular.matched.size(), 68u);
  EXPECT_FALSE(regular.neutral_matched) << "nothing was registered";
  testing::ExpectError([&] { CompareLandmarks(others, faces, {2}); }, "no level 3");
}

TEST(CompareLandmarks, LeavesOutWhatMostMeshesDoNotHave) {
  const testing::TempDir folder;
  FacesOptions options = testing::SyntheticFacesOptions(6);
  options.exaggeration.gammas = {0.0};
  options.expressions = {"neutral"};
  BuildFaces(testing::SyntheticModel(), options, folder / "faces");
  const faces::FaceDatabase faces(folder / "faces");
  const auto& landmarks = faces.face_template().annotation.landmarks;

  std::filesystem::copy(folder / "faces", folder / "registered", std::filesystem::copy_options::recursive);
  for (int person = 0; person < 6; ++person) {
    std::vector<float> distances(size_t(faces.num_vertices()), 0.0f);
    distances[landmarks[66]] = std::numeric_limits<float>::quiet_NaN();
    if (person < 4) distances[landmarks[10]] = std::numeric_limits<float>::quiet_NaN();
    if (person < 3) distances[landmarks[11]] = std::numeric_limits<float>::quiet_NaN();
    SafetensorsWriter shard;
    geometry::Points points = faces.points(person);
    points(landmarks[66], 1) -= 5;  // A lip that no face of the model has.
    const std::vector<float> vertices(points.data(), points.data() + points.size());
    shard.Add<float>("vertices", {1, 1, faces.num_vertices(), 3}, vertices);
    shard.Add<float>("distances", {faces.num_vertices()}, distances);
    shard.Add<float>("identity_weights", {int64_t(faces.identity_weights(person).size())},
                     faces.identity_weights(person));
    shard.Write(folder / "registered" / faces::PersonShardName(person));
  }
  const LandmarkComparison comparison =
      CompareLandmarks(faces::FaceDatabase(folder / "registered", Checksums::kSkip), faces, {});
  EXPECT_EQ(comparison.matched.size(), 66u) << "without 10 and 66; half of the meshes have 11";
  EXPECT_GT(comparison.neutral.accuracy, 0.9) << "the lip separates them";
  ASSERT_TRUE(comparison.neutral_matched);
  EXPECT_LT(comparison.neutral_matched->accuracy, 0.5) << "each one's nearest is its own copy in the other set";
}

}  // namespace
}  // namespace daumier::datasets
