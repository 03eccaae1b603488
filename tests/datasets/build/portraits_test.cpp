#include "datasets/build/portraits.h"

#include "core/config.h"
#include "core/files.h"
#include "datasets/read/portrait_database.h"
#include "faces/controls/face_controls.h"
#include "faces/face_database.h"
#include "render/exr.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_portraits.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <map>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::TempDir;

constexpr int kNumImages = 24;

std::map<std::string, std::string> BytesOf(const fs::path& folder) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes[fs::relative(entry.path(), folder).string()] = ReadFile(entry.path());
  return bytes;
}

class BuildPortraitsTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 3);
    testing::BuildSyntheticPortraits(*folder_ / "faces", *folder_ / "portraits", kNumImages);
  }
  static void TearDownTestSuite() { delete folder_; }

  static inline TempDir* folder_ = nullptr;
};

TEST_F(BuildPortraitsTest, EveryPersonAndLevelIsPortrayed) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  const PortraitDatabase portraits(*folder_ / "portraits");
  ASSERT_EQ(portraits.size(), kNumImages);
  std::map<int, int> num_of_face;
  for (int i = 0; i < portraits.size(); ++i) {
    const faces::FaceId id = faces.id(portraits.face(i));
    EXPECT_EQ(id.person, portraits.person(i));
    EXPECT_EQ(id.expression, 0);
    EXPECT_GE(portraits.person(i), i > 0 ? portraits.person(i - 1) : 0) << "persons are next to each other";
    ++num_of_face[portraits.face(i)];
  }
  EXPECT_EQ(num_of_face.size(), 6u);
  for (const auto& [face, count] : num_of_face) EXPECT_EQ(count, kNumImages / 6) << face;
}

TEST_F(BuildPortraitsTest, CoefficientsGiveTheVertices) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  const PortraitDatabase portraits(*folder_ / "portraits");
  const PortraitExpressions expressions(faces, testing::SyntheticModel());
  const faces::FaceControls controls(faces.face_template());
  for (int i = 0; i < portraits.size(); i += 3) {
    const auto stored = portraits.expression(i);
    Eigen::VectorXf weights(Eigen::Index(expressions.names().size()));
    std::copy_n(stored.begin(), weights.size(), weights.begin());
    const faces::FaceId id = faces.id(portraits.face(i));
    geometry::Points neutral = faces.points(portraits.face(i));
    if (portraits.eye_size(i) != 0) {
      Eigen::VectorXd values = Eigen::VectorXd::Zero(controls.num_values());
      for (int k = 0; k < controls.num_values(); ++k)
        if (controls.value_names()[size_t(k)].starts_with("eye_size_")) values[k] = portraits.eye_size(i);
      neutral = controls.Apply(neutral, values);
    }
    const geometry::Points face = expressions.FaceOf(id.person, id.level, neutral)(weights);
    const geometry::Points expected = face.rowwise() - portraits.centre().transpose();
    EXPECT_LT((portraits.vertices(i) - expected).cwiseAbs().maxCoeff(), 0.0006);
  }
}

TEST_F(BuildPortraitsTest, AnInterruptedBuildEndsWithTheSameBytes) {
  const fs::path stopped = *folder_ / "stopped";
  ExpectError(
      [&] { testing::BuildSyntheticPortraits(*folder_ / "faces", stopped, kNumImages, testing::CancelledTask()); },
      "stopped after");
  testing::BuildSyntheticPortraits(*folder_ / "faces", stopped, kNumImages);
  EXPECT_EQ(BytesOf(stopped), BytesOf(*folder_ / "portraits"));
}

