#include "datasets/build/level_measures.h"

#include "faces/openings.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <functional>

namespace daumier::datasets {
namespace {

/// A database of the synthetic face with three levels and two expressions whose faces above level 1 are replaced:
/// `change` has the regular face and the level.
class ChangedLevels {
 public:
  using Change = std::function<geometry::Points(const faces::FaceTemplate&, const geometry::Points&, int level)>;

  ChangedLevels(int num_persons, const Change& change) {
    FacesOptions options = testing::SyntheticFacesOptions(num_persons);
    options.expressions = {"neutral", "smile"};
    options.exaggeration.gammas = {0.0, 0.1, 0.2};
    BuildFaces(testing::SyntheticModel(), options, folder_ / "faces");
    const faces::FaceDatabase built(folder_ / "faces");
    for (int person = 0; person < num_persons; ++person) {
      std::vector<float> vertices;
      for (int level = 0; level < built.num_levels(); ++level) {
        for (int expression = 0; expression < built.num_expressions(); ++expression) {
          const geometry::Points regular = built.points(built.index({person, 0, expression}));
          const geometry::Points points = level == 0 ? regular : change(built.face_template(), regular, level);
          vertices.insert(vertices.end(), points.data(), points.data() + points.size());
        }
      }
      SafetensorsWriter shard;
      shard.Add<float>("vertices", {built.num_levels(), built.num_expressions(), built.num_vertices(), 3}, vertices);
      shard.Add<float>("identity_weights", {int64_t(built.identity_weights(person).size())},
                       built.identity_weights(person));
      shards_.emplace_back(folder_ / "faces" / PersonName(person), shard);
    }
  }

  std::vector<LevelMeasures> Measure() const {
    for (const auto& [path, shard] : shards_) shard.Write(path);
    return MeasureLevels(faces::FaceDatabase(folder_ / "faces", Checksums::kSkip));
  }

 private:
  static std::string PersonName(int person) { return faces::PersonShardName(person); }

  const testing::TempDir folder_;
  std::vector<std::pair<std::filesystem::path, SafetensorsWriter>> shards_;
};

TEST(MeasureLevels, RegularFacesAreRecognisedAndDoNotMoveOrCross) {
  const ChangedLevels faces(5, [](const auto&, const geometry::Points& face, int) { return face; });
  const auto rows = faces.Measure();
  ASSERT_EQ(rows.size(), 2u);
  for (const LevelMeasures& row : rows) {
    EXPECT_EQ(row.num_persons, 5);
    EXPECT_NEAR(row.displacement_mm, 0, 1e-4);
    EXPECT_EQ(row.own_by_angle, 1);
    EXPECT_EQ(row.own_by_distance, 1);
    EXPECT_EQ(row.num_faces, 10);
    EXPECT_EQ(row.num_faces_flipped, 0);
    EXPECT_EQ(row.num_lips_crossed + row.num_lids_crossed, 0);
  }
  EXPECT_EQ(rows[1].level, 2);
  EXPECT_EQ(rows[1].gamma, 0.2);
}

TEST(MeasureLevels, ASimilarityDoesNotMove) {
  const ChangedLevels faces(3, [](const auto&, const geometry::Points& face, int level) -> geometry::Points {
    return (face * (1 + 0.2 * level)).rowwise() + Eigen::RowVector3d(4, 0, 1);
  });
  for (const LevelMeasures& row : faces.Measure()) {
    EXPECT_NEAR(row.displacement_mm, 0, 1e-3);
    EXPECT_EQ(row.own_by_angle, 1);
    EXPECT_EQ(row.own_by_distance, 1);
  }
}

TEST(MeasureLevels, MultipliedDeviationsAreRecognisedByTheAngle) {
  geometry::Points mean;
  {
    const testing::TempDir folder;
    FacesOptions options = testing::SyntheticFacesOptions(8);
    options.expressions = {"neutral", "smile"};
    BuildFaces(testing::SyntheticModel(), options, folder / "faces");
    const faces::FaceDatabase database(folder / "faces");
    mean = geometry::Points::Zero(database.num_vertices(), 3);
    for (int person = 0; person < 8; ++person) mean += database.points(database.index({person, 0, 0})) / 8;
  }
  const ChangedLevels faces(8, [&](const auto&, const geometry::Points& face, int level) -> geometry::Points {
    return mean + (1 + 2 * level) * (face - mean);
  });
  const auto rows = faces.Measure();
  EXPECT_EQ(rows[0].own_by_angle, 1);
  EXPECT_EQ(rows[1].own_by_angle, 1);
  EXPECT_GT(rows[0].displacement_mm, 0);
  EXPECT_GT(rows[1].displacement_mm, 1.7 * rows[0].displacement_mm);
}

TEST(MeasureLevels, OneFaceForAllIsRecognisedOnce) {
  const geometry::Points one = testing::SyntheticModel().face_template.neutral;
  const ChangedLevels faces(5, [&](const auto&, const geometry::Points&, int) { return one; });
  for (const LevelMeasures& row : faces.Measure()) {
    EXPECT_EQ(row.own_by_angle, 0.2);
    EXPECT_EQ(row.own_by_distance, 0.2);
  }
}

TEST(MeasureLevels, CountsCrossedLipsAndLids) {
  const ChangedLevels faces(
      3, [](const faces::FaceTemplate& face_template, const geometry::Points& face, int level) -> geometry::Points {
        const faces::FaceOpenings openings = faces::FindOpenings(face_template);
        const faces::Opening& opening = level == 1 ? openings.lips : openings.lids[1];
        geometry::Points crossed = face;
        for (const auto& [upper, lower] : opening.pairs) crossed(lower, 1) = face(upper, 1) + 0.3;
        return crossed;
      });
  const auto rows = faces.Measure();
  EXPECT_EQ(rows[0].num_lips_crossed, 6);
  EXPECT_EQ(rows[0].num_lids_crossed, 0);
  EXPECT_EQ(rows[1].num_lips_crossed, 0);
  EXPECT_EQ(rows[1].num_lids_crossed, 6);
  const double mm = 0.3 * faces::MillimetresPerCm(testing::SyntheticModel().face_template);
  EXPECT_NEAR(rows[0].lips_crossed_mm, mm, 0.2 * mm);
  EXPECT_NEAR(rows[1].lids_crossed_mm, mm, 0.2 * mm);
}

TEST(MeasureLevels, CountsFlippedTriangles) {
  const ChangedLevels faces(2, [](const faces::FaceTemplate& face_template, const geometry::Points& face, int level) {
    geometry::Points flipped = face;
    const int nose = face_template.annotation.landmarks[30];
    if (level == 2) flipped.row(nose) += Eigen::RowVector3d(6, 0, 0);
    return flipped;
  });
  const auto rows = faces.Measure();
  EXPECT_EQ(rows[0].num_faces_flipped, 0);
  EXPECT_EQ(rows[0].most_flipped, 0);
  EXPECT_EQ(rows[1].num_faces_flipped, 4);
  EXPECT_GT(rows[1].most_flipped, 0);
}

TEST(MeasureLevels, NeedsTwoLevelsAndPersons) {
  const testing::TempDir folder;
  FacesOptions options = testing::SyntheticFacesOptions(2);
  options.exaggeration.gammas = {0.0};
  options.expressions = {"neutral"};
  BuildFaces(testing::SyntheticModel(), options, folder / "faces");
  testing::ExpectError([&] { MeasureLevels(faces::FaceDatabase(folder / "faces")); }, "2 persons in 1 levels");
}

}  // namespace
}  // namespace daumier::datasets
