#include "datasets/build/faces_plan.h"

#include "faces/face_database.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

using testing::ExpectError;

FacesOptions Options(std::vector<double> gammas) {
  FacesOptions options;
  options.source = {.name = "meshes", .path = "/secret/a", .annotation = "/secret/b", .template_mesh = "/secret/c"};
  options.exaggeration.gammas = std::move(gammas);
  return options;
}

TEST(ChooseExpressions, OrderIsThatOfTheWishes) {
  const std::vector<std::string> available = {"neutral", "smile", "frown"};
  EXPECT_EQ(ChooseExpressions(available, {"neutral", "frown", "smile"}, "x"), (std::vector<int>{0, 2, 1}));
  EXPECT_EQ(ChooseExpressions(available, {}, "x"), (std::vector<int>{0, 1, 2}));
  EXPECT_THROW(ChooseExpressions(available, {"frown"}, "x"), UsageError);
  ExpectError([&] { ChooseExpressions(available, {"neutral", "smlie"}, "x"); }, "did you mean 'smile'");
  ExpectError([&] { ChooseExpressions(available, {"neutral", "neutral"}, "x"); }, "named twice");
}

TEST(PlanFaces, ManifestHoldsCountsAndSourcesButNoPath) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const ShardedBuild build = PlanFaces(face, Options({0.0, 0.1}), 5, {"neutral", "smile", "frown"});
  EXPECT_EQ(build.manifest.counts.at("faces"), 30);
  EXPECT_EQ(build.units_per_shard, 6);
  EXPECT_EQ(build.manifest.details.at("gammas"), (Json{0.0, 0.1}));
  EXPECT_EQ(build.manifest.sources, Json::array({face.provenance}));
  EXPECT_EQ(build.manifest.config.dump().find("secret"), std::string::npos);
}

TEST(PlanFaces, MissingRegionsAreFoundBeforeAnythingBegins) {
  faces::FaceTemplate face = testing::SyntheticFace();
  face.annotation.regions.erase("ears");
  ExpectError([&] { PlanFaces(face, Options({0.0, 0.1}), 1, {"neutral"}); }, "needs the region 'ears'");
  EXPECT_NO_THROW(PlanFaces(face, Options({0.0}), 1, {"neutral"}));
  EXPECT_THROW(PlanFaces(face, Options({0.1}), 1, {"neutral"}), UsageError);
}

TEST(PersonShard, HoldsWhatIsThere) {
  const testing::TempDir folder;
  Manifest manifest;
  manifest.counts = {{"levels", 1}, {"expressions", 2}, {"vertices", 1}};
  PersonArrays arrays;
  arrays.vertices = {0, 1, 2, 3, 4, 5};
  arrays.part_strengths.assign(8, 0.5f);
  const std::string checksum = WritePersonShard(folder / "p.safetensors", manifest, arrays);
  EXPECT_EQ(checksum, Sha256OfFile(folder / "p.safetensors"));
  const SafetensorsFile file(folder / "p.safetensors");
  EXPECT_EQ(file.at("vertices").shape, (std::vector<int64_t>{1, 2, 1, 3}));
  EXPECT_EQ(file.at("part_strengths").shape, (std::vector<int64_t>{1, 2, 4}));
  EXPECT_FALSE(file.contains("identity_weights") || file.contains("expression_strengths"));
  arrays.vertices.pop_back();
  ExpectError([&] { WritePersonShard(folder / "q.safetensors", manifest, arrays); }, "vertices");
}

}  // namespace
}  // namespace daumier::datasets
