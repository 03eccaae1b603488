#include "core/folder_cache.h"

#include "core/error.h"
#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;

/// Counts how often it is opened.
struct Database {
  explicit Database(const fs::path& folder) : seed(ReadManifest(folder, "faces").seed) { ++num_opened; }
  uint64_t seed;
  inline static int num_opened = 0;
};

class FolderCacheTest : public ::testing::Test {
 protected:
  FolderCacheTest() { Database::num_opened = 0; }
  void Write(const char* name, uint64_t seed) const {
    MakeDirectory(folder_ / name);
    Manifest manifest{.kind = "faces", .verb = "dataset faces"};
    manifest.seed = seed;
    WriteManifest(folder_ / name, manifest);
  }

  const testing::TempDir folder_;
  FolderCache cache_;
};

TEST_F(FolderCacheTest, OpensAFolderOnceUnderAnyOfItsPaths) {
  Write("a", 1);
  Write("b", 2);
  const Database& first = cache_.Open<Database>(folder_ / "a");
  EXPECT_EQ(&cache_.Open<Database>(folder_ / "b/../a"), &first);
  EXPECT_EQ(cache_.Open<Database>(folder_ / "b").seed, 2u);
  EXPECT_EQ(&cache_.Open<Database>(folder_ / "a"), &first);
  EXPECT_EQ(Database::num_opened, 2);
  EXPECT_EQ(cache_.size(), 2u);
}

TEST_F(FolderCacheTest, OpensAFolderAgainIfItsManifestHasChanged) {
  Write("a", 1);
  const Database& first = cache_.Open<Database>(folder_ / "a");
  Write("a", 3);
  EXPECT_EQ(cache_.Open<Database>(folder_ / "a").seed, 3u);
  EXPECT_EQ(first.seed, 1u) << "references stay valid";
}

TEST_F(FolderCacheTest, ThrowsWhatTheTypeThrowsAndKeepsNothing) {
  for (int call = 0; call < 2; ++call)
    testing::ExpectError([&] { cache_.Open<Database>(folder_ / "absent"); }, "absent");
  EXPECT_EQ(cache_.size(), 0u);
}

TEST_F(FolderCacheTest, SeveralThreadsShareOneOpening) {
  Write("a", 1);
  std::vector<std::jthread> threads;
  for (int i = 0; i < 8; ++i) threads.emplace_back([&] { EXPECT_EQ(cache_.Open<Database>(folder_ / "a").seed, 1u); });
  threads.clear();
  EXPECT_EQ(Database::num_opened, 1);
}

}  // namespace
}  // namespace daumier
