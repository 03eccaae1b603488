#include "datasets/read/splits.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace daumier::datasets {
namespace {

using testing::ExpectError;
using testing::TempDir;

class SplitTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 8);
    database_ = new faces::FaceDatabase(*folder_ / "faces");
  }
  static void TearDownTestSuite() {
    delete database_;
    delete folder_;
  }

  static std::set<int> Persons(const std::vector<int>& faces) {
    std::set<int> persons;
    for (const int face : faces) persons.insert(database_->id(face).person);
    return persons;
  }

  static inline TempDir* folder_ = nullptr;
  static inline faces::FaceDatabase* database_ = nullptr;
};

TEST_F(SplitTest, SidesAreSortedDisjointAndTogetherAllFaces) {
  for (const std::string kind : {"person", "random"}) {
    const Split split = MakeSplit(*database_, {.kind = kind, .validation = 0.2, .test = 0.2}, 1);
    std::vector<int> all;
    for (const auto& side : {split.train, split.validation, split.test}) {
      EXPECT_TRUE(std::is_sorted(side.begin(), side.end()));
      EXPECT_FALSE(side.empty());
      all.insert(all.end(), side.begin(), side.end());
    }
    std::sort(all.begin(), all.end());
    std::vector<int> expected(database_->num_faces());
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(all, expected);
  }
}

TEST_F(SplitTest, AllFacesOfAPersonAreOnOneSide) {
  const Split split = MakeSplit(*database_, {.kind = "person", .validation = 0.125, .test = 0.25}, 3);
  EXPECT_EQ(Persons(split.test).size(), 2u);
  EXPECT_EQ(Persons(split.validation).size(), 1u);
  EXPECT_EQ(Persons(split.train).size(), 5u);
  EXPECT_EQ(split.test.size(), 2u * 8);
  EXPECT_EQ(split.validation.size(), 1u * 8);
}

TEST_F(SplitTest, RandomSplitsPutPersonsOnSeveralSides) {
  const Split split = MakeSplit(*database_, {.kind = "random", .validation = 0.0, .test = 0.25}, 3);
  EXPECT_EQ(split.test.size(), 16u);
  EXPECT_TRUE(split.validation.empty());
  EXPECT_EQ(Persons(split.train).size(), 8u);
  EXPECT_GT(Persons(split.test).size(), 2u);
}

TEST_F(SplitTest, SeedDecides) {
  const SplitOptions options{.kind = "person", .validation = 0.2, .test = 0.2};
  EXPECT_EQ(MakeSplit(*database_, options, 1).test, MakeSplit(*database_, options, 1).test);
  std::set<std::vector<int>> tests;
  for (uint64_t seed = 0; seed < 8; ++seed) tests.insert(MakeSplit(*database_, options, seed).test);
  EXPECT_GT(tests.size(), 2u);
}

TEST_F(SplitTest, EveryNonZeroShareGetsAPerson) {
  const Split split = MakeSplit(*database_, {.kind = "person", .validation = 0.01, .test = 0.01}, 1);
  EXPECT_EQ(Persons(split.test).size(), 1u);
  EXPECT_EQ(Persons(split.validation).size(), 1u);
}

TEST_F(SplitTest, TooFewPersonsAreRefused) {
  ExpectError([&] { MakeSplit(*database_, {.kind = "person", .validation = 0.5, .test = 0.5}, 1); }, "too few");
}

TEST_F(SplitTest, PersonsOfOneGroupStayOnOneSide) {
  const auto grouped = *folder_ / "grouped";
  std::filesystem::copy(*folder_ / "faces", grouped, std::filesystem::copy_options::recursive);
  Manifest manifest = ReadManifest(grouped, "faces");
  manifest.details["groups"] = {"ann", "bob", "ann", "bob", "cher", "ann", "dan", "bob"};
  WriteManifest(grouped, manifest);
  const faces::FaceDatabase database(grouped);
  EXPECT_EQ(database.groups(), (std::vector<int>{0, 1, 0, 1, 2, 0, 3, 1}));
  for (uint64_t seed = 0; seed < 12; ++seed) {
    const Split split = MakeSplit(database, {.kind = "person", .validation = 0.25, .test = 0.25}, seed);
    std::set<int> sides[3];
    int side = 0;
    for (const auto* faces : {&split.train, &split.validation, &split.test}) {
      for (const int face : *faces) sides[side].insert(database.groups()[database.id(face).person]);
      ++side;
    }
    EXPECT_EQ(sides[0].size(), 2u);
    EXPECT_EQ(sides[1].size(), 1u);
    EXPECT_EQ(sides[2].size(), 1u);
    std::set<int> all = sides[0];
    all.insert(sides[1].begin(), sides[1].end());
    all.insert(sides[2].begin(), sides[2].end());
    EXPECT_EQ(all.size(), 4u) << "a group is in two subsets";
    EXPECT_EQ(split.train.size() + split.validation.size() + split.test.size(), 64u);
  }
}

TEST_F(SplitTest, JsonNamesPersonsAndFaces) {
  const Split split = MakeSplit(*database_, {.kind = "person", .validation = 0.125, .test = 0.25}, 3);
  const Json json = SplitToJson(*database_, split);
  EXPECT_EQ(json.at("test").at("num_faces"), 16);
  EXPECT_EQ(json.at("test").at("num_persons"), 2);
  EXPECT_EQ(json.at("test").at("persons").get<std::set<int>>(), Persons(split.test));
  EXPECT_EQ(json.at("train").at("faces_checksum"), FacesChecksum(split.train));
  EXPECT_NE(FacesChecksum(split.train), FacesChecksum(split.test));
}

TEST(FacesChecksum, IsTheSha256OfLines) {
  // printf '3\n12\n' | sha256sum
  EXPECT_EQ(FacesChecksum({3, 12}), "043e42748d5d232a4cce13c014b426d22c35f56e48e6aa75e8c518b36968182a");
}

TEST(SplitOfFamilies, BothParentsOfAnInterpolatedFaceAreOnItsSide) {
  const TempDir folder;
  FacesOptions options = testing::SyntheticFacesOptions(8);
  options.num_interpolated = 40;
  options.family_size = 2;
  BuildFaces(testing::SyntheticModel(), options, folder / "faces");
  const faces::FaceDatabase database(folder / "faces");
  for (const uint64_t seed : {1, 2, 3}) {
    const Split split = MakeSplit(database, {.kind = "person", .validation = 0.25, .test = 0.25}, seed);
    std::vector<int> side_of_person(8, -1);
    const std::vector<int>* const sides[] = {&split.train, &split.validation, &split.test};
    int num_interpolated = 0;
    for (int side = 0; side < 3; ++side) {
      for (const int face : *sides[side]) {
        num_interpolated += face >= database.num_grid_faces();
        for (const int person : database.persons(face)) {
          EXPECT_TRUE(side_of_person[person] == -1 || side_of_person[person] == side);
          side_of_person[person] = side;
        }
      }
    }
    EXPECT_EQ(num_interpolated, 40);
    ExpectError([&] { MakeSplit(database, {.kind = "person", .validation = 0.5, .test = 0.5}, seed); },
                "4 groups of persons are too few");
    EXPECT_EQ(std::count(side_of_person.begin(), side_of_person.end(), 2), 2) << "one family of two";
  }
}

}  // namespace
}  // namespace daumier::datasets
