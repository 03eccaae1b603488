#include "datasets/build/face_levels.h"

#include "geometry/flips.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

Population NoPopulation() {
  return {0, {}};
}

TEST(LevelMaker, GammaZeroAloneNeedsNoRegion) {
  faces::FaceTemplate face = testing::SyntheticFace();
  FacesOptions options;
  options.exaggeration.gammas = {0.0, 0.1};
  PersonArrays arrays;
  const auto levels = LevelMaker(face, options, NoPopulation()).Make(face.neutral, 0, arrays);
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[1], faces::Exaggerate(face, face.neutral, options.exaggeration)[1]);
  face.annotation.regions.clear();
  options.exaggeration.gammas = {0.0};
  EXPECT_EQ(LevelMaker(face, options, NoPopulation()).Make(face.neutral, 0, arrays), std::vector{face.neutral});
  EXPECT_TRUE(arrays.part_strengths.empty());
  EXPECT_TRUE(arrays.control_values.empty());
}

TEST(LevelMaker, LevelsByControlsAreCaricaturesOfRecordedValues) {
  const faces::FaceModel model = testing::SyntheticModel();
  FacesOptions options = testing::SyntheticFacesOptions(3);
  options.levels = "controls";
  options.caricature.amounts = {0.0, 0.5, 1.5};
  const auto person = [&](int i) {
    Rng rng = Stream(1, "population", i);
    return faces::IdentityFace(model, faces::DrawIdentity(model, rng));
  };
  const Population population{20, person};
  const LevelMaker maker(model.face_template, options, population);
  PersonArrays arrays;
  const geometry::Points neutral = person(3);
  const auto levels = maker.Make(neutral, 3, arrays);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_LT((levels[0] - neutral).cwiseAbs().maxCoeff(), 1e-9);

  const Json details = maker.Details();
  const size_t num_values = details.at("controls").size();
  EXPECT_EQ(details.at("control_deviations").size(), num_values);
  ASSERT_EQ(arrays.control_values.size(), 3 * num_values);
  // The values make the face again.
  std::vector<geometry::Points> all;
  for (int i = 0; i < population.num_faces; ++i) all.push_back(person(i));
  const faces::CaricatureGenerator generator(model.face_template, all, options.caricature, options.exaggeration);
  const Eigen::Map<const Eigen::VectorXf> values(arrays.control_values.data() + 2 * num_values,
                                                 Eigen::Index(num_values));
  const auto again = generator.Make(neutral, 1.5, values.cast<double>());
  EXPECT_LT((again.face - levels[2]).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(LevelMaker, ADatabaseHoldsTheValuesOfItsControls) {
  const testing::TempDir folder;
  FacesOptions options = testing::SyntheticFacesOptions(2);
  options.levels = "controls";
  options.caricature.amounts = {0.0, 1.0};
  BuildFaces(testing::SyntheticModel(), options, folder / "faces");
  const faces::FaceDatabase database(folder / "faces");
  EXPECT_EQ(database.gammas(), (std::vector<double>{0.0, 1.0}));
  ASSERT_GT(database.control_names().size(), 60u);
  for (const float value : database.control_values(1, 0)) EXPECT_EQ(value, 0);
  const auto values = database.control_values(1, 1);
  ASSERT_EQ(values.size(), database.control_names().size());
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 0.1f);
  EXPECT_NE(std::vector<float>(values.begin(), values.end()),
            std::vector<float>(database.control_values(0, 1).begin(), database.control_values(0, 1).end()));
  testing::ExpectError([&] { database.control_values(0, 2); }, "level 2");
}

TEST(LevelMaker, NoTriangleOfTheFaceFlipsInAnyExpression) {
  const faces::FaceModel model = testing::SyntheticModel();
  FacesOptions options = testing::SyntheticFacesOptions(3);
  options.levels = "controls";
  options.caricature.amounts = {0.0, 3.0};
  options.caricature.invention = 0.6;
  const testing::TempDir folder;
  BuildFaces(model, options, folder / "faces");
  const faces::FaceDatabase database(folder / "faces");
  for (int person = 0; person < 3; ++person) {
    for (int e = 0; e < database.num_expressions(); ++e) {
      EXPECT_EQ(geometry::CountFlippedTriangles(
                    database.points(database.index({person, 0, e})), database.points(database.index({person, 1, e})),
                    model.face_template.triangles, model.face_template.annotation.regions.at("face")),
                0)
          << "person " << person << ", expression " << e;
    }
  }
}

TEST(LevelMaker, ADatabaseWithoutControlsHasNone) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 1);
  const faces::FaceDatabase database(folder / "faces");
  EXPECT_TRUE(database.control_names().empty());
  EXPECT_TRUE(database.control_values(0, 1).empty());
}

TEST(LevelMaker, OwnControlsNeedLevelsByControls) {
  FacesOptions options;
  options.own_controls = {"a=b.target"};
  const faces::FaceTemplate face = testing::SyntheticFace();
  testing::ExpectError([&] { PlanFaces(face, options, 1, {"neutral"}); }, "own_controls need levels");
  options.levels = "controls";
  EXPECT_FALSE(PlanFaces(face, options, 1, {"neutral"}).manifest.config.contains("own_controls")) << "a path";
}

TEST(LevelMaker, TheFirstAmountHasToBeZero) {
  FacesOptions options;
  options.levels = "controls";
  options.caricature.amounts = {0.5};
  const faces::FaceTemplate face = testing::SyntheticFace();
  testing::ExpectError([&] { PlanFaces(face, options, 1, {"neutral"}); },
                       "the first of caricature.amounts has to be 0");
}

}  // namespace
}  // namespace daumier::datasets
