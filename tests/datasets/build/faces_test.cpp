#include "datasets/build/faces.h"

#include "core/config.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "faces/face_database.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
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

TEST_F(BuildFacesTest, FacesAreExaggeratedIdentitiesPlusExpressions) {
  const faces::FaceDatabase database(faces());
  ASSERT_EQ(database.num_faces(), 3 * 2 * 4);
  for (int person = 0; person < 3; ++person) {
    Rng rng = Stream(7, "identity", person);
    const Eigen::VectorXf identity = faces::DrawIdentity(*model_, rng, 1.0);
    const auto stored = database.identity_weights(person);
    EXPECT_TRUE(std::equal(stored.begin(), stored.end(), identity.begin(), identity.end()));
    const geometry::Points neutral = faces::IdentityFace(*model_, identity);
    const auto levels =
        faces::Exaggerate(model_->face_template, neutral, testing::SyntheticFacesOptions(3).exaggeration);
    EXPECT_LT((database.points(database.index({person, 0, 0})) - neutral).cwiseAbs().maxCoeff(), 1e-5);
    const Eigen::VectorXf smile = faces::ExpressionOffset(*model_, model_->expressions[2].weights);
    Eigen::VectorXd expected = Eigen::Map<const Eigen::VectorXd>(levels[1].data(), levels[1].size());
    expected += smile.cast<double>();
    const auto face = database.vertices(database.index({person, 1, 2}));
    EXPECT_LT((Eigen::Map<const Eigen::VectorXf>(face.data(), expected.size()).cast<double>() - expected)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-5);
  }
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
  SetInterrupted(true);
  ExpectError([&] { BuildFaces(*model_, options, *folder_ / "stopped"); }, "stopped after 0 of 3");
  SetInterrupted(false);
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
}

TEST_F(BuildFacesTest, NoExpressionsNamedMeansAll) {
  FacesOptions options = testing::SyntheticFacesOptions(1);
  options.expressions.clear();
  BuildFaces(*model_, options, *folder_ / "all");
  EXPECT_EQ(faces::FaceDatabase(*folder_ / "all").num_expressions(), static_cast<int>(model_->expressions.size()));
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
