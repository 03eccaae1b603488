#include "datasets/build/coverage.h"

#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(Coverage, ADatabaseIsRebuiltFromAllItsOwnComponents) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 3);
  const faces::FaceDatabase database(folder / "faces");
  const Coverage coverage = MeasureCoverage(database, database);
  EXPECT_EQ(coverage.num_basis_faces, 24);
  EXPECT_EQ(coverage.components.front(), 0);
  EXPECT_GT(coverage.errors_mm.front(), 0.5) << "the mean face alone";
  EXPECT_LT(coverage.errors_mm.back(), 1e-3);
}

TEST(Coverage, FurtherComponentsOfOtherPersonsHelp) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 8);
  FacesOptions options = testing::SyntheticFacesOptions(2);
  options.seed = 99;
  BuildFaces(testing::SyntheticModel(), options, folder / "others");
  const faces::FaceDatabase database(folder / "faces"), others(folder / "others");
  const Coverage coverage = MeasureCoverage(database, others);
  for (size_t i = 1; i < coverage.errors_mm.size(); ++i) EXPECT_LT(coverage.errors_mm[i], coverage.errors_mm[i - 1]);
  EXPECT_GT(coverage.errors_mm.back(), 1e-3) << "others are not among the faces of the basis";
}

}  // namespace
}  // namespace daumier::datasets
