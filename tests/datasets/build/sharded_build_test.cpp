#include "datasets/build/sharded_build.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::TempDir;

std::map<std::string, std::string> Contents(const fs::path& directory) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file()) contents[fs::relative(entry.path(), directory)] = ReadFile(entry.path());
  }
  return contents;
}

/// Ten small shards and one other file. `num_written` counts the shards that are written.
struct Build : ShardedBuild {
  std::atomic<int> num_written = 0;
  int fails_at = -1;

  Build() {
    manifest.kind = "numbers";
    manifest.verb = "dataset numbers";
    manifest.config = {{"count", 10}, {"nested", {{"width", 2.5}}}};
    num_shards = 10;
    unit = "numbers";
    shard_name = [](int shard) { return fmt::format("shards/{}.txt", shard); };
    write_shard = [this](int shard, const fs::path& file) {
      DAUMIER_CHECK(shard != fails_at, "shard {} fails", shard);
      ++num_written;
      const std::string bytes = std::string(1000 + shard, static_cast<char>('a' + shard));
      WriteFileAtomically(file, bytes);
      return Sha256(bytes);
    };
    write_rest = [](const fs::path& directory) {
      WriteFileAtomically(directory / "rest.txt", "rest");
      return std::map<std::string, std::string>{{"rest.txt", Sha256("rest")}};
    };
  }
};

class ShardedBuildTest : public ::testing::Test {
 protected:
  void SetUp() override { BuildShards(whole_, build_); }
  TempDir folder_;
  fs::path whole_ = folder_ / "whole", other_ = folder_ / "other";
  Build build_;
};

TEST_F(ShardedBuildTest, ManifestNamesEveryFile) {
  const Manifest manifest = ReadManifest(whole_, "numbers");
  EXPECT_EQ(manifest.checksums.size(), 11u);
  EXPECT_NO_THROW(VerifyChecksums(whole_, manifest));
  EXPECT_EQ(Contents(whole_).size(), 12u);
}

TEST_F(ShardedBuildTest, AFailedBuildResumesAndEndsWithTheSameBytes) {
  Build build;
  build.fails_at = 6;
  ExpectError([&] { BuildShards(other_, build); }, "shard 6 fails");
  EXPECT_FALSE(fs::exists(other_ / "manifest.json"));
  build.fails_at = -1;
  build.num_written = 0;
  BuildShards(other_, build);
  EXPECT_LT(build.num_written, 10);  // 6..9; what another thread wrote ahead was not recorded.
  EXPECT_EQ(Contents(other_), Contents(whole_));
}

TEST_F(ShardedBuildTest, AShardThatWasDamagedInBetweenIsWrittenAgain) {
  Build build;
  build.fails_at = 6;
  ExpectError([&] { BuildShards(other_, build); }, "shard 6 fails");
  WriteFileAtomically(other_ / "shards/2.txt", "damaged");
  fs::remove(other_ / "shards/3.txt");
  build.fails_at = -1;
  BuildShards(other_, build);
  EXPECT_EQ(Contents(other_), Contents(whole_));
}

TEST_F(ShardedBuildTest, CancellationEndsItCleanlyAndSaysHowToResume) {
  std::stop_source source;
  Build build;
  const auto write = build.write_shard;
  build.write_shard = [&](int shard, const fs::path& file) {
    if (shard == 4) source.request_stop();
    return write(shard, file);
  };
  ExpectError([&] { BuildShards(other_, build, Task(source.get_token())); }, "the same command resumes the build");
  build.write_shard = write;
  build.num_written = 0;
  BuildShards(other_, build);
  EXPECT_GT(build.num_written, 0);
  EXPECT_LT(build.num_written, 10);
  EXPECT_EQ(Contents(other_), Contents(whole_));
}

TEST_F(ShardedBuildTest, ReportsItsProgress) {
  std::mutex mutex;
  std::vector<std::string> reports;
  const Task task({}, [&](const TaskProgress& progress) {
    const std::lock_guard lock(mutex);
    reports.push_back(fmt::format("{}/{} {}", progress.done, progress.total, progress.unit));
  });
  BuildShards(other_, build_, task);
  ASSERT_GE(reports.size(), 2u);
  EXPECT_TRUE(reports.front().starts_with("0/")) << reports.front();
  EXPECT_NE(std::find(reports.begin(), reports.end(), "10/10 numbers"), reports.end());
}

