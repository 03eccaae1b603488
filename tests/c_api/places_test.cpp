#include "c_api/places.h"

#include "core/error.h"
#include "core/files.h"
#include "core/weights_folder.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace daumier::c_api {
namespace {

namespace fs = std::filesystem;

TEST(CPlaces, ANameIsThatOfShippedWeightsOrAFolder) {
  const fs::path shipped = FolderNamed("sketch-ict");
  EXPECT_TRUE(IsWeightsFolder(shipped));
  EXPECT_EQ(FolderNamed(shipped.c_str()), shipped);
  EXPECT_EQ(ModelNamed(nullptr), ModelNamed("face-ict"));
}

TEST(CPlaces, WhatIsNotThereIsMisuseThatListsWhatIs) {
  for (const char* name : {static_cast<const char*>(nullptr), "", "no-such-weights"})
    EXPECT_THROW(FolderNamed(name), UsageError);
  try {
    FolderNamed("no-such-weights");
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("sketch-ict"), std::string::npos) << error.what();
  }
}

TEST(CPlaces, DamagedWeightsAreInTheWayOfNoOthers) {
  const testing::TempDir place;
  for (const char* name : {"face-ict", "sketch-ict"}) {
    MakeDirectory(place / name);
    fs::copy(FolderNamed(name), place / name, fs::copy_options::recursive);
  }
  WriteFileAtomically(place / "sketch-ict/manifest.json", "{");
  const char* const before = std::getenv("DAUMIER_WEIGHTS");
  setenv("DAUMIER_WEIGHTS", place.path().c_str(), 1);
  EXPECT_EQ(FaceModelNamed(nullptr), place / "face-ict");
  EXPECT_EQ(FolderNamed("face-ict"), place / "face-ict");
  before == nullptr ? unsetenv("DAUMIER_WEIGHTS") : setenv("DAUMIER_WEIGHTS", before, 1);
}

TEST(CPlaces, OnlyWeightsOfAFaceModelAreAFaceModel) {
  EXPECT_EQ(FaceModelNamed("face-ict"), FolderNamed("face-ict"));
  EXPECT_THROW(FaceModelNamed("sketch-ict"), UsageError);
}

TEST(CPlaces, PredictorsAreTheTasksThatPredict) {
  EXPECT_GE(Predictors().size(), 4u);
  for (const systems::System& system : Predictors()) {
    EXPECT_NE(system.open, nullptr) << system.name;
    EXPECT_NE(system.resolve_prediction, nullptr) << system.name;
  }
  EXPECT_EQ(std::ranges::count(Predictors(), "sketch", &systems::System::name), 1);
  EXPECT_EQ(std::ranges::count(Predictors(), "portrait", &systems::System::name), 1);
}

}  // namespace
}  // namespace daumier::c_api
