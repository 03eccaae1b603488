#include "core/program_folder.h"

#include "core/files.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

namespace fs = std::filesystem;

TEST(ProgramFolder, HoldsTheProgram) {
  const fs::path program = fs::canonical("/proc/self/exe");
  EXPECT_EQ(ProgramFolder(), program.parent_path());
  EXPECT_TRUE(fs::exists(ProgramFolder() / program.filename()));
}

TEST(NearestAbove, IsTheFolderItselfOrOneAboveIt) {
  const testing::TempDir folder;
  MakeDirectory(folder / "a/b/c");
  MakeDirectory(folder / "a/data");
  MakeDirectory(folder / "data");
  const auto holds = [](const fs::path& path) { return fs::exists(path / "data"); };
  EXPECT_EQ(NearestAbove(folder / "a/b/c", holds), folder / "a");
  EXPECT_EQ(NearestAbove(folder / "a", holds), folder / "a");
  EXPECT_EQ(NearestAbove(folder.path(), holds), folder.path());
  EXPECT_EQ(NearestAbove(folder / "a/b/c", [](const fs::path&) { return false; }), std::nullopt);
  EXPECT_EQ(NearestAbove("", holds), std::nullopt);
}

}  // namespace
}  // namespace daumier
