#include "eval/plausibility.h"

#include "core/random.h"
#include "core/statistics.h"
#include "eval/mesh_score.h"
#include "geometry/alignment.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace daumier::eval {
namespace {

using testing::ExpectError;

/// The neutral face with smooth bumps of these heights, cm.
geometry::Points Bumpy(const faces::FaceTemplate& face, double sine, double cosine, double bow = 0) {
  geometry::Points points = face.neutral;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double x = face.neutral(i, 0), y = face.neutral(i, 1);
    points(i, 2) += sine * std::sin(2 * x) + cosine * std::cos(3 * y);
    points(i, 0) += bow * y * y;
  }
  return points;
}

geometry::Points Moved(const geometry::Points& points, double scale) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return geometry::Similarity{scale, rotation, {1, -2, 3}}.Apply(points);
}

TEST(FacePopulation, AMovedAndScaledFaceIsAtNoDistance) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const FacePopulation population({face.neutral, Bumpy(face, 0.5, 0), Bumpy(face, 0, 0.5)}, {0, 1, 2}, face);
  for (int i = 0; i < 3; ++i) {
    const NearestFace nearest = population.Nearest(Moved(Bumpy(face, i == 1 ? 0.5 : 0, i == 2 ? 0.5 : 0), 1.3));
    EXPECT_EQ(nearest.face, i);
    EXPECT_NEAR(nearest.distance_mm, 0, 1e-6);
  }
}

TEST(FacePopulation, FacesOfTheSamePersonAreNoNeighbours) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const std::vector<geometry::Points> faces = {face.neutral, Moved(face.neutral, 2), Bumpy(face, 0.5, 0)};
  const auto same = FacePopulation(faces, {0, 0, 1}, face).AmongThemselves();
  EXPECT_EQ(same[0].face, 2);
  EXPECT_EQ(same[1].face, 2);
  EXPECT_NEAR(same[0].distance_mm, ScoreMesh("", faces[0], faces[2], face).aligned, 1e-9);
  EXPECT_NEAR(same[1].distance_mm, same[0].distance_mm, 1e-9) << "the query's size does not matter";
  const auto others = FacePopulation(faces, {0, 1, 2}, face).AmongThemselves();
  EXPECT_EQ(others[0].face, 1);
  EXPECT_NEAR(others[0].distance_mm, 0, 1e-6);
  ExpectError([&] { FacePopulation(faces, {0, 0, 0}, face).AmongThemselves(); }, "all of one person");
}

TEST(FacePopulation, FindsTheNearestOfAllPairs) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  Rng rng = Stream(3, "plausibility test");
  std::vector<geometry::Points> faces;
  std::vector<int> groups;
  for (int i = 0; i < 60; ++i) {
    faces.push_back(Bumpy(face, 0.4 * rng.Normal(), 0.4 * rng.Normal(), 0.02 * rng.Normal()));
    groups.push_back(i / 2);
  }
  const FacePopulation population(faces, groups, face);
  const auto among = population.AmongThemselves();
  for (size_t i = 0; i < faces.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (size_t j = 0; j < faces.size(); ++j)
      if (groups[j] != groups[i]) least = std::min(least, ScoreMesh("", faces[i], faces[j], face).aligned);
    EXPECT_NEAR(among[i].distance_mm, least, 1e-9) << i;
    EXPECT_EQ(population.Nearest(faces[i]).face, int(i));
  }
}

TEST(FacePopulation, RefusesOtherSizes) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  ExpectError([&] { FacePopulation({}, {}, face); }, "a population needs a face");
  ExpectError([&] { FacePopulation({face.neutral}, {0, 1}, face); }, "1 faces of 2 persons");
  const FacePopulation one({face.neutral}, {0}, face);
  ExpectError([&] { one.Nearest(face.neutral.topRows(5)); }, "a face of 5 vertices");
}

TEST(PlausibilityScores, CountsWhatIsWithin) {
  const PlausibilityScores scores{
      .of_predictions = {{"a", {3, 0.5}, "person 1", true}, {"b", {4, 2.5}, "person 2", false}},
      .num_faces = 10,
      .limit_mm = 2,
      .median_mm = 1};
  EXPECT_EQ(scores.num_within(), 1);
  const Json json = PlausibilityToJson(scores);
  EXPECT_EQ(json.at("num_within"), 1);
  EXPECT_EQ(json.at("num_predictions"), 2);
  EXPECT_EQ(json.at("predictions")[1].at("distance_mm"), 2.5);
  const auto table = PlausibilityTable(scores);
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"b", "2.50", "person 2", "no"}));
}

}  // namespace
}  // namespace daumier::eval
