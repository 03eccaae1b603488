#include "datasets/read/point_database.h"

#include "core/files.h"
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

/// Three faces of one person and a half shard behind it: two samples and two attributes of each.
class PointDatabaseTest : public ::testing::Test {
 protected:
  void SetUp() override {
    MakeDirectory(directory_ / "shards");
    manifest_.kind = "points";
    manifest_.verb = "dataset points";
    manifest_.counts = {{"persons", 1}, {"faces", 3}, {"faces_per_shard", 2}, {"samples", 2}};
    manifest_.details = {{"model_from_cm", {{"scale", 0.1}, {"offset", {1, 2, 3}}}}, {"attributes", {"smile", "chin"}}};
    const faces::FaceTemplate face = testing::SyntheticFace();
    num_triangles_ = int32_t(face.triangles.rows());
    for (const auto& [name, checksum] : faces::WriteFaceTemplate(directory_.path(), face))
      manifest_.checksums[name] = checksum;
    std::vector<float> vertices(size_t(3 * face.num_vertices()));
    for (size_t i = 0; i < vertices.size(); ++i) vertices[i] = float(i);
    SafetensorsWriter open, attributes;
    open.Add<float>("vertices", {face.num_vertices(), 3}, vertices);
    attributes.Add<float>("attributes", {3, 2}, std::vector<float>{1, 2, 3, 4, 5, 6});
    Add(open, "points_template.safetensors");
    Add(attributes, "attributes.safetensors");
    AddShard(first_, {0, 7, 2, num_triangles_ - 1}, {0.5f, 0.25f, 0, 1, 1, 0, 0.125f, 0});
    AddShard(second_, {4, 5}, {0, 0, 0.75f, 0.25f});
    WriteManifest(directory_.path(), manifest_);
  }

  void Add(const SafetensorsWriter& writer, const std::string& name) {
    manifest_.checksums[name] = writer.Write(directory_ / name);
  }
  void AddShard(const std::string& name, const std::vector<int32_t>& triangles, const std::vector<float>& weights) {
    SafetensorsWriter writer;
    const auto count = int64_t(triangles.size() / 2);
    writer.Add<int32_t>("triangles", {count, 2}, triangles);
    writer.Add<float>("weights", {count, 2, 2}, weights);
    Add(writer, name);
  }
  void ExpectRefused(const std::string& part, Checksums checksums = Checksums::kVerify) const {
    ExpectError([&] { PointDatabase(directory_.path(), checksums); }, part);
  }

  TempDir directory_;
  Manifest manifest_;
  int32_t num_triangles_ = 0;
  const std::string first_ = "shards/person-00000.safetensors", second_ = "shards/interpolated-00000.safetensors";
};

TEST_F(PointDatabaseTest, SamplesAreReadFaceByFace) {
  const PointDatabase points(directory_.path());
  EXPECT_EQ(points.num_faces(), 3);
  EXPECT_EQ(points.num_samples(), 2);
  const SurfaceSamples second = points.samples(1), third = points.samples(2);
  EXPECT_EQ(std::vector(second.triangles.begin(), second.triangles.end()),
            (std::vector<int32_t>{2, num_triangles_ - 1}));
  EXPECT_EQ(std::vector(second.weights.begin(), second.weights.end()), (std::vector<float>{1, 0, 0.125f, 0}));
  EXPECT_EQ(std::vector(third.triangles.begin(), third.triangles.end()), (std::vector<int32_t>{4, 5}));
  EXPECT_EQ(third.weights[2], 0.75f);
}

TEST_F(PointDatabaseTest, TemplateFrameAndAttributesAreReadBack) {
  const PointDatabase points(directory_.path());
  EXPECT_EQ(points.num_vertices(), points.face_template().num_vertices());
  EXPECT_EQ(points.template_vertices().size(), size_t(3 * points.num_vertices()));
  EXPECT_EQ(points.template_vertices()[5], 5);
  EXPECT_EQ(points.frame().scale, 0.1);
  EXPECT_EQ(points.frame().offset, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(points.attribute_names(), (std::vector<std::string>{"smile", "chin"}));
  EXPECT_EQ(points.attributes(2)[0], 5);
  EXPECT_EQ(points.attributes(0)[1], 2);
}

TEST_F(PointDatabaseTest, CopiesShareTheMappedFiles) {
  const auto original = std::make_unique<PointDatabase>(directory_.path());
  const PointDatabase copy = *original;
  EXPECT_EQ(copy.samples(1).triangles.data(), original->samples(1).triangles.data());
}

TEST_F(PointDatabaseTest, FacesOutsideAreRefused) {
  const PointDatabase points(directory_.path());
  ExpectError([&] { points.samples(3); }, "points of face 3 of a database of 3");
  ExpectError([&] { points.attributes(-1); }, "points of face -1");
}

TEST_F(PointDatabaseTest, DamagedFilesAreRefused) {
  for (const std::string& name :
       {first_, second_, std::string("attributes.safetensors"), std::string("points_template.safetensors")}) {
    const std::string bytes = ReadFile(directory_ / name);
    std::string flipped = bytes;
    flipped.back() = char(flipped.back() ^ 1);
    testing::WriteQuickly(directory_ / name, flipped);
    ExpectRefused(name);
    testing::WriteQuickly(directory_ / name, bytes.substr(0, bytes.size() - 4));
    ExpectRefused(name, Checksums::kSkip);
    std::filesystem::remove(directory_ / name);
    ExpectRefused(name, Checksums::kSkip);
    testing::WriteQuickly(directory_ / name, bytes);
  }
  EXPECT_NO_THROW(PointDatabase(directory_.path()));
}

TEST_F(PointDatabaseTest, ShapesThatDifferFromTheManifestAreRefused) {
  AddShard(second_, {4, 5, 6, 7}, {0, 0, 0, 0, 0, 0, 0, 0});
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("triangles have the shape [2,2]");
  AddShard(second_, {4, 5}, {0, 0, 0, 0});
  manifest_.details["attributes"] = {"smile"};
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("attributes have the shape [3,2]");
}

TEST_F(PointDatabaseTest, SamplesOutsideTheSurfaceAreRefused) {
  AddShard(second_, {4, num_triangles_}, {0, 0, 0, 0});
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("none of the");
}

TEST_F(PointDatabaseTest, ManifestsOfOtherThingsAndNewerVersionsAreRefused) {
  manifest_.kind = "sketches";
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("points");
  manifest_.kind = "points";
  manifest_.details.erase("model_from_cm");
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("malformed");
  manifest_.details["model_from_cm"] = {{"scale", 0.1}, {"offset", {1, 2, 3}}};
  WriteManifest(directory_.path(), manifest_);
  std::string text = ReadFile(directory_ / "manifest.json");
  const std::string version = "\"format_version\": 1";
  ASSERT_NE(text.find(version), std::string::npos);
  text.replace(text.find(version), version.size(), "\"format_version\": 2");
  testing::WriteQuickly(directory_ / "manifest.json", text);
  ExpectRefused("version");
}

}  // namespace
}  // namespace daumier::datasets