TEST_F(BuildPortraitsTest, AShardAloneHasTheBytesOfThePooledOne) {
  // The calling thread alone makes this one; the shared pool made the others.
  const faces::FaceDatabase faces(*folder_ / "faces");
  const PortraitDatabase portraits(*folder_ / "portraits");
  const PortraitExpressions expressions(faces, testing::SyntheticModel());
  const PortraitsOptions options = testing::SyntheticPortraitsOptions(*folder_ / "faces", kNumImages);
  const PortraitMaker maker(faces.face_template(), options.pictures);
  int num_compared = 0;
  for (int i = 1; i < kNumImages; i += 6) {
    Rng rng = Stream(options.seed, "portrait", uint64_t(i));
    const Eigen::VectorXf weights = expressions.Draw(rng);
    const faces::FaceId id = faces.id(portraits.face(i));
    if (portraits.eye_size(i) != 0) continue;
    ++num_compared;
    const PortraitRecord record = maker.Make(expressions.FaceOf(id.person, id.level)(weights), rng);
    EXPECT_EQ(render::DecodeImage(record.picture, "picture"), portraits.picture(i));
    EXPECT_TRUE(std::ranges::equal(record.landmarks, portraits.landmarks(i)));
  }
  EXPECT_GT(num_compared, 0);
}

TEST_F(BuildPortraitsTest, BuffersAreThoseOfThePosedFace) {
  PortraitsOptions options = testing::SyntheticPortraitsOptions(*folder_ / "faces", 3);
  options.buffers = true;
  options.vertices = false;
  BuildPortraits(testing::SyntheticModel(), options, *folder_ / "buffers");
  const PortraitDatabase portraits(*folder_ / "buffers");
  EXPECT_FALSE(portraits.has_vertices());
  const render::FloatImage buffers = render::DecodeExr(ReadFile(*folder_ / "buffers/buffers/000001.exr"), "exr");
  ASSERT_EQ(buffers.height, 224);
  const auto& depth = buffers.channels.at("Z");
  int num_covered = 0;
  for (int pixel = 0; pixel < 224 * 224; ++pixel) {
    if (std::isinf(depth[size_t(pixel)])) continue;
    ++num_covered;
    const auto at = [&](const char* name) { return buffers.channels.at(name)[size_t(pixel)]; };
    const float x = float(pixel % 224) + 0.5f, y = float(pixel / 224) + 0.5f;
    ASSERT_NEAR(112 + 1015 * at("P.X") / (100 - at("P.Z")), x, 1e-2);
    ASSERT_NEAR(112 - 1015 * at("P.Y") / (100 - at("P.Z")), y, 1e-2);
    ASSERT_NEAR(at("N.X") * at("N.X") + at("N.Y") * at("N.Y") + at("N.Z") * at("N.Z"), 1, 1e-4);
  }
  EXPECT_GT(num_covered, 3000);
  EXPECT_TRUE(portraits.manifest().checksums.contains("buffers/000002.exr"));
}

TEST_F(BuildPortraitsTest, ManifestNamesItsFacesAndTheirLicencesAndNoPath) {
  const Manifest manifest = ReadManifest(*folder_ / "portraits", "portraits");
  EXPECT_EQ(manifest.details.at("faces_data_hash"), DataHash(*folder_ / "faces"));
  EXPECT_EQ(manifest.sources, ReadManifest(*folder_ / "faces", "faces").sources);
  EXPECT_FALSE(manifest.config.contains("faces"));
  EXPECT_EQ(ReadFile(*folder_ / "portraits/manifest.json").find(folder_->path().string()), std::string::npos);
}

TEST_F(BuildPortraitsTest, StoredExpressionsNeedNoModel) {
  PortraitsOptions options = testing::SyntheticPortraitsOptions(*folder_ / "faces", 2);
  options.expressions = "stored";
  BuildPortraits(options, *folder_ / "own");
  EXPECT_EQ(PortraitDatabase(*folder_ / "own").expression_names(),
            (std::vector<std::string>{"jaw_open", "smile", "laugh"}));
}

TEST_F(BuildPortraitsTest, SomeFacesHaveBigEyes) {
  const PortraitDatabase portraits(*folder_ / "portraits");
  int num_big = 0;
  for (int i = 0; i < portraits.size(); ++i) num_big += portraits.eye_size(i) > 0;
  EXPECT_GT(num_big, 0);
  EXPECT_LT(num_big, kNumImages);
}

TEST(PortraitsConfig, EveryFileIsParsed) {
  for (const auto& entry : fs::directory_iterator(testing::SourceRoot() / "configs/portraits")) {
    EXPECT_NO_THROW(ParseOptions<PortraitsOptions>(LoadConfig(entry.path()), entry.path().string())) << entry.path();
  }
}

}  // namespace
}  // namespace daumier::datasets
