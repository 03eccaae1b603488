#include "datasets/build/stats.h"

#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

using testing::TempDir;

TEST(FaceStatistics, HoldCountsLicencesAndComponents) {
  const TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 3);
  const Json statistics = FaceStatistics(folder / "faces");
  EXPECT_EQ(statistics.at("persons"), 3);
  EXPECT_EQ(statistics.at("faces"), 24);
  EXPECT_EQ(statistics.at("licences").at(0).at("licence"), "Apache-2.0");
  EXPECT_EQ(statistics.at("data_hash"), DataHash(folder / "faces"));
  EXPECT_GT(statistics.at("millimetres_per_cm"), 0);
  // Three faces span two dimensions.
  EXPECT_EQ(statistics.at("principal_components_99").at("identities"), 2);
  EXPECT_EQ(statistics.at("principal_components_99").at("num_faces"), 24);
}

TEST(NumPrincipalComponents, IsTheRankWhereTheShareIsAll) {
  const TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 2);
  const faces::FaceDatabase database(folder / "faces");
  // Expressions of one face: three linear offsets in addition to neutral.
  EXPECT_EQ(NumPrincipalComponents(database, std::vector<int>{0, 1, 2, 3}, 1 - 1e-9), 3);
  EXPECT_EQ(NumPrincipalComponents(database, std::vector<int>{0, 1}, 0.99), 1);
  EXPECT_EQ(NumPrincipalComponents(database, std::vector<int>{0, 0}, 0.99), 0);
}

}  // namespace
}  // namespace daumier::datasets
