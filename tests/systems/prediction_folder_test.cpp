#include "systems/prediction_folder.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

/// Results of two files, of inputs that need not exist.
class PredictionFolderTest : public ::testing::Test {
 protected:
  PredictionFolderTest() {
    system_.name = "landmarks";
    system_.result_files = {".pts", ".png"};
    MakeDirectory(run());
    WriteManifest(run(), {.kind = "run", .verb = "train"});
    for (const char* name : {"anna", "bert"}) inputs_.inputs.push_back({name, std::string(name) + ".jpg", {}});
  }

  fs::path run() const { return folder_ / "run"; }
  fs::path out() const { return folder_ / "out"; }
  PredictionFolder Open(const Task& task = {}) const {
    return PredictionFolder(system_, out(), run(), Json::object(), inputs_, task);
  }
  const PredictionInput& anna() const { return inputs_.inputs[0]; }
  const PredictionInput& bert() const { return inputs_.inputs[1]; }
  Manifest Written() const { return ReadManifest(out(), "predictions"); }
  std::set<std::string> Names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(out())) names.insert(entry.path().filename().string());
    return names;
  }

  static std::vector<std::string> WriteBoth(const std::string& name, const fs::path& staging) {
    WriteFileAtomically(staging / (name + ".pts"), "points");
    WriteFileAtomically(staging / (name + ".png"), "picture");
    return {name + ".pts", name + ".png"};
  }
  static PredictionFolder::Writer Both(const PredictionInput& input) {
    return [name = input.name](const fs::path& staging) { return WriteBoth(name, staging); };
  }
  /// As on a full disk: the second file cannot be written.
  static PredictionFolder::Writer FullDisk(const PredictionInput& input) {
    return [name = input.name](const fs::path& staging) -> std::vector<std::string> {
      WriteFileAtomically(staging / (name + ".pts"), "half");
      throw Error("no space left on the disk");
    };
  }

  const testing::TempDir folder_;
  System system_;
  PredictionInputs inputs_;
};

TEST_F(PredictionFolderTest, TheManifestListsAResultBeforeItIsThere) {
  PredictionFolder folder = Open();
  folder.Add(anna(), Json::object(), {}, [&](const fs::path& staging) {
    EXPECT_EQ(Written().details.at(kUnfinishedFiles), Json({"anna.png", "anna.pts"}));
    return WriteBoth("anna", staging);
  });
  EXPECT_FALSE(Written().details.contains(kUnfinishedFiles));
  EXPECT_EQ(Names(), (std::set<std::string>{"anna.png", "anna.pts", "manifest.json"}));
}

TEST_F(PredictionFolderTest, NamesThatNoFileCanHaveAreRefusedAtOnce) {
  inputs_.inputs.push_back({std::string(248, 'n'), "long.jpg", {}});
  testing::ExpectError([&] { Open(); }, "a name of 252 bytes (expected at most 251). Rename the input");
  EXPECT_FALSE(fs::exists(out()));
  inputs_.inputs.back().name.pop_back();
  EXPECT_NO_THROW(Open().Add(inputs_.inputs.back(), Json::object(), {}, Both(inputs_.inputs.back())));
  inputs_.inputs.back().name = "two\nlines";
  testing::ExpectError([&] { Open(); }, "the result two?lines");
}

TEST_F(PredictionFolderTest, AFailedFirstResultLeavesNoFolder) {
  PredictionFolder folder = Open();
  EXPECT_THROW(folder.Add(anna(), Json::object(), {}, FullDisk(anna())), Error);
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(PredictionFolderTest, AFolderThatWasThereStays) {
  MakeDirectory(out());
  PredictionFolder folder = Open();
  EXPECT_THROW(folder.Add(anna(), Json::object(), {}, FullDisk(anna())), Error);
  EXPECT_TRUE(fs::is_empty(out()));
}

TEST_F(PredictionFolderTest, AFailedResultLeavesTheEarlierOneOfItsName) {
  Open().Add(anna(), {{"score", 1}}, {}, Both(anna()));
  const std::string before = ReadFile(out() / "manifest.json");
  PredictionFolder folder = Open();
  EXPECT_THROW(folder.Add(anna(), {{"score", 2}}, {}, FullDisk(anna())), Error);
  EXPECT_EQ(ReadFile(out() / "manifest.json"), before);
  EXPECT_EQ(ReadFile(out() / "anna.pts"), "points");
  EXPECT_EQ(Names(), (std::set<std::string>{"anna.png", "anna.pts", "manifest.json"}));
  EXPECT_NO_THROW(VerifyChecksums(out(), Written()));
}

TEST_F(PredictionFolderTest, AFileThatTheNewResultLacksIsRemoved) {
  Open().Add(anna(), Json::object(), {}, Both(anna()));
  Open().Add(anna(), Json::object(), {}, [](const fs::path& staging) -> std::vector<std::string> {
    WriteFileAtomically(staging / "anna.png", "another");
    return {"anna.png"};
  });
  EXPECT_EQ(Names(), (std::set<std::string>{"anna.png", "manifest.json"}));
  EXPECT_NO_THROW(Open()) << "nothing in it is unknown";
}

TEST_F(PredictionFolderTest, WhatAKilledProgramLeftIsReplaced) {
  MakeDirectory(out() / ".partial");
  WriteFileAtomically(out() / ".partial/anna.pts", "half");
  Manifest manifest{.kind = "predictions", .verb = "predict"};
  manifest.details = {{"system", "landmarks"}, {kUnfinishedFiles, {"anna.png", "anna.pts"}}};
  WriteManifest(out(), manifest);
  PredictionFolder folder = Open();
  folder.Add(bert(), Json::object(), {}, Both(bert()));
  folder.Add(anna(), Json::object(), {}, Both(anna()));
  EXPECT_EQ(Names(), (std::set<std::string>{"anna.png", "anna.pts", "bert.png", "bert.pts", "manifest.json"}));
}

TEST_F(PredictionFolderTest, SeveralWritersKeepTheResultsOfAll) {
  std::vector<std::jthread> threads;
  for (const PredictionInput& input : inputs_.inputs)
    threads.emplace_back([&] { Open().Add(input, {{"score", 1}}, {}, Both(input)); });
  threads.clear();
  const Manifest manifest = Written();
  EXPECT_EQ(manifest.details.at("drawings").size(), 2u);
  EXPECT_EQ(manifest.checksums.size(), 4u);
  EXPECT_NO_THROW(VerifyChecksums(out(), manifest));
}

TEST_F(PredictionFolderTest, FailuresAreListedWithoutFolders) {
  const std::vector<PredictionFailure> failures{{"/somewhere/carl.jpg", "/somewhere/carl.jpg: no face was found"}};
  PredictionFolder folder = Open();
  folder.Finish(failures);
  EXPECT_FALSE(fs::exists(out())) << "there is no result";
  folder.Add(anna(), Json::object(), {}, Both(anna()));
  folder.Finish(failures);
  EXPECT_EQ(Written().details.at("failures"), Json({{{"file", "carl.jpg"}, {"cause", "carl.jpg: no face was found"}}}));
}

}  // namespace
}  // namespace daumier::systems
