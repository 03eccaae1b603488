#include "core/folder_lock.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;

TEST(FolderLock, MakesTheFolderAndLeavesNothingInIt) {
  const testing::TempDir folder;
  { const FolderLock lock(folder / "a/b"); }
  EXPECT_TRUE(fs::is_empty(folder / "a/b"));
}

TEST(FolderLock, LetsOneThreadInAtATime) {
  const testing::TempDir folder;
  std::atomic<int> num_inside = 0, num_rounds = 0;
  std::atomic<bool> overlapped = false;
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int round = 0; round < 5; ++round) {
        const FolderLock lock(folder / "out");
        if (++num_inside > 1) overlapped = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        --num_inside;
        ++num_rounds;
      }
    });
  threads.clear();
  EXPECT_FALSE(overlapped);
  EXPECT_EQ(num_rounds, 20);
}

TEST(FolderLock, ComesBackWhenTheOtherWriterHasRemovedTheFolder) {
  const testing::TempDir folder;
  const fs::path out = folder / "out";
  std::optional<FolderLock> first(std::in_place, out);
  std::atomic<bool> has_lock = false;
  std::jthread second([&] {
    const FolderLock lock(out);
    has_lock = fs::is_directory(out);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  fs::remove(out);
  EXPECT_FALSE(has_lock);
  first.reset();
  second.join();
  EXPECT_TRUE(has_lock);
}

TEST(FolderLock, EndsWithItsProcess) {
  const testing::TempDir folder;
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder / "out");
    _exit(0);  // Without the destructor.
  }
  ASSERT_GT(child, 0);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  const FolderLock lock(folder / "out");
}

TEST(FolderLock, StopsWaitingWhenCancelled) {
  const testing::TempDir folder;
  const FolderLock first(folder / "out");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(FolderLock(folder / "out", Task(stop.get_token())), Cancelled);
}

TEST(FolderLock, RefusesAFileInThePlaceOfTheFolder) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "out", "a file");
  testing::ExpectError([&] { FolderLock(folder / "out"); }, "cannot create folder");
}

}  // namespace
}  // namespace daumier
