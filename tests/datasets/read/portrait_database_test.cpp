#include "datasets/read/portrait_database.h"

#include "core/files.h"
#include "datasets/build/portrait_shard.h"
#include "faces/face_database.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

using testing::ExpectError;
using testing::TempDir;

constexpr int kSize = 16;

/// Two shards, of two images and of one, without anything random.
class PortraitDatabaseTest : public ::testing::Test {
 protected:
  void SetUp() override {
    MakeDirectory(directory_ / "shards");
    manifest_.kind = "portraits";
    manifest_.verb = "dataset portraits";
    manifest_.counts = {{"images", 3}, {"shards", 2}};
    manifest_.details = {{"size", kSize},
                         {"focal", 1015.0},
                         {"distance", 100.0},
                         {"centre", {1.0, 2.0, 3.0}},
                         {"vertices", true},
                         {"expressions", {"jaw_open", "smile"}},
                         {"styles", {"smooth", "toon"}}};
    const faces::FaceTemplate face = testing::SyntheticFace();
    manifest_.checksums = faces::WriteFaceTemplate(directory_.path(), face);
    for (int i = 0; i < 3; ++i) records_.push_back(Record(i, face));
    Write();
  }

  static PortraitRecord Record(int i, const faces::FaceTemplate& face) {
    PortraitRecord record;
    record.picture = render::EncodeImage(render::Image(kSize, kSize, 3, uint8_t(40 * i)), render::ImageFormat::kPng);
    render::Image mask(kSize, kSize, 1, 1);
    mask.at(i, 5) = 3;
    record.mask = render::EncodeImage(mask, render::ImageFormat::kPng);
    for (size_t k = 0; k < record.landmarks.size(); ++k) record.landmarks[k] = float(k) + 0.5f * float(i);
    record.visibility.fill(1);
    record.visibility[size_t(i)] = 0;
    record.states = {1.5f * float(i), -0.25f, 7};
    record.expression[1] = 0.125f * float(i);
    record.albedo[79] = -1.5f - float(i);
    record.light[4] = 0.5f + float(i);
    record.pose = {0.1f * float(i), 0.2f, 0.3f, 1, 2, -30};
    record.face = 7 + i;
    record.person = i / 2;
    record.style = i % 2;
    record.skin_tone = i + 3;
    record.is_bald = i == 1;
    record.eye_size = 0.5f * float(i);
    record.vertices = face.neutral * (1 + 0.1 * i);
    return record;
  }

  void Write() {
    manifest_.checksums[PortraitShardName(0)] =
        WritePortraitShard(directory_ / PortraitShardName(0), {records_[0], records_[1]});
    manifest_.checksums[PortraitShardName(1)] = WritePortraitShard(directory_ / PortraitShardName(1), {records_[2]});
    WriteManifest(directory_.path(), manifest_);
  }

  void ExpectRefused(const std::string& message) {
    Write();
    ExpectError([&] { PortraitDatabase(directory_.path()); }, message);
  }

  TempDir directory_;
  Manifest manifest_;
  std::vector<PortraitRecord> records_;
};

TEST_F(PortraitDatabaseTest, EverythingWrittenIsReadBack) {
  const PortraitDatabase database(directory_.path());
  ASSERT_EQ(database.size(), 3);
  EXPECT_EQ(database.image_size(), kSize);
  EXPECT_EQ(database.centre(), geometry::Vector3(1, 2, 3));
  EXPECT_EQ(database.expression_names(), (std::vector<std::string>{"jaw_open", "smile"}));
  for (int i = 0; i < 3; ++i) {
    const PortraitRecord& record = records_[size_t(i)];
    EXPECT_EQ(database.picture(i), render::Image(kSize, kSize, 3, uint8_t(40 * i)));
    EXPECT_EQ(database.mask(i).at(i, 5), 3);
    EXPECT_EQ(database.mask(i).at(i, 6), 1);
    EXPECT_EQ(database.landmarks(i), std::vector<float>(record.landmarks.begin(), record.landmarks.end()));
    EXPECT_EQ(database.visibility(i), std::vector<uint8_t>(record.visibility.begin(), record.visibility.end()));
    EXPECT_EQ(database.states(i), record.states);
    EXPECT_TRUE(std::ranges::equal(database.expression(i), record.expression));
    EXPECT_TRUE(std::ranges::equal(database.albedo(i), record.albedo));
    EXPECT_TRUE(std::ranges::equal(database.light(i), record.light));
    EXPECT_TRUE(std::ranges::equal(database.pose(i), record.pose));
    EXPECT_EQ(database.face(i), record.face);
    EXPECT_EQ(database.person(i), record.person);
    EXPECT_EQ(database.style(i), i == 1 ? "toon" : "smooth");
    EXPECT_EQ(database.skin_tone(i), record.skin_tone);
    EXPECT_EQ(database.is_bald(i), record.is_bald);
    EXPECT_EQ(database.eye_size(i), record.eye_size);
    EXPECT_LE((database.vertices(i) - record.vertices).cwiseAbs().maxCoeff(), 0.0005 + 1e-9) << "half a step";
  }
}

