#include "systems/training_library.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::systems {
namespace {

using testing::ExpectError;

SystemTraining TrainingNamed(std::string_view name) {
  SystemTraining training{};
  training.name = name;
  return training;
}

TEST(TrainingLibrary, HasTasksByName) {
  TrainingLibrary library{};
  library.systems = {TrainingNamed("sketch"), TrainingNamed("deform")};
  EXPECT_EQ(&library.at("deform"), &library.systems[1]);
  EXPECT_EQ(library.at("sketch").name, "sketch");
}

TEST(TrainingLibrary, AnUnknownTaskIsNamedWithTheKnownOnes) {
  TrainingLibrary library{};
  library.systems = {TrainingNamed("sketch"), TrainingNamed("deform")};
  ExpectError([&] { library.at("caricature"); },
              "the training library has no task 'caricature' (it has sketch, deform)");
}

/// Test binaries without LibTorch have no run path to the library.
TEST(LoadTrainingLibrary, AMissingLibraryIsNamedWithTheCommandThatBuildsIt) {
  ExpectError([] { LoadTrainingLibrary(); }, kTrainingLibraryFile);
  ExpectError([] { LoadTrainingLibrary(); }, "Build it: ./dev build daumier_training");
}

}  // namespace
}  // namespace daumier::systems
