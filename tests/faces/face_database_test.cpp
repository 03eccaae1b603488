#include "faces/face_database.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::TempDir;

constexpr int kPersons = 2, kLevels = 2, kExpressions = 3;

/// A database whose face f has the coordinates f, f + 1, f + 2, ...
struct SampleDatabase {
  SampleDatabase() {
    template_ = testing::SyntheticFace();
    MakeDirectory(directory_ / "shards");
    manifest_.kind = "faces";
    manifest_.verb = "dataset faces";
    manifest_.counts = {{"persons", kPersons}, {"levels", kLevels}, {"expressions", kExpressions}};
    manifest_.details = {{"gammas", {0.0, 0.2}}, {"expressions", {"neutral", "smile", "frown"}}};
    manifest_.checksums = WriteFaceTemplate(directory_.path(), template_);
    for (int person = 0; person < kPersons; ++person) WritePerson(person);
    WriteManifest(directory_.path(), manifest_);
  }

  /// With distances to a mesh that the person was registered onto, or without.
  void WritePerson(int person, const std::vector<float>& distances = {}) {
    const int num_vertices = template_.num_vertices(), faces_per_person = kLevels * kExpressions;
    std::vector<float> vertices(size_t(faces_per_person) * 3 * num_vertices);
    for (int face = 0; face < faces_per_person; ++face) {
      const auto begin = vertices.begin() + face * 3 * num_vertices;
      std::iota(begin, begin + 3 * num_vertices, static_cast<float>(person * faces_per_person + face));
    }
    SafetensorsWriter writer;
    writer.Add<float>("vertices", {kLevels, kExpressions, num_vertices, 3}, vertices);
    writer.Add<float>("identity_weights", {2}, std::vector<float>{float(person), 0.5f});
    if (!distances.empty()) writer.Add<float>("distances", {int64_t(distances.size())}, distances);
    manifest_.checksums[PersonShardName(person)] = writer.Write(directory_ / PersonShardName(person));
  }

  /// Changes the bytes of a file of the database.
  void Edit(const std::string& name, const std::function<void(std::string&)>& edit) {
    std::string bytes = ReadFile(directory_ / name);
    edit(bytes);
    WriteFileAtomically(directory_ / name, bytes);
  }
  /// Replaces a text in a file of the database.
  void Replace(const std::string& name, const std::string& from, const std::string& to) {
    Edit(name, [&](std::string& bytes) {
      ASSERT_NE(bytes.find(from), std::string::npos);
      bytes.replace(bytes.find(from), from.size(), to);
    });
  }
  void ExpectRefused(const std::string& part, Checksums checksums = Checksums::kVerify) {
    ExpectError([&] { FaceDatabase(directory_.path(), checksums); }, part);
  }

  TempDir directory_;
  FaceTemplate template_;
  Manifest manifest_;
  const std::string shard_ = PersonShardName(1);
};

class FaceDatabaseTest : public ::testing::Test, protected SampleDatabase {};

TEST(FaceDatabase, IndexAndIdAreInverse) {
  const SampleDatabase sample;
  const FaceDatabase database(sample.directory_.path());
  ASSERT_EQ(database.num_faces(), kPersons * kLevels * kExpressions);
  for (int face = 0; face < database.num_faces(); ++face) EXPECT_EQ(database.index(database.id(face)), face);
  EXPECT_EQ(database.id(10), (FaceId{.person = 1, .level = 1, .expression = 1}));
}

TEST(FaceDatabase, PointsAreTheVerticesRowByRow) {
  const SampleDatabase sample;
  const FaceDatabase database(sample.directory_.path());
  for (int face = 0; face < database.num_faces(); ++face) {
    const auto vertices = database.vertices(face);
    ASSERT_EQ(vertices.size(), size_t(3) * database.num_vertices());
    EXPECT_EQ(vertices[0], static_cast<float>(face));
    EXPECT_EQ(vertices[5], static_cast<float>(face + 5));
    EXPECT_EQ(database.points(face)(1, 2), face + 5.0);
  }
}

TEST_F(FaceDatabaseTest, ReportsItsCounts) {
  const FaceDatabase database(directory_.path());
  EXPECT_EQ(database.num_persons(), kPersons);
  EXPECT_EQ(database.num_levels(), kLevels);
  EXPECT_EQ(database.expression_names().at(2), "frown");
  EXPECT_EQ(database.gammas(), (std::vector<double>{0.0, 0.2}));
  EXPECT_EQ(database.identity_weights(1)[0], 1.0f);
  EXPECT_EQ(database.manifest().kind, "faces");
}

