#include "fuzz/targets.h"

#include "core/files.h"
#include "core/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

namespace daumier::fuzz {

void PrintTo(const Target& target, std::ostream* out) {
  *out << target.name;
}

namespace {

std::vector<std::filesystem::path> SeedsOf(const Target& target) {
  const auto folder = testing::SourceRoot() / "tests/fuzz/seeds" / target.name;
  std::vector<std::filesystem::path> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) seeds.push_back(entry.path());
  std::sort(seeds.begin(), seeds.end());
  return seeds;
}

class FuzzTarget : public ::testing::TestWithParam<Target> {};

TEST_P(FuzzTarget, ReadsItsSeeds) {
  testing::AllowWarnings();
  const testing::TempDir folder;
  const auto seeds = SeedsOf(GetParam());
  ASSERT_FALSE(seeds.empty());
  for (const auto& seed : seeds) {
    std::filesystem::copy_file(seed, folder / GetParam().file, std::filesystem::copy_options::overwrite_existing);
    EXPECT_NO_THROW(GetParam().read(folder / GetParam().file)) << seed;
  }
}

TEST_P(FuzzTarget, SurvivesDamage) {
  const testing::TempDir folder;
  testing::AllowWarnings();
  Rng rng(3);
  for (const auto& seed : SeedsOf(GetParam())) {
    const std::string bytes = ReadFile(seed);
    for (int i = 0; i < 40; ++i) {
      std::string damaged = bytes.substr(0, i % 4 == 0 ? rng.Below(bytes.size()) : bytes.size());
      for (uint64_t flip = 0; flip < 1 + rng.Below(4) && !damaged.empty(); ++flip)
        damaged[rng.Below(damaged.size())] = static_cast<char>(rng.Below(256));
      EXPECT_NO_THROW(ReadBytes(GetParam(), damaged, folder.path())) << seed << ", copy " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzTarget, ::testing::ValuesIn(Targets().begin(), Targets().end()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FindTarget, NamesTheTargetsThatThereAre) {
  EXPECT_EQ(FindTarget("svg").file, "a.svg");
  testing::ExpectError([] { FindTarget("exe"); }, "svg, quickdraw");
}

}  // namespace
}  // namespace daumier::fuzz
