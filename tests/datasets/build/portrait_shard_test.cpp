#include "datasets/build/portrait_shard.h"

#include "core/files.h"
#include "core/safetensors.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

// PortraitDatabaseTest reads shards back; here is what their bytes are.
namespace daumier::datasets {
namespace {

using testing::ExpectError;

PortraitRecord ShardRecord(const std::string& picture, const std::string& mask) {
  PortraitRecord record;
  record.picture = picture;
  record.mask = mask;
  record.landmarks[3] = 2.5f;
  record.person = 4;
  return record;
}

std::vector<int64_t> Offsets(const SafetensorsFile& shard, const std::string& name) {
  const auto values = shard.at(name).As<int64_t>();
  return {values.begin(), values.end()};
}

TEST(PortraitShard, FilesLieOneAfterTheOtherAtTheirOffsets) {
  const testing::TempDir folder;
  const auto path = folder / "a.safetensors";
  WritePortraitShard(path, {ShardRecord("abc", "x"), ShardRecord("", "yz"), ShardRecord("de", "")});
  const SafetensorsFile shard(path);
  EXPECT_EQ(Offsets(shard, "picture_offsets"), (std::vector<int64_t>{0, 3, 3, 5}));
  EXPECT_EQ(Offsets(shard, "mask_offsets"), (std::vector<int64_t>{0, 1, 3, 3}));
  EXPECT_TRUE(std::ranges::equal(shard.at("pictures").As<uint8_t>(), std::string_view("abcde")));
  EXPECT_TRUE(std::ranges::equal(shard.at("masks").As<uint8_t>(), std::string_view("xyz")));
  EXPECT_EQ(shard.at("landmarks").shape, (std::vector<int64_t>{3, 68, 2}));
  EXPECT_EQ(shard.at("landmarks").As<float>()[136 + 3], 2.5f);
  EXPECT_EQ(shard.at("persons").As<int32_t>()[2], 4);
  EXPECT_FALSE(shard.contains("vertices"));
}

TEST(PortraitShard, VerticesAreThousandthsOfACentimetreLowByteFirst) {
  const testing::TempDir folder;
  PortraitRecord record = ShardRecord("a", "b");
  record.vertices.resize(1, 3);
  record.vertices << -1, 0.0014, 32.767;
  WritePortraitShard(folder / "a.safetensors", {record});
  const SafetensorsFile shard(folder / "a.safetensors");
  EXPECT_EQ(shard.at("vertices").shape, (std::vector<int64_t>{1, 1, 3, 2}));
  // -1000 = 0xfc18, 1, 32767 = 0x7fff.
  EXPECT_TRUE(std::ranges::equal(shard.at("vertices").As<uint8_t>(),
                                 std::array<uint8_t, 6>{0x18, 0xfc, 0x01, 0x00, 0xff, 0x7f}));
}

TEST(PortraitShard, EqualRecordsGiveEqualBytesAndTheirChecksum) {
  const testing::TempDir folder;
  std::vector<PortraitRecord> records = {ShardRecord("abc", "x"), ShardRecord("d", "y")};
  const std::string checksum = WritePortraitShard(folder / "a.safetensors", records);
  EXPECT_EQ(WritePortraitShard(folder / "b.safetensors", records), checksum);
  EXPECT_EQ(ReadFile(folder / "a.safetensors"), ReadFile(folder / "b.safetensors"));
  EXPECT_EQ(Sha256(ReadFile(folder / "a.safetensors")), checksum);
  records[1].eye_size = 0.5f;
  EXPECT_NE(WritePortraitShard(folder / "b.safetensors", records), checksum);
}

TEST(PortraitShard, VerticesFarAwayOrOfSomeRecordsAloneAreRefused) {
  const testing::TempDir folder;
  const auto path = folder / "a.safetensors";
  PortraitRecord record = ShardRecord("a", "b");
  record.vertices = geometry::Points::Constant(2, 3, -32.768);
  ExpectError([&] { WritePortraitShard(path, {record}); }, "within 32.767 cm");
  record.vertices.setZero();
  ExpectError([&] { WritePortraitShard(path, {record, ShardRecord("a", "b")}); }, "of 2 and of 0 vertices");
  ExpectError([&] { WritePortraitShard(path, {ShardRecord("a", "b"), record}); }, "of 0 and of 2 vertices");
  ExpectError([&] { WritePortraitShard(path, {}); }, "a shard without portraits");
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace daumier::datasets