class InterpolatedFacesTest : public FaceDatabaseTest {
 protected:
  /// One face between two others; persons 0 and 1 are one group if `related`.
  void AddInterpolated(int parent_a, int parent_b, bool related) {
    std::vector<float> vertices(size_t(3) * template_.num_vertices());
    std::iota(vertices.begin(), vertices.end(), 100.0f);
    SafetensorsWriter writer;
    writer.Add<float>("vertices", {1, template_.num_vertices(), 3}, vertices);
    writer.Add<int32_t>("parents", {1, 2}, std::vector<int32_t>{parent_a, parent_b});
    writer.Add<float>("shares", {1, 2}, std::vector<float>{0.5f, 0.5f});
    const std::string name = FaceShardName(kPersons, kPersons);
    manifest_.checksums[name] = writer.Write(directory_ / name);
    manifest_.counts["interpolated"] = 1;
    manifest_.details["groups"] = {"a", related ? "a" : "b"};
    WriteManifest(directory_.path(), manifest_);
  }
};

TEST_F(InterpolatedFacesTest, FollowTheGridAndBelongToTheirParentsGroup) {
  AddInterpolated(4, 9, true);
  const FaceDatabase database(directory_.path());
  EXPECT_EQ(database.num_grid_faces(), 12);
  EXPECT_EQ(database.num_faces(), 13);
  EXPECT_EQ(database.vertices(12)[1], 101.0f);
  EXPECT_EQ(database.persons(12), (std::vector<int>{0, 1}));
  EXPECT_EQ(database.persons(11), (std::vector<int>{1}));
  EXPECT_EQ(database.group(12), 0);
  EXPECT_EQ(database.Describe(12), "between persons 0 and 1");
  EXPECT_EQ(database.Describe(11), "person 1, level 2, frown");
  ExpectError([&] { database.id(12); }, "not one of the grid of 12 faces");
  ExpectError([&] { database.persons(13); }, "face 13 of a database of 13");
}

TEST_F(InterpolatedFacesTest, ParentsOfTwoGroupsOrOutsideTheGridAreRefused) {
  AddInterpolated(4, 9, false);
  ExpectRefused("parents of a face belong to different groups");
  AddInterpolated(4, 12, true);
  ExpectRefused("face 12 is no parent");
}

TEST_F(FaceDatabaseTest, GroupsJoinPersonsThatAreTheSame) {
  EXPECT_EQ(FaceDatabase(directory_.path()).groups(), (std::vector<int>{0, 1}));
  manifest_.details["groups"] = {"bob", "bob"};
  WriteManifest(directory_.path(), manifest_);
  EXPECT_EQ(FaceDatabase(directory_.path()).groups(), (std::vector<int>{0, 0}));
  manifest_.details["groups"] = {"bob"};
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("lists the groups of 1 persons, expected 2");
  manifest_.details["groups"] = {1, 2};
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("malformed");
}

TEST_F(FaceDatabaseTest, TemplatesWithoutMirrorAndHolesAreReadBack) {
  FaceTemplate bare = template_;
  bare.closing_triangles.resize(0, 3);
  bare.num_eye_closing_triangles = 0;
  bare.annotation.mirror.clear();
  bare.annotation.curves.clear();
  WriteFaceTemplate(directory_.path(), bare);
  const FaceTemplate read = ReadFaceTemplate(directory_.path());
  EXPECT_EQ(read.closing_triangles.rows(), 0);
  EXPECT_TRUE(read.annotation.mirror.empty() && read.annotation.curves.empty());
  EXPECT_EQ(read.triangles, bare.triangles);
}

TEST_F(FaceDatabaseTest, IndicesOutsideAreRefused) {
  const FaceDatabase database(directory_.path());
  ExpectError([&] { database.vertices(12); }, "face 12 of a database of 12");
  ExpectError([&] { database.id(-1); }, "face -1");
  ExpectError([&] { database.index({0, 2, 0}); }, "level 2");
  ExpectError([&] { database.identity_weights(2); }, "person 2");
}

TEST_F(FaceDatabaseTest, TemplateIsReadBack) {
  const FaceTemplate read = ReadFaceTemplate(directory_.path());
  EXPECT_EQ(read.source, template_.source);
  EXPECT_EQ(read.provenance, template_.provenance);
  EXPECT_EQ(read.neutral, template_.neutral);
  EXPECT_EQ(read.triangles, template_.triangles);
  EXPECT_EQ(read.closing_triangles, template_.closing_triangles);
  EXPECT_EQ(read.num_eye_closing_triangles, template_.num_eye_closing_triangles);
  EXPECT_EQ(read.annotation.landmarks, template_.annotation.landmarks);
  EXPECT_EQ(read.annotation.hairline_vertex, template_.annotation.hairline_vertex);
  EXPECT_EQ(read.annotation.regions, template_.annotation.regions);
  EXPECT_EQ(read.annotation.mirror, template_.annotation.mirror);
  ASSERT_EQ(read.annotation.curves.size(), template_.annotation.curves.size());
  for (size_t c = 0; c < read.annotation.curves.size(); ++c) {
    const FeatureCurve &curve = read.annotation.curves[c], &expected = template_.annotation.curves[c];
    EXPECT_EQ(curve.name, expected.name);
    EXPECT_EQ(curve.kind, expected.kind);
    EXPECT_EQ(curve.view, expected.view);
    EXPECT_EQ(curve.closed, expected.closed);
    EXPECT_EQ(curve.vertices, expected.vertices);
  }
}

