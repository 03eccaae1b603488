#include "datasets/build/interpolation.h"

#include "core/safetensors.h"
#include "faces/bilinear_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

using testing::TempDir;

TEST(Families, TakeEveryPersonAndTheLastOneWhatIsLeftOver) {
  const std::vector<Family> families = MakeFamilies(13, 5);
  ASSERT_EQ(families.size(), 2u);
  EXPECT_EQ(families[0].first, 0);
  EXPECT_EQ(families[0].size, 5);
  EXPECT_EQ(families[1].first, 5);
  EXPECT_EQ(families[1].size, 8);
  testing::ExpectError([] { MakeFamilies(4, 5); }, "4 persons make no family of 5");
}

TEST(DrawInterpolation, ParentsAreTwoPersonsOfOneFamilyAndReachEveryPlace) {
  const std::vector<Family> families = MakeFamilies(6, 3);
  std::set<std::pair<int, int>> pairs;
  std::set<int> levels, expressions;
  for (int i = 0; i < 500; ++i) {
    const Interpolation drawn = DrawInterpolation(families, 3, 4, 1, i);
    EXPECT_NE(drawn.a.person, drawn.b.person);
    EXPECT_EQ(drawn.a.person / 3, drawn.b.person / 3);
    EXPECT_GE(drawn.identity_share, 0);
    EXPECT_LT(drawn.identity_share, 1);
    pairs.insert({drawn.a.person, drawn.b.person});
    levels.insert(drawn.b.level);
    expressions.insert(drawn.a.expression);
  }
  EXPECT_EQ(pairs.size(), 12u);
  EXPECT_EQ(levels.size(), 3u);
  EXPECT_EQ(expressions.size(), 4u);
}

/// Two persons, one level, two expressions, one vertex, chosen by hand.
class InterpolateTest : public ::testing::Test {
 protected:
  InterpolateTest() {
    std::filesystem::create_directories(folder_ / "shards");
    Write(0, {0, 0, 0, 1, 0, 0});
    Write(1, {0, 10, 0, 1, 10, 4});
  }
  void Write(int person, const std::vector<float>& vertices) {
    SafetensorsWriter writer;
    writer.Add<float>("vertices", {1, 2, 1, 3}, vertices);
    writer.Write(folder_ / faces::PersonShardName(person));
  }

  TempDir folder_;
  Interpolation between_{{0, 0, 0}, {1, 0, 1}, 0.25f, 0.5f};
};

TEST_F(InterpolateTest, MixesTheFourFacesOfBothParents) {
  // x = t = .5; y = 10 s = 2.5; z = 4 s t = 0.5.
  EXPECT_EQ(Interpolate(folder_.path(), between_), (std::vector<float>{0.5f, 2.5f, 0.5f}));
}

TEST_F(InterpolateTest, SharesOfZeroAndOneAreTheParents) {
  between_.identity_share = between_.expression_share = 0;
  EXPECT_EQ(Interpolate(folder_.path(), between_), (std::vector<float>{0, 0, 0}));
  between_.identity_share = between_.expression_share = 1;
  EXPECT_EQ(Interpolate(folder_.path(), between_), (std::vector<float>{1, 10, 4}));
}

TEST_F(InterpolateTest, IsTheFaceOfInterpolatedWeightsOfABilinearModel) {
  // A tensor of full rank is its own bilinear model.
  const std::vector<std::vector<float>> faces = {{0, 0, 0}, {1, 0, 0}, {0, 10, 0}, {1, 10, 4}};
  const faces::BilinearModel model = faces::FitBilinear(
      2, 2, 3, [&](int identity, int expression) { return std::span<const float>(faces[2 * identity + expression]); },
      {.num_identity = 2, .num_expression = 2});
  const auto mix = [](const Eigen::MatrixXf& rows, float share) -> Eigen::VectorXf {
    return (1 - share) * rows.row(0) + share * rows.row(1);
  };
  const Eigen::VectorXf expected = faces::Reconstruct(model, mix(model.identity_factors, between_.identity_share),
                                                      mix(model.expression_factors, between_.expression_share));
  const std::vector<float> face = Interpolate(folder_.path(), between_);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(face[k], expected[k], 1e-4);
}

TEST_F(InterpolateTest, ShardsHoldParentsAndShares) {
  WriteInterpolatedShard(folder_ / "shard", folder_.path(), {between_});
  const SafetensorsFile shard(folder_ / "shard");
  EXPECT_EQ(shard.at("vertices").shape, (std::vector<int64_t>{1, 1, 3}));
  const auto parents = shard.at("parents").As<int32_t>();
  EXPECT_EQ(std::vector<int32_t>(parents.begin(), parents.end()), (std::vector<int32_t>{0, 3}));
  EXPECT_EQ(shard.at("shares").As<float>()[1], 0.5f);
}

TEST(ReadInterpolation, IsWhatWasDrawn) {
  const testing::TempDir folder;
  FacesOptions options = testing::SyntheticFacesOptions(2);
  options.num_interpolated = 10;  // Two shards.
  options.family_size = 2;
  BuildFaces(testing::SyntheticModel(), options, folder / "faces");
  const faces::FaceDatabase database(folder / "faces");
  for (int i = 0; i < 10; ++i) {
    const Interpolation drawn =
        DrawInterpolation(MakeFamilies(2, 2), database.num_levels(), database.num_expressions(), options.seed, i);
    const Interpolation read = ReadInterpolation(database, database.num_grid_faces() + i);
    EXPECT_EQ(read.a, drawn.a);
    EXPECT_EQ(read.b, drawn.b);
    EXPECT_EQ(read.identity_share, drawn.identity_share);
    EXPECT_EQ(read.expression_share, drawn.expression_share);
  }
  testing::ExpectError([&] { ReadInterpolation(database, 0); },
                       "face 0 of a database of 26 faces was not interpolated");
  testing::ExpectError([&] { ReadInterpolation(database, 26); }, "face 26");
}

}  // namespace
}  // namespace daumier::datasets
