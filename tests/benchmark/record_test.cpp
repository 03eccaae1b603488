#include "benchmark/record.h"

#include "core/files.h"
#include "core/npy.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_kit.h"

#include <gtest/gtest.h>

namespace daumier::benchmark {
namespace {

using testing::ExpectError;
using testing::SmallKit;

TEST(CheckKit, NamesWhatIsMissingChangedAndExtra) {
  const testing::TempDir folder;
  std::filesystem::copy(SmallKit(), folder / "kit", std::filesystem::copy_options::recursive);
  EXPECT_TRUE(CheckKit(folder / "kit").none());
  const std::string changed = "inputs/test/caricatures/person-008-a.pts", missing = "landmarks.txt";
  WriteFileAtomically(folder / "kit" / changed, "0 0\n");
  std::filesystem::remove(folder / "kit" / missing);
  WriteFileAtomically(folder / "kit/notes.md", "mine");
  const KitDamage damage = CheckKit(folder / "kit");
  EXPECT_EQ(damage.changed, std::vector<std::string>{changed});
  EXPECT_EQ(damage.missing, std::vector<std::string>{missing});
  EXPECT_EQ(damage.extra, std::vector<std::string>{"notes.md"});
}

TEST(KitRecord, IsReadAsItWasWritten) {
  const KitRecord record = ReadRecord(SmallKit() / kRecordFile);
  EXPECT_EQ(record.name, "small");
  EXPECT_EQ(record.entries.size(), 10u * 8) << "eight kinds of files a person";
  EXPECT_TRUE(record.entries.contains("inputs/test/drawings/person-009.png"));
  EXPECT_EQ(RecordText(record), ReadFile(SmallKit() / kRecordFile));
  const RecordComparison same = CompareRecords(record, record);
  EXPECT_EQ(same.num_same, 80);
  EXPECT_EQ(same.largest_share, 0);
  ExpectError([] { ReadRecord(SmallKit() / "manifest.json"); }, "no record of a kit");
}

TEST(CompareRecords, TellsRoundingFromOtherContent) {
  const KitRecord record = ReadRecord(SmallKit() / kRecordFile);
  const std::string key = "truth/test/drawings/person-009.npy";
  KitRecord other = record;
  other.entries[key].sha256 = "0";
  other.entries[key].fingerprint[1] += 0.5 * FingerprintTolerance(".npy");
  RecordComparison comparison = CompareRecords(record, other);
  EXPECT_EQ(comparison.equivalent, std::vector<std::string>{key});
  EXPECT_TRUE(comparison.different.empty());
  EXPECT_NEAR(comparison.largest_share, 0.5, 1e-6);
  other.entries[key].fingerprint[1] += FingerprintTolerance(".npy");
  other.entries.erase("inputs/train/drawings/person-000.png");
  other.entries["inputs/train/drawings/person-100.png"] = {};
  comparison = CompareRecords(record, other);
  EXPECT_EQ(comparison.different, (std::vector<std::string>{"inputs/train/drawings/person-000.png", key,
                                                            "inputs/train/drawings/person-100.png"}));
}

TEST(Fingerprint, ChangesWithPlaceAndOrderOfNumbers) {
  const testing::TempDir folder;
  const auto of = [&](const std::vector<float>& numbers) {
    WriteNpy(folder / "a.npy", {int64_t(numbers.size()) / 3, 3, numbers});
    return Fingerprint(folder / "a.npy");
  };
  const std::vector<double> print = of({1, 2, 3, 4, 5, 6});
  EXPECT_NEAR(print[0], 3.5, 1e-9) << "the mean";
  EXPECT_NE(print, of({1, 2, 3, 4, 6, 5}));
  WriteFileAtomically(folder / "a.pts", "version: 1\nn_points: 68\n{\n1 2\n}\n");
  EXPECT_NEAR(Fingerprint(folder / "a.pts")[0], (1 + 68 + 1 + 2) / 4.0, 1e-9);
}

}  // namespace
}  // namespace daumier::benchmark
