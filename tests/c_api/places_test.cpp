#include "c_api/places.h"

#include "core/error.h"
#include "core/weights_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

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