TEST_F(ShardedBuildTest, DependentShardsAreBegunWhenTheOthersAreThere) {
  Build build;
  build.num_independent = 7;
  std::atomic<int> num_early = 0;
  build.write_shard = [&, write = build.write_shard](int shard, const fs::path& file) {
    if (shard >= 7) {
      for (int other = 0; other < 7; ++other) num_early += !fs::exists(other_ / build.shard_name(other));
    }
    return write(shard, file);
  };
  BuildShards(other_, build);
  EXPECT_EQ(num_early, 0);
  EXPECT_EQ(Contents(other_), Contents(whole_));
}

TEST_F(ShardedBuildTest, AFinishedBuildIsOnlyVerified) {
  const auto before = Contents(whole_);
  build_.num_written = 0;
  BuildShards(whole_, build_);
  EXPECT_EQ(build_.num_written, 0);
  EXPECT_EQ(Contents(whole_), before);
  WriteFileAtomically(whole_ / "shards/5.txt", "damaged");
  ExpectError([&] { BuildShards(whole_, build_); }, "shards/5.txt");
}

TEST_F(ShardedBuildTest, AnotherBuildInTheFolderIsRefusedAndNamed) {
  Build build;
  build.manifest.config["nested"]["width"] = 3.5;
  ExpectError([&] { BuildShards(whole_, build); }, "config/nested/width is 2.5 there and 3.5 here");
  build.fails_at = 0;
  ExpectError([&] { BuildShards(other_, build); }, "shard 0 fails");
  ExpectError([&] { BuildShards(other_, build_); }, "config/nested/width is 3.5 there and 2.5 here");
  build_.manifest.config["more"] = 1;
  ExpectError([&] { BuildShards(whole_, build_); }, "config/more is absent there and 1 here");
}

TEST_F(ShardedBuildTest, AFolderOfSomethingElseIsRefused) {
  MakeDirectory(other_);
  WriteFileAtomically(other_ / "thesis.txt", "important");
  ExpectError([&] { BuildShards(other_, build_); }, "is not empty and holds no earlier numbers");
  EXPECT_EQ(Contents(other_).size(), 1u);
  ExpectError([&] { BuildShards(folder_ / "other/thesis.txt", build_); }, "thesis.txt");
}

TEST_F(ShardedBuildTest, AMalformedRecordIsRefused) {
  MakeDirectory(other_);
  WriteFileAtomically(other_ / "building.json", "{\"plan\": 3");
  ExpectError([&] { BuildShards(other_, build_); }, "building.json: malformed");
  WriteFileAtomically(other_ / "building.json", "{\"format_version\": 2}");
  ExpectError([&] { BuildShards(other_, build_); }, "unknown format version 2");
}

TEST(ShardedBuild, FinishMayRemoveAndRenameShards) {
  const TempDir folder;
  Build build;
  build.finish = [](const fs::path& directory, Manifest& manifest) {
    fs::rename(directory / "shards/9.txt", directory / "shards/0.txt");
    manifest.checksums["shards/0.txt"] = manifest.checksums.at("shards/9.txt");
    manifest.checksums.erase("shards/9.txt");
  };
  BuildShards(folder / "out", build);
  const Manifest manifest = ReadManifest(folder / "out", "numbers");
  EXPECT_EQ(manifest.checksums.size(), 10u);  // Nine shards and the rest.
  VerifyChecksums(folder / "out", manifest);
  // Stopped in it: shards that are not as recorded are written again.
  build.finish = [&](const fs::path& directory, Manifest&) {
    fs::remove(directory / "shards/3.txt");
    throw Error("stopped");
  };
  ExpectError([&] { BuildShards(folder / "other", build); }, "stopped");
  build.num_written = 0;
  build.finish = nullptr;
  BuildShards(folder / "other", build);
  EXPECT_EQ(build.num_written, 1);
  VerifyChecksums(folder / "other", ReadManifest(folder / "other", "numbers"));
}

}  // namespace
}  // namespace daumier::datasets
