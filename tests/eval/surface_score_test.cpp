#include "eval/surface_score.h"

#include "eval/mesh_score.h"
#include "geometry/subdivision.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <limits>

namespace daumier::eval {
namespace {

using testing::ExpectError;

/// A random person of the synthetic model, and another one.
class SurfaceScores : public ::testing::Test {
 protected:
  geometry::Points Person(uint64_t seed) const {
    Rng rng(seed);
    return faces::IdentityFace(model_, faces::DrawIdentity(model_, rng));
  }
  geometry::TriangleMesh Mesh(const geometry::Points& vertices) const {
    return {vertices, model_.face_template.triangles};
  }
  SurfaceScore Score(const geometry::TriangleMesh& mesh, const geometry::Points& truth) const {
    return ScoreSurface(mesh, model_.face_template.annotation.landmarks, truth, model_.face_template);
  }

  const faces::FaceModel model_ = testing::SyntheticModel();
};

geometry::Similarity Some() {
  return {10, Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(), {4, -5, 6}};
}

TEST_F(SurfaceScores, OfThePerfectFaceInAnotherTopologyAreZero) {
  geometry::TriangleMesh finer = geometry::Subdivide(Mesh(Person(1)), 1);
  EXPECT_GT(finer.vertices.rows(), model_.face_template.num_vertices());
  EXPECT_NEAR(Score(finer, Person(1)).mean_mm, 0, 1e-6);
}

TEST_F(SurfaceScores, DoNotDependOnUnitAxesAndPlace) {
  const SurfaceScore plain = Score(Mesh(Person(1)), Person(2));
  const SurfaceScore moved = Score(Mesh(Some().Apply(Person(1))), Person(2));
  EXPECT_GT(plain.mean_mm, 0.1);
  EXPECT_NEAR(moved.mean_mm, plain.mean_mm, 1e-3);
  EXPECT_NEAR(moved.p90_mm, plain.p90_mm, 1e-3);
  EXPECT_NEAR(moved.alignment.scale, plain.alignment.scale / 10, 1e-4);
}

TEST_F(SurfaceScores, AreAtMostThoseOfVertices) {
  for (uint64_t seed = 2; seed < 4; ++seed) {
    const double vertices = ScoreMesh("a", Person(seed), Person(1), model_.face_template).aligned;
    EXPECT_LT(Score(Mesh(Person(seed)), Person(1)).mean_mm, 1.02 * vertices);
  }
}

TEST_F(SurfaceScores, OfAHoleAreTheDistancesToItsBorder) {
  const geometry::Points truth = Person(1);
  geometry::TriangleMesh half = Mesh(truth);
  geometry::Triangles kept(half.triangles.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < half.triangles.rows(); ++f)
    if (truth(half.triangles(f, 0), 1) > truth.col(1).mean()) kept.row(count++) = half.triangles.row(f);
  half.triangles = kept.topRows(count);
  EXPECT_GT(Score(half, truth).p90_mm, 1) << "what a prediction lacks is not free";
}

TEST_F(SurfaceScores, RefuseWhatCannotBeMeasured) {
  geometry::Points mirrored = Person(1);
  mirrored.col(0) *= -1;
  ExpectError([&] { Score(Mesh(mirrored), Person(1)); }, "mirror image");
  geometry::Points broken = Person(1);
  broken(3, 1) = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { Score(Mesh(broken), Person(1)); }, "no finite number");
  LandmarkVertices few;
  few.fill(-1);
  few[30] = 5;
  ExpectError([&] { ScoreSurface(Mesh(Person(1)), few, Person(1), model_.face_template); }, "1 landmarks, expected 6");
  LandmarkVertices beyond = model_.face_template.annotation.landmarks;
  beyond[40] = 100000;
  ExpectError([&] { ScoreSurface(Mesh(Person(1)), beyond, Person(1), model_.face_template); },
              "landmark 40 is vertex 100000");
}

TEST(FrameMistake, NamesUnitAndAxes) {
  EXPECT_FALSE(FrameMistake({}).has_value());
  EXPECT_FALSE(
      FrameMistake({1.2, Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix(), {}}).has_value());
  const auto text = [](const geometry::Similarity& alignment) { return FrameMistake(alignment).value_or(""); };
  EXPECT_NE(text({0.1}).find("millimetres"), std::string::npos);
  EXPECT_NE(text({100}).find("metres"), std::string::npos);
  EXPECT_NE(text({3}).find("another unit"), std::string::npos);
  // z up and the face to -y, as in Blender: the rotation takes z to y.
  const Eigen::Matrix3d from_blender =
      Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NE(text({1, from_blender, {}}).find("their +z seems to point upwards"), std::string::npos);
  EXPECT_NE(
      text({0.1, from_blender, {}}).find("millimetres, expected centimetres: multiply them by about 0.1; they are"),
      std::string::npos);
}

}  // namespace
}  // namespace daumier::eval
