#include "systems/sketch/fitted_models.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/random_bilinear.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

using testing::TempDir;

FittedModels ModelsOfTenVertices(int residual) {
  FittedModels models{testing::RandomBilinear(10, 6, 3, 1), testing::RandomBilinear(6, 4, 2, 2), {}};
  if (residual > 0) {
    Rng rng(3);
    models.basis.rows =
        faces::BilinearModel::Core::NullaryExpr(residual, 30, [&] { return static_cast<float>(rng.Normal()); });
    models.basis.deviation = Eigen::VectorXf::LinSpaced(residual, 0.1f, 0.4f);
  }
  return models;
}

void ExpectEqual(const faces::BilinearModel& found, const faces::BilinearModel& expected) {
  EXPECT_EQ(found.num_identity, expected.num_identity);
  EXPECT_EQ(found.num_expression, expected.num_expression);
  EXPECT_EQ(found.core, expected.core);
  EXPECT_EQ(found.identity_factors, expected.identity_factors);
  EXPECT_EQ(found.expression_factors, expected.expression_factors);
}

TEST(FittedModels, ComeBackWithTheirBasis) {
  const TempDir folder;
  const FittedModels models = ModelsOfTenVertices(4);
  WriteFittedModels(folder.path(), models);
  const FittedModels again = ReadFittedModels(folder.path());
  ExpectEqual(again.bilinear, models.bilinear);
  ExpectEqual(again.curves, models.curves);
  EXPECT_EQ(again.basis.rows, models.basis.rows);
  EXPECT_EQ(again.basis.deviation, models.basis.deviation);
}

TEST(FittedModels, WithoutAResidualThereIsNoBasis) {
  const TempDir folder;
  const FittedModels models = ModelsOfTenVertices(0);
  const auto checksums = WriteFittedModels(folder.path(), models);
  EXPECT_EQ(checksums.size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(folder / "basis.safetensors"));
  const FittedModels again = ReadFittedModels(folder.path());
  ExpectEqual(again.bilinear, models.bilinear);
  ExpectEqual(again.curves, models.curves);
  EXPECT_EQ(again.basis.size(), 0);
}

TEST(FittedModels, ComeBackWithTheirGaussianWhichEarlierRunsHaveNot) {
  const TempDir folder;
  for (const char* run : {"earlier", "run"}) MakeDirectory(folder / run);
  FittedModels models = ModelsOfTenVertices(0);
  WriteFittedModels(folder / "earlier", models);
  EXPECT_EQ(ReadFittedModels(folder / "earlier").gaussian.size(), 0);
  models.gaussian.mean = Eigen::VectorXf::LinSpaced(30, -1, 1);
  models.gaussian.rows = faces::BilinearModel::Core::Identity(3, 30);
  models.gaussian.num_symmetric = 2;
  EXPECT_EQ(WriteFittedModels(folder / "run", models).count("gaussian.safetensors"), 1u);
  const FittedModels again = ReadFittedModels(folder / "run");
  EXPECT_EQ(again.gaussian.mean, models.gaussian.mean);
  EXPECT_EQ(again.gaussian.rows, models.gaussian.rows);
  EXPECT_EQ(again.gaussian.num_symmetric, 2);
}

TEST(FittedModels, ChecksumsAreThoseOfTheFiles) {
  const TempDir folder;
  const auto checksums = WriteFittedModels(folder.path(), ModelsOfTenVertices(4));
  EXPECT_EQ(checksums.size(), 3u);
  for (const auto& [file, checksum] : checksums) EXPECT_EQ(checksum, Sha256OfFile(folder / file)) << file;
}

TEST(FittedModels, AMissingOrTruncatedFileIsNamed) {
  const TempDir folder;
  WriteFittedModels(folder.path(), ModelsOfTenVertices(4));
  std::filesystem::resize_file(folder / "basis.safetensors", 100);
  testing::ExpectError([&] { ReadFittedModels(folder.path()); }, "basis.safetensors");
  std::filesystem::remove(folder / "curves.safetensors");
  testing::ExpectError([&] { ReadFittedModels(folder.path()); }, "curves.safetensors");
}

}  // namespace
}  // namespace daumier::sketch