/// The face with UV: a row for each corner of each third triangle, one row of a vertex for the others.
FaceTemplate WithUv(FaceTemplate face) {
  face.uv_triangles = face.triangles;
  int num_rows = face.num_vertices();
  for (Eigen::Index t = 0; t < face.triangles.rows(); t += 3) {
    for (int k = 0; k < 3; ++k) face.uv_triangles(t, k) = num_rows++;
  }
  face.uv = geometry::TextureCoordinates::Random(num_rows, 2);
  return face;
}

TEST_F(FaceDatabaseTest, UvIsReadBackBitByBitFromVersion2) {
  const FaceTemplate face = WithUv(template_);
  manifest_.checksums.merge(WriteFaceTemplate(directory_.path(), face));
  EXPECT_EQ(Json::parse(ReadFile(directory_ / "template.json")).at("format_version"), 2);
  const FaceTemplate read = ReadFaceTemplate(directory_.path());
  EXPECT_EQ(read.uv, face.uv);
  EXPECT_EQ(read.uv_triangles, face.uv_triangles);
  EXPECT_EQ(read.triangles, face.triangles);
}

/// template.safetensors and template.json exactly as version 1 of the format had them before UV.
void WriteVersion1(const std::filesystem::path& directory, const FaceTemplate& face) {
  SafetensorsWriter arrays;
  arrays.SetMetadata("kind", "face template");
  const auto add = [&](const std::string& name, const auto& matrix) {
    using Scalar = std::decay_t<decltype(*matrix.data())>;
    arrays.Add<Scalar>(name, {matrix.rows(), 3}, {matrix.data(), size_t(matrix.size())});
  };
  add("neutral", face.neutral);
  add("triangles", face.triangles);
  add("closing_triangles", face.closing_triangles);
  const Annotation& annotation = face.annotation;
  arrays.Add<int32_t>("mirror", {int64_t(annotation.mirror.size())}, annotation.mirror);
  for (const auto& [name, vertices] : annotation.regions)
    arrays.Add<int32_t>("region/" + name, {int64_t(vertices.size())}, vertices);
  arrays.Write(directory / "template.safetensors");
  Json curves = Json::array();
  for (const FeatureCurve& curve : annotation.curves) {
    curves.push_back({{"name", curve.name},
                      {"kind", curve.kind},
                      {"view", curve.view == View::kFrontal ? "frontal" : "side"},
                      {"closed", curve.closed},
                      {"vertices", curve.vertices}});
  }
  const Json text = {{"format_version", 1},
                     {"source", face.source},
                     {"provenance", face.provenance},
                     {"num_eye_closing_triangles", face.num_eye_closing_triangles},
                     {"hairline_vertex", annotation.hairline_vertex},
                     {"landmarks", annotation.landmarks},
                     {"curves", curves}};
  WriteFileAtomically(directory / "template.json", text.dump(1) + "\n");
}

TEST_F(FaceDatabaseTest, Version1IsReadAndATemplateWithoutUvKeepsItsBytes) {
  const TempDir old;
  WriteVersion1(old.path(), template_);
  const FaceTemplate read = ReadFaceTemplate(old.path());
  EXPECT_EQ(read.neutral, template_.neutral);
  EXPECT_EQ(read.triangles, template_.triangles);
  EXPECT_EQ(read.annotation.landmarks, template_.annotation.landmarks);
  EXPECT_FALSE(read.has_uv());
  EXPECT_EQ(read.uv_triangles.rows(), 0);
  for (const char* file : {"template.safetensors", "template.json"}) {
    EXPECT_TRUE(ReadFile(old / file) == ReadFile(directory_ / file)) << file;
  }
}

