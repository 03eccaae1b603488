#include "systems/shipped_weights.h"

#include "core/error.h"
#include "core/files.h"
#include "core/program_folder.h"
#include "core/weights_folder.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

System SystemOfTest(std::string_view name, std::vector<std::string> extensions, int rank) {
  System system{};
  system.name = name;
  system.input_extensions = std::move(extensions);
  system.shipped_rank = rank;
  system.open = [](const fs::path&, const Device&, const Json&) { return std::unique_ptr<Predictor>(); };
  return system;
}

class ShippedWeightsTest : public ::testing::Test {
 protected:
  ShippedWeightsTest() {
    systems_ = {SystemOfTest("landmarks", {".png", ".jpg"}, 1), SystemOfTest("portrait", {".png", ".jpg"}, 2),
                SystemOfTest("sketch", {".svg", ".png"}, 0)};
    places_ = {folder_ / "nowhere", folder_ / "weights", folder_ / "others"};
  }

  void Write(const fs::path& name, const std::string& system) const {
    MakeDirectory(folder_ / name);
    Manifest manifest{.kind = kWeightsKind, .verb = "export"};
    manifest.details = {{"system", system}};
    WriteManifest(folder_ / name, manifest);
  }
  fs::path For(const std::vector<fs::path>& inputs) const {
    return WeightsFor(inputs, systems_, ListWeights(places_), places_);
  }

  const testing::TempDir folder_;
  std::vector<System> systems_;
  std::vector<fs::path> places_;
};

TEST_F(ShippedWeightsTest, AreThoseOfTheFirstPlaceThatHoldsAny) {
  EXPECT_TRUE(ListWeights(places_).empty());
  Write("others/sketch-ict", "sketch");
  EXPECT_EQ(ListWeights(places_).size(), 1U);
  Write("weights/portrait", "portrait");
  Write("weights/face-ict", "face model");
  MakeDirectory(folder_ / "weights/empty");
  WriteFileAtomically(folder_ / "weights/letter.txt", "precious");
  MakeDirectory(folder_ / "weights/run");
  WriteManifest(folder_ / "weights/run", {.kind = "run", .verb = "train"});
  const std::vector<ShippedWeights> shipped = ListWeights(places_);
  ASSERT_EQ(shipped.size(), 2U);
  EXPECT_EQ(shipped[0].name(), "face-ict");
  EXPECT_EQ(shipped[1].name(), "portrait");
  EXPECT_EQ(shipped[1].system, "portrait");
  EXPECT_EQ(shipped[1].directory, folder_ / "weights/portrait");
}

TEST_F(ShippedWeightsTest, NumbersWithoutAReadableManifestAreDamaged) {
  Write("weights/landmarks", "landmarks");
  MakeDirectory(folder_ / "weights/portrait");
  WriteFileAtomically(folder_ / "weights/portrait" / kWeightsNetwork, "numbers");
  testing::ExpectError([&] { ListWeights(places_); }, "portrait: weights whose manifest.json is missing or malformed");
  WriteFileAtomically(folder_ / "weights/portrait/manifest.json", "{\"kind\": \"wei");
  testing::ExpectError([&] { ListWeights(places_); }, "portrait: weights whose manifest.json is missing or malformed");
}

TEST_F(ShippedWeightsTest, FollowFromTheInputsByRank) {
  Write("weights/landmarks", "landmarks");
  EXPECT_EQ(For({"a.png", "b.JPG"}), folder_ / "weights/landmarks");
  Write("weights/sketch-ict", "sketch");
  Write("weights/face-ict", "face model");
  Write("weights/wax", "a task of a newer version");
  EXPECT_EQ(For({"a.png"}), folder_ / "weights/landmarks");
  EXPECT_EQ(For({"a.png", "b.svg"}), folder_ / "weights/sketch-ict");
  Write("weights/portrait", "portrait");
  EXPECT_EQ(For({"a.png"}), folder_ / "weights/portrait");
  MakeDirectory(folder_ / "pictures");
  WriteFileAtomically(folder_ / "pictures/a.png", "a");
  WriteFileAtomically(folder_ / "pictures/letter.txt", "b");
  EXPECT_EQ(For({folder_ / "pictures"}), folder_ / "weights/portrait");
  EXPECT_EQ(For({folder_ / "pictures", "b.svg"}), folder_ / "weights/sketch-ict");
}

TEST_F(ShippedWeightsTest, AnInputThatNoneReadsIsNamedWithWhatIsThere) {
  ExpectError([&] { For({"a.png"}); }, "no shipped weights read a.png (no weights are there; looked in " +
                                           (folder_ / "nowhere").string() + ", " + (folder_ / "weights").string());
  ExpectError([&] { For({"a.png"}); }, "Set DAUMIER_WEIGHTS to the folder");
  Write("weights/landmarks", "landmarks");
  Write("weights/portrait", "portrait");
  ExpectError(
      [&] {
        For({"a.png", "b.svg"});
      },
      "no shipped weights read b.svg (there are landmarks, portrait in " + (folder_ / "weights").string());
  EXPECT_THROW(For({"a.png", "b.svg"}), UsageError);
  systems_[0].open = nullptr;
  systems_[1].open = nullptr;
  ExpectError([&] { For({"a.png"}); }, "no shipped weights read a.png");
}

TEST_F(ShippedWeightsTest, AreNamedByTheirNameOrTheirFolder) {
  Write("weights/portrait", "portrait");
  Write("mine", "portrait");
  const std::vector<ShippedWeights> shipped = ListWeights(places_);
  EXPECT_EQ(WeightsNamed("portrait", shipped, places_), folder_ / "weights/portrait");
  EXPECT_EQ(WeightsNamed((folder_ / "mine").string(), shipped, places_), folder_ / "mine");
  ExpectError([&] { WeightsNamed("portrat", shipped, places_); },
              "there are no weights 'portrat' (there are portrait in " + (folder_ / "weights").string());
  ExpectError([&] { WeightsNamed("portrait", {}, places_); }, "there are no weights 'portrait' (no weights are there");
}

TEST_F(ShippedWeightsTest, AreSearchedWhereTheVariableSaysElseAboveTheProgram) {
  const char* const before = std::getenv("DAUMIER_WEIGHTS");
  const std::string kept = before != nullptr ? before : "";
  setenv("DAUMIER_WEIGHTS", "/opt/weights", 1);
  EXPECT_EQ(WeightsPlaces(), std::vector<fs::path>{"/opt/weights"});
  unsetenv("DAUMIER_WEIGHTS");
  const std::vector<fs::path> places = WeightsPlaces();
  if (before != nullptr) setenv("DAUMIER_WEIGHTS", kept.c_str(), 1);
  ASSERT_GE(places.size(), 4U);
  EXPECT_EQ(places[0], ProgramFolder() / "weights");
  EXPECT_EQ(places[2], ProgramFolder().parent_path() / "weights");
  EXPECT_EQ(places[3], ProgramFolder().parent_path() / "share/daumier/weights");
}

}  // namespace
}  // namespace daumier::systems