TEST_F(PortraitDatabaseTest, ImagesOutsideAreRefused) {
  const PortraitDatabase database(directory_.path());
  ExpectError([&] { database.picture(3); }, "portrait 3 of a database of 3");
  ExpectError([&] { database.pose(-1); }, "portrait -1");
}

TEST_F(PortraitDatabaseTest, VerticesAreOptional) {
  manifest_.details["vertices"] = false;
  for (PortraitRecord& record : records_) record.vertices.resize(0, 3);
  Write();
  const PortraitDatabase database(directory_.path());
  EXPECT_FALSE(database.has_vertices());
  EXPECT_TRUE(database.has_known_faces());
  ExpectError([&] { database.vertices(0); }, "build it with vertices=true");
}

TEST_F(PortraitDatabaseTest, FacesMayBeUnknown) {
  manifest_.details["known_faces"] = false;
  ExpectRefused("has vertices of faces that are not known");
  manifest_.details["vertices"] = false;
  for (PortraitRecord& record : records_) record.vertices.resize(0, 3);
  for (const char* file : {"template.json", "template.safetensors"}) {
    std::filesystem::remove(directory_ / file);
    manifest_.checksums.erase(file);
  }
  Write();
  const PortraitDatabase database(directory_.path());
  EXPECT_FALSE(database.has_known_faces());
  EXPECT_EQ(database.landmarks(1)[3], 3.5f);
}

TEST_F(PortraitDatabaseTest, ValuesOutOfRangeAreRefused) {
  records_[1].style = 2;
  ExpectRefused("styles holds 2, expected 0 to 1");
  records_[1].style = 0;
  records_[2].skin_tone = 6;
  ExpectRefused("skin_tones holds 6, expected 0 to 5");
  records_[2].skin_tone = 0;
  records_[0].visibility[3] = 2;
  ExpectRefused("visibility holds 2");
  records_[0].visibility[3] = 1;
  records_[0].light[2] = std::numeric_limits<float>::quiet_NaN();
  ExpectRefused("light holds a number that is not finite");
}

TEST_F(PortraitDatabaseTest, OtherCountsThanTheManifestsAreRefused) {
  manifest_.counts["images"] = 4;
  ExpectRefused("its shards hold 3 images, expected 4");
  manifest_.counts["images"] = 3;
  manifest_.counts.erase("shards");
  ExpectRefused("malformed");
  manifest_.counts["shards"] = 2;
  manifest_.details["vertices"] = true;
  for (PortraitRecord& record : records_) record.vertices.conservativeResize(10, 3);
  ExpectRefused("vertices has the shape");
}

TEST_F(PortraitDatabaseTest, PicturesOfAnotherKindAreRefused) {
  records_[0].picture = render::EncodeImage(render::Image(kSize, kSize, 1), render::ImageFormat::kPng);
  records_[0].mask = render::EncodeImage(render::Image(kSize, kSize, 1, 8), render::ImageFormat::kPng);
  records_[1].picture = "no picture";
  Write();
  const PortraitDatabase database(directory_.path());
  ExpectError([&] { database.picture(0); }, "16 x 16 x 1, expected 16 x 16 x 3");
  ExpectError([&] { database.mask(0); }, "a class that is not there");
  ExpectError([&] { database.picture(1); }, "not a readable picture");
}

TEST_F(PortraitDatabaseTest, DamagedShardsAreRefused) {
  const auto path = directory_ / PortraitShardName(1);
  const std::string bytes = ReadFile(path);
  for (size_t size = 0; size < bytes.size(); size += 97) {
    testing::WriteQuickly(path, std::string_view(bytes).substr(0, size));
    EXPECT_THROW(PortraitDatabase(directory_.path(), Checksums::kSkip), Error) << size;
  }
  std::string flipped = bytes;
  flipped.back() ^= 1;
  WriteFileAtomically(path, flipped);
  ExpectError([&] { PortraitDatabase(directory_.path()); }, PortraitShardName(1));
  std::filesystem::remove(path);
  ExpectError([&] { PortraitDatabase(directory_.path()); }, PortraitShardName(1));
}

TEST_F(PortraitDatabaseTest, NewerAndOtherFoldersAreRefused) {
  manifest_.kind = "sketches";
  ExpectRefused("portraits");
  manifest_.kind = "portraits";
  Write();
  Json json = ReadJson(directory_ / "manifest.json");
  json["format_version"] = 99;
  WriteFileAtomically(directory_ / "manifest.json", json.dump());
  ExpectError([&] { PortraitDatabase(directory_.path()); }, "99");
}

}  // namespace
}  // namespace daumier::datasets
