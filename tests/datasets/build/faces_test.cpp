#include "datasets/build/faces.h"

#include "core/config.h"
#include "core/files.h"
#include "core/safetensors.h"
#include "datasets/build/interpolation.h"
#include "faces/expression_transfer.h"
#include "faces/face_database.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::TempDir;

class BuildFacesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    model_ = new faces::FaceModel(testing::SyntheticModel());
    BuildFaces(*model_, testing::SyntheticFacesOptions(3), *folder_ / "faces");
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete model_;
  }

  static fs::path faces() { return *folder_ / "faces"; }

  static inline TempDir* folder_ = nullptr;
  static inline faces::FaceModel* model_ = nullptr;
};

TEST_F(BuildFacesTest, FacesAreExaggeratedIdentitiesWithTransferredExpressions) {
  const faces::FaceDatabase database(faces());
  ASSERT_EQ(database.num_faces(), 3 * 2 * 4);
  const auto& all = model_->expressions;
  const faces::ExpressionTransfer transfer(*model_, {all[0], all[1], all[2], all[6]});
  for (int person = 0; person < 3; ++person) {
    Rng rng = Stream(7, "identity", person);
    const Eigen::VectorXf identity = faces::DrawIdentity(*model_, rng, 1.0);
    const auto stored = database.identity_weights(person);
    EXPECT_TRUE(std::equal(stored.begin(), stored.end(), identity.begin(), identity.end()));
    const geometry::Points neutral = faces::IdentityFace(*model_, identity);
    const auto levels =
        faces::Exaggerate(model_->face_template, neutral, testing::SyntheticFacesOptions(3).exaggeration);
    EXPECT_LT((database.points(database.index({person, 0, 0})) - neutral).cwiseAbs().maxCoeff(), 1e-5);
    const SafetensorsFile shard(faces() / faces::PersonShardName(person));
    const auto strengths = shard.at("expression_strengths").As<float>();
    EXPECT_EQ(strengths[0], 1);
    EXPECT_NE(strengths[2], 1);
    EXPECT_NEAR(strengths[2], 1, 0.2 + 1e-6);
    Eigen::VectorXd expected = Eigen::Map<const Eigen::VectorXd>(levels[1].data(), levels[1].size());
    expected += (strengths[2] * transfer.Offsets(levels[1]).col(2)).cast<double>();
    const auto face = database.vertices(database.index({person, 1, 2}));
    EXPECT_LT((Eigen::Map<const Eigen::VectorXf>(face.data(), expected.size()).cast<double>() - expected)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-5);
  }
}

