#include "studio/drawn_database.h"

#include "core/files.h"
#include "core/manifest.h"
#include "datasets/build/sketch_lines.h"
#include "datasets/build/sketch_views.h"
#include "datasets/read/sketch_database.h"
#include "datasets/read/sketch_variation.h"
#include "datasets/read/splits.h"
#include "datasets/read/training_fit.h"
#include "tests/studio/pen_drawings.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

using testing::TempDir;

class DrawnDatabaseTest : public ::testing::Test {
 protected:
  /// Drawings of faces that grow from one to the next; two of each group.
  DrawnFaces Drawn(int count) const {
    DrawnFaces drawn{
        .face_template = face_template_,
        .sources = Json::array({{{"name", "test"}, {"licence", "CC0-1.0"}}}),
        .drawings = {},
        .vertices = [this](int drawing) { return geometry::Points(Factor(drawing) * face_template_.neutral); },
        .read = [](int) { return testing::PenDrawing("1", "a"); }};
    for (int i = 0; i < count; ++i)
      drawn.drawings.push_back({fmt::format("{:05}", i + 1), Sha256(std::to_string(i)), fmt::format("face-{:05}", i),
                                fmt::format("person {}", i / 2)});
    return drawn;
  }
  static double Factor(int drawing) { return 1 + 0.01 * drawing; }

  const faces::FaceTemplate face_template_ = testing::SyntheticModel().face_template;
  const TempDir folder_;
};

TEST_F(DrawnDatabaseTest, ReadersFindADrawingAndItsFaceSideBySide) {
  WriteDrawnDatabase(folder_.path(), Drawn(3));
  const faces::FaceDatabase faces(folder_ / "faces");
  const datasets::SketchDatabase sketches(folder_ / "sketches");
  ASSERT_EQ(faces.num_faces(), 3);
  ASSERT_EQ(sketches.num_faces(), 3);
  EXPECT_TRUE(faces.points(2).isApprox(Factor(2) * face_template_.neutral, 1e-6));
  EXPECT_EQ(faces.groups(), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(sketches.manifest().details.at("faces_data_hash"), DataHash(folder_ / "faces"));
  EXPECT_EQ(faces.manifest().sources, Drawn(3).sources);

  EXPECT_EQ(sketches.num_drawn_views(), 1);
  EXPECT_EQ(sketches.num_views(), 2);
  const std::vector<render::Stroke> drawn = sketches.strokes(1);
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_EQ(sketches.kinds()[size_t(drawn[0].kind)], "drawn");
  EXPECT_EQ(drawn[1].points.size(), 41u);
  const datasets::SketchLines lines(face_template_, faces::View::kFrontal, {});
  const std::vector<render::Stroke> exact = lines.Draw(Factor(1) * face_template_.neutral, sketches.camera());
  ASSERT_EQ(sketches.strokes(1, 1).size(), exact.size());
  EXPECT_EQ(sketches.strokes(1, 1)[0].points, exact[0].points);
  EXPECT_EQ(sketches.curve_points(1).size(), 2 * size_t(lines.num_curve_points()));
  EXPECT_EQ(sketches.curve_points(1), sketches.curve_points(1, 1));
}

TEST_F(DrawnDatabaseTest, ANetworkReadsTheDrawingAndTheCurvesOfItsFace) {
  WriteDrawnDatabase(folder_.path(), Drawn(1));
  const datasets::SketchDatabase sketches(folder_ / "sketches");
  const datasets::AugmentedSketch sketch = datasets::VariedSketch(sketches, 0, {}, 1, 0);
  EXPECT_EQ(sketch.strokes.size(), 2u);
  EXPECT_EQ(sketch.moved.size(), sketches.strokes(0, 1).size());
  EXPECT_EQ(datasets::PointsOf(sketch.moved, sketches.feature_curves()),
            datasets::PointsOf(sketches.strokes(0, 1), sketches.feature_curves()));
  testing::ExpectError([&] { sketches.facts(0); }, "sketches of version 3, which lack landmarks");
}

TEST_F(DrawnDatabaseTest, TheModelsOfATrainingAreFitted) {
  WriteDrawnDatabase(folder_.path(), Drawn(6));
  const faces::FaceDatabase faces(folder_ / "faces");
  const datasets::SketchDatabase sketches(folder_ / "sketches");
  const datasets::Split split = datasets::MakeSplit(faces, {.validation = 0.3, .test = 0.3}, 1);
  EXPECT_EQ(split.test.size(), 2u) << "both drawings of a person";
  faces::BilinearOptions options;
  options.num_identity = 1;
  options.num_expression = 1;
  const datasets::FittedBilinear curves = datasets::FitCurvesOnTraining(faces, sketches, split, options);
  EXPECT_EQ(curves.model.num_coordinates(),
            int(datasets::PointsOf(sketches.strokes(0, 1), sketches.feature_curves()).size()));
}

TEST_F(DrawnDatabaseTest, OneMoreDrawingWritesOneMoreShard) {
  WriteDrawnDatabase(folder_.path(), Drawn(2));
  const auto shard = folder_ / "sketches/shards/person-00000.safetensors";
  const auto time = std::filesystem::last_write_time(shard);
  DrawnFaces more = Drawn(3);
  std::vector<int> read;
  more.read = [&read](int drawing) {
    read.push_back(drawing);
    return testing::PenDrawing("1", "a");
  };
  WriteDrawnDatabase(folder_.path(), more);
  EXPECT_EQ(read, (std::vector<int>{2}));
  EXPECT_EQ(std::filesystem::last_write_time(shard), time);
  EXPECT_EQ(datasets::SketchDatabase(folder_ / "sketches").num_faces(), 3);
  const std::string hash = DataHash(folder_ / "sketches");
  const TempDir at_once;
  WriteDrawnDatabase(at_once.path(), Drawn(3));
  EXPECT_EQ(DataHash(at_once / "sketches"), hash) << "the same bytes as written at once";
}

TEST_F(DrawnDatabaseTest, ACallRepairsWhatAKilledProgramLeft) {
  WriteDrawnDatabase(folder_.path(), Drawn(2));
  const std::string hash = DataHash(folder_ / "sketches");
  std::filesystem::remove(folder_ / "sketches/manifest.json");
  std::filesystem::remove(folder_ / "faces/shards/person-00001.safetensors");
  WriteDrawnDatabase(folder_.path(), Drawn(2));
  EXPECT_EQ(DataHash(folder_ / "sketches"), hash);
  EXPECT_EQ(faces::FaceDatabase(folder_ / "faces").num_faces(), 2);
}

TEST_F(DrawnDatabaseTest, WithoutADrawingNothingIsWritten) {
  WriteDrawnDatabase(folder_.path(), Drawn(0));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "faces"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "sketches"));
}

}  // namespace
}  // namespace daumier::studio
