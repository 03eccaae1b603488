#include "benchmark/inputs.h"

#include "tests/support/small_kit.h"

#include <gtest/gtest.h>
#include <Eigen/SVD>

#include <algorithm>
#include <set>

namespace daumier::benchmark {
namespace {

class KitInputs : public ::testing::Test {
 protected:
  KitInputs() {
    testing::BuildSyntheticFaces(folder_ / "faces", 3);
    testing::BuildSyntheticSketches(folder_ / "faces", folder_ / "sketches");
  }
  const testing::TempDir folder_;
};

TEST_F(KitInputs, DrawingsOfAFaceDifferByStyleAlone) {
  const faces::FaceDatabase faces(folder_ / "faces");
  const datasets::SketchDatabase sketches(folder_ / "sketches");
  const DrawingsOptions options = testing::SmallKitOptions().drawings;
  const std::vector<KitDrawing> drawings = DrawingsOf(faces, sketches, options, 1, 5);
  ASSERT_EQ(drawings.size(), 6u);
  std::set<std::string> names, groups;
  for (const KitDrawing& drawing : drawings) {
    EXPECT_EQ(faces.id(drawing.face).person, 1);
    EXPECT_EQ(drawing.picture.height, 128);
    EXPECT_LT(*std::ranges::min_element(drawing.picture.pixels), 128) << "there is ink";
    names.insert(drawing.item.name);
    groups.insert(drawing.item.group);
  }
  EXPECT_EQ(names.size(), 6u);
  EXPECT_EQ(groups, (std::set<std::string>{"clean", "drawn", "rough"}));
  EXPECT_EQ(drawings[0].face, drawings[2].face);
  EXPECT_NE(faces.id(drawings[0].face).level, faces.id(drawings[3].face).level) << "levels take turns";
  EXPECT_FALSE(drawings[0].picture == drawings[2].picture);
  EXPECT_EQ(drawings[4].picture, DrawingsOf(faces, sketches, options, 1, 5)[4].picture);
}

/// Without noise the fixed landmarks are an affine image of those in space.
TEST_F(KitInputs, LandmarksOfCaricaturesAreAViewOfThoseInSpace) {
  const faces::FaceDatabase faces(folder_ / "faces");
  CaricaturesOptions options;
  options.noise = 0;
  for (const KitCaricature& made : CaricaturesOf(faces, options, 2, 5)) {
    EXPECT_EQ(faces.id(made.face).level, faces.num_levels() - 1);
    Eigen::MatrixXd places(51, 4), pixels(51, 2);
    for (int i = 17; i < 68; ++i) {
      places.row(i - 17) << made.places.row(i), 1;
      pixels.row(i - 17) << made.pixels[size_t(2 * i)], made.pixels[size_t(2 * i + 1)];
    }
    const Eigen::MatrixXd map = places.bdcSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).solve(pixels);
    EXPECT_LT((places * map - pixels).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_GT(made.pixels[2 * 45], made.pixels[2 * 36]) << "the face's left eye is on the right";
    EXPECT_GT(made.pixels[2 * 8 + 1], made.pixels[2 * 27 + 1]) << "y points down";
  }
  options.noise = 0.02;
  EXPECT_NE(CaricaturesOf(faces, options, 2, 5)[0].pixels, CaricaturesOf(faces, {}, 2, 5)[0].pixels);
}

TEST(FaceName, HasPersonAndLetter) {
  EXPECT_EQ(FaceName(7, 1), "person-007-b");
}

}  // namespace
}  // namespace daumier::benchmark