TEST_F(FaceDatabaseTest, UvThatDoesNotFitIsRefused) {
  FaceTemplate face = WithUv(template_);
  face.uv_triangles(7, 1) = static_cast<int>(face.uv.rows());
  ExpectError([&] { WriteFaceTemplate(directory_.path(), face); }, fmt::format("uses row {} of UV", face.uv.rows()));
  // Version 2 without its arrays, and with those of another surface.
  Replace("template.json", "\"format_version\": 1", "\"format_version\": 2");
  ExpectRefused("'uv'", Checksums::kSkip);
  FaceTemplate other = WithUv(template_);
  other.triangles.conservativeResize(other.triangles.rows() - 1, 3);
  other.uv_triangles.conservativeResize(other.triangles.rows(), 3);
  WriteFaceTemplate(directory_.path(), other);
  SafetensorsWriter damaged;
  const SafetensorsFile whole(directory_ / "template.safetensors");
  for (const auto& [name, array] : whole.arrays()) {
    if (name == "triangles") continue;
    damaged.AddBytes(name, array.dtype, array.shape, array.data, size_t(array.size()) * ItemSize(array.dtype));
  }
  damaged.Add<int32_t>("triangles", {template_.triangles.rows(), 3},
                       {template_.triangles.data(), size_t(template_.triangles.size())});
  const TempDir folder;
  damaged.Write(folder / "template.safetensors");
  WriteFileAtomically(folder / "template.json", ReadFile(directory_ / "template.json"));
  ExpectError([&] { ReadFaceTemplate(folder.path()); }, "template.safetensors: UV of");
}

TEST_F(FaceDatabaseTest, AMissingShardIsNamed) {
  std::filesystem::remove(directory_ / shard_);
  ExpectRefused(shard_);
  ExpectRefused(shard_, Checksums::kSkip);
}

TEST_F(FaceDatabaseTest, ATruncatedShardIsNamed) {
  Edit(shard_, [](std::string& bytes) { bytes.resize(bytes.size() / 2); });
  ExpectRefused(shard_);
  ExpectRefused(shard_, Checksums::kSkip);
}

TEST_F(FaceDatabaseTest, AFlippedByteIsFoundByTheChecksum) {
  Edit(shard_, [](std::string& bytes) { bytes[bytes.size() - 100] ^= 1; });
  ExpectRefused(shard_);
  EXPECT_NO_THROW(FaceDatabase(directory_.path(), Checksums::kSkip));
}

TEST_F(FaceDatabaseTest, NewerVersionsAreRefused) {
  Replace("manifest.json", "\"format_version\": 1", "\"format_version\": 99");
  ExpectRefused("99");
  WriteManifest(directory_.path(), manifest_);
  Replace(shard_, "\"format_version\":\"1\"", "\"format_version\":\"9\"");
  ExpectRefused("format_version", Checksums::kSkip);
}

TEST_F(FaceDatabaseTest, ShardsOfAnotherShapeAreRefused) {
  manifest_.counts["levels"] = 3;
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("vertices have the shape [2,3,");
  manifest_.counts.erase("levels");
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("manifest.json: malformed");
}

TEST_F(FaceDatabaseTest, RefusesARegistrationWithoutAnyMatch) {
  WritePerson(0, std::vector<float>(size_t(template_.num_vertices()), std::numeric_limits<float>::quiet_NaN()));
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused("a failed registration: no vertex has a match");
}

TEST_F(FaceDatabaseTest, DistancesOfRegisteredFacesAreThoseOfTheirShard) {
  EXPECT_TRUE(FaceDatabase(directory_.path()).match_distances(0).empty());
  std::vector<float> distances(size_t(template_.num_vertices()), 0.5f);
  distances[2] = std::numeric_limits<float>::quiet_NaN();
  WritePerson(0, distances);
  WriteManifest(directory_.path(), manifest_);
  const FaceDatabase database(directory_.path());
  const int last_of_first = kLevels * kExpressions - 1;
  for (const int face : {0, last_of_first}) {
    ASSERT_EQ(database.match_distances(face).size(), distances.size());
    EXPECT_EQ(database.match_distances(face)[0], 0.5f);
    EXPECT_TRUE(std::isnan(database.match_distances(face)[2]));
  }
  EXPECT_TRUE(database.match_distances(last_of_first + 1).empty());
  ExpectError([&] { database.match_distances(database.num_faces()); }, "of a database of");
  distances.pop_back();
  WritePerson(0, distances);
  WriteManifest(directory_.path(), manifest_);
  ExpectRefused(fmt::format("{} distances of {} vertices", distances.size(), distances.size() + 1));
}

TEST_F(FaceDatabaseTest, ATemplateThatDoesNotFitIsRefused) {
  Replace("template.json", "\"hairline_vertex\": ", "\"hairline_vertex\": 99");
  ExpectRefused("the hairline names vertex 99", Checksums::kSkip);
  Replace("template.json", "\"format_version\": 1", "\"format_version\": 3");
  ExpectRefused("template.json: format version 3 is not supported (expected 1 or 2)", Checksums::kSkip);
  WriteFileAtomically(directory_ / "template.json", "{\"format_version\":");
  ExpectRefused("template.json: not JSON", Checksums::kSkip);
  std::filesystem::remove(directory_ / "template.json");
  ExpectRefused("template.json", Checksums::kSkip);
}

}  // namespace
}  // namespace daumier::faces