TEST_F(BuildFacesTest, LevelsByPartsDifferFromPersonToPersonAndAreRecorded) {
  FacesOptions options = testing::SyntheticFacesOptions(2);
  options.levels = "parts";
  BuildFaces(*model_, options, *folder_ / "parts");
  const faces::FaceDatabase database(*folder_ / "parts");
  const auto names = database.manifest().details.at("parts").get<std::vector<std::string>>();
  EXPECT_EQ(names, faces::FacePartNames());
  const faces::FaceParts parts = faces::MakeFaceParts(model_->face_template, options.parts.blend_rings);
  for (int person = 0; person < 2; ++person) {
    const SafetensorsFile shard(*folder_ / "parts" / faces::PersonShardName(person));
    const ArrayView& stored = shard.at("part_strengths");
    ASSERT_EQ(stored.shape, (std::vector<int64_t>{2, int64_t(names.size()), 4}));
    const auto values = stored.As<float>();
    faces::PartStrengths strengths{Eigen::VectorXd(names.size()), geometry::Points(names.size(), 3), {}};
    for (size_t p = 0; p < names.size(); ++p) {
      EXPECT_EQ(values[4 * p], 0) << "level 0 is the person";
      const float* const row = &values[4 * (names.size() + p)];
      strengths.gammas[Eigen::Index(p)] = row[0];
      strengths.log_stretches.row(Eigen::Index(p)) << row[1], row[2], row[3];
    }
    const auto bumps = shard.at("lumps").As<float>();
    ASSERT_EQ(shard.at("lumps").shape, (std::vector<int64_t>{2, options.parts.num_lumps * 3 / 2, 5}));
    for (size_t i = bumps.size() / 2; i < bumps.size(); i += 5) {
      strengths.bumps.push_back({static_cast<int>(bumps[i]), bumps[i + 1], {bumps[i + 2], bumps[i + 3], bumps[i + 4]}});
    }
    const geometry::Points neutral = database.points(database.index({person, 0, 0}));
    const geometry::Points expected =
        faces::ExaggerateParts(model_->face_template, parts, neutral, strengths, options.exaggeration);
    EXPECT_LT((database.points(database.index({person, 1, 0})) - expected).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST_F(BuildFacesTest, InterpolatedFacesFollowTheGrid) {
  FacesOptions options = testing::SyntheticFacesOptions(4);
  options.num_interpolated = 11;  // A shard of 8 and one of 3.
  options.family_size = 2;
  BuildFaces(*model_, options, *folder_ / "interpolated");
  const faces::FaceDatabase database(*folder_ / "interpolated");
  ASSERT_EQ(database.num_grid_faces(), 4 * 2 * 4);
  ASSERT_EQ(database.num_faces(), 4 * 2 * 4 + 11);
  EXPECT_EQ(database.groups(), (std::vector<int>{0, 0, 1, 1}));
  for (int i = 0; i < 11; ++i) {
    const int face = database.num_grid_faces() + i;
    const Interpolation drawn = DrawInterpolation(MakeFamilies(4, 2), 2, 4, 7, i);
    EXPECT_EQ(database.persons(face), (std::vector<int>{drawn.a.person, drawn.b.person}));
    EXPECT_EQ(database.group(face), drawn.a.person / 2);
    const std::vector<float> expected = Interpolate(*folder_ / "interpolated", drawn);
    const auto stored = database.vertices(face);
    EXPECT_TRUE(std::equal(stored.begin(), stored.end(), expected.begin(), expected.end()));
  }
  EXPECT_EQ(database.Describe(32).substr(0, 16), "between persons ");
  ExpectError([&] { database.id(32); }, "not one of the grid of 32 faces");
}

TEST_F(BuildFacesTest, InterruptedInterpolationResumesWithTheSameBytes) {
  FacesOptions options = testing::SyntheticFacesOptions(4);
  options.num_interpolated = 5;
  options.family_size = 2;
  BuildFaces(*model_, options, *folder_ / "whole");
  ExpectError([&] { BuildFaces(*model_, options, *folder_ / "halted", testing::CancelledTask()); },
              "stopped after 0 of 5");
  BuildFaces(*model_, options, *folder_ / "halted");
  EXPECT_EQ(DataHash(*folder_ / "whole"), DataHash(*folder_ / "halted"));
}

TEST_F(BuildFacesTest, ManifestHoldsCountsLicencesAndNoPath) {
  const Manifest manifest = ReadManifest(faces(), "faces");
  EXPECT_EQ(manifest.counts.at("faces"), 24);
  EXPECT_EQ(manifest.seed, 7u);
  EXPECT_EQ(manifest.sources.at(0).at("licence"), "Apache-2.0");
  EXPECT_EQ(manifest.details.at("expressions").size(), 4u);
  EXPECT_FALSE(manifest.config.at("source").contains("path"));
  EXPECT_EQ(ReadFile(faces() / "manifest.json").find(faces().string()), std::string::npos);
}

TEST_F(BuildFacesTest, AnInterruptedBuildEndsWithTheSameBytes) {
  const FacesOptions options = testing::SyntheticFacesOptions(3);
  ExpectError([&] { BuildFaces(*model_, options, *folder_ / "stopped", testing::CancelledTask()); },
              "stopped after 0 of 3");
  BuildFaces(*model_, options, *folder_ / "stopped");
  EXPECT_EQ(DataHash(*folder_ / "stopped"), DataHash(faces()));
}

TEST_F(BuildFacesTest, AnotherPersonOrSeedMakesOtherFaces) {
  FacesOptions options = testing::SyntheticFacesOptions(1);
  options.seed = 8;
  BuildFaces(*model_, options, *folder_ / "other_seed");
  const faces::FaceDatabase database(faces()), other(*folder_ / "other_seed");
  EXPECT_GT((database.points(0) - database.points(database.index({1, 0, 0}))).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_GT((database.points(0) - other.points(0)).cwiseAbs().maxCoeff(), 0.01);
}

TEST_F(BuildFacesTest, WrongOptionsAreRefusedBeforeAnythingIsWritten) {
  const auto refused = [&](auto change, const std::string& part) {
    FacesOptions options = testing::SyntheticFacesOptions(1);
    change(options);
    ExpectError([&] { BuildFaces(*model_, options, *folder_ / "refused"); }, part);
    EXPECT_FALSE(fs::exists(*folder_ / "refused"));
  };
  refused([](FacesOptions& o) { o.expressions = {"neutral", "smlie"}; }, "did you mean 'smile'");
  refused([](FacesOptions& o) { o.expressions = {"smile", "neutral"}; }, "has to be neutral");
  refused([](FacesOptions& o) { o.expressions = {"neutral", "smile", "smile"}; }, "named twice");
  refused([](FacesOptions& o) { o.exaggeration.gammas = {0.1, 0.2}; }, "has to be 0");
  refused([](FacesOptions& o) { o.exaggeration.gammas = {}; }, "has to be 0");
  refused([](FacesOptions& o) { o.num_interpolated = 3; }, "1 persons make no family of 5");
}

TEST_F(BuildFacesTest, NoExpressionsNamedMeansAll) {
  FacesOptions options = testing::SyntheticFacesOptions(1);
  options.expressions.clear();
  BuildFaces(*model_, options, *folder_ / "all");
  EXPECT_EQ(faces::FaceDatabase(*folder_ / "all").num_expressions(), static_cast<int>(model_->expressions.size()));
}

TEST_F(BuildFacesTest, TheExampleInPythonReadsIt) {
  std::string python;
  for (const char* candidate : {"/usr/bin/python3", "/usr/local/bin/python3"}) {
    if (fs::exists(candidate) && testing::RunProcess({candidate, "-c", "import numpy"}).exit_code == 0)
      python = candidate;
  }
  if (python.empty()) GTEST_SKIP() << "no python3 with numpy";
  const auto script = testing::SourceRoot() / "docs/examples/read_faces.py";
  const testing::ProcessResult result = testing::RunProcess({python, script.string(), faces().string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const faces::FaceDatabase database(faces());
  const geometry::Points offset = database.points(2) - database.points(0);
  EXPECT_EQ(result.out,
            fmt::format("3 persons, (2, 4, {}, 3) ({}, 3)\na smile moves {:.3f} cm at most\n", database.num_vertices(),
                        database.face_template().triangles.rows(), offset.rowwise().norm().maxCoeff()));
}

TEST(FacesConfig, EveryFileIsParsed) {
  int num_files = 0;
  for (const auto& entry : fs::directory_iterator(testing::SourceRoot() / "configs/faces")) {
    EXPECT_NO_THROW(ParseOptions<FacesOptions>(LoadConfig(entry.path()), entry.path().string())) << entry.path();
    ++num_files;
  }
  EXPECT_GT(num_files, 0);
}

}  // namespace
}  // namespace daumier::datasets
