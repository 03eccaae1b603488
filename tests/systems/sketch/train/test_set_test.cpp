#include "systems/sketch/train/test_set.h"

#include "eval/metrics.h"
#include "tests/support/expect_error.h"
#include "tests/systems/sketch/train/run_fixture.h"

#include <array>
#include <cmath>

namespace daumier::sketch {
namespace {

class SketchTestSetTest : public SketchRunFixture {
 protected:
  SketchTestSetTest() : data_(OpenSketchRunData(*folder_ / "run")), test_(data_, {}, {}) {}

  /// The true faces, moved by `shift_cm` along x.
  eval::FaceRows Shifted(const FaceBlock& block, float shift_cm) const {
    eval::FaceRows rows(Eigen::Index(block.faces.size()), test_.num_coordinates());
    for (size_t i = 0; i < block.faces.size(); ++i) {
      const std::span<const float> truth = data_.faces.vertices(block.faces[i]);
      rows.row(Eigen::Index(i)) = Eigen::Map<const Eigen::RowVectorXf>(truth.data(), test_.num_coordinates());
      for (Eigen::Index x = 0; x < rows.cols(); x += 3) rows(Eigen::Index(i), x) += shift_cm;
    }
    return rows;
  }

  const SketchRunData data_;
  const SketchTestSet test_;
};

TEST_F(SketchTestSetTest, AShiftedFaceHasTheErrorOfTheShift) {
  const double mm = 0.5 * faces::MillimetresPerCm(data_.faces.face_template());
  const SketchErrors errors = test_.Measure("shifted", [&](const FaceBlock& block) { return Shifted(block, 0.5f); });
  ASSERT_EQ(errors.of_faces.size(), test_.faces().size());
  for (const double error : errors.of_faces) EXPECT_NEAR(error, mm, 1e-4);
  for (const double error : errors.of_vertices) EXPECT_NEAR(error, mm, 1e-4);
  const reports::MetricRow row = test_.Row("shifted", "none", errors);
  EXPECT_EQ(row.input, "none");
  EXPECT_NEAR(row.error().mean, mm, 1e-4);
  const std::span<const float> truth = data_.faces.vertices(test_.faces()[0]);
  const auto& landmarks = data_.faces.face_template().annotation.landmarks;
  const double eyes =
      faces::MillimetresPerCm(data_.faces.face_template()) * eval::VertexDistance(truth, landmarks[36], landmarks[45]);
  EXPECT_NEAR(*reports::ValueOf(test_.EmptyTable(), row, "interocular_share"), mm / eyes, 0.1 * mm / eyes);
}

TEST_F(SketchTestSetTest, PredictorsThatBuildOnEachOtherRunTogether) {
  int num_blocks = 0;
  const std::vector<SketchErrors> errors = test_.Measure("both", 2, [&](const FaceBlock& block) {
    ++num_blocks;
    return std::vector{Shifted(block, 0), Shifted(block, 1)};
  });
  EXPECT_EQ(num_blocks, 1) << "fewer faces than a block";
  EXPECT_EQ(errors[0].of_faces[0], 0);
  EXPECT_GT(errors[1].of_faces[0], 1);
}

TEST_F(SketchTestSetTest, NumbersOutsideOfTheRegionAreNotANumber) {
  std::vector<double> ones(size_t(data_.faces.num_vertices()), 1.0);
  const Eigen::VectorXd kept = test_.InRegion(ones);
  EXPECT_EQ(kept.array().isNaN().count(), kept.size() - Eigen::Index(test_.region().size()));
  EXPECT_EQ(kept[test_.region()[0]], 1.0);
  for (const auto& [region, error] : test_.RegionErrors(ones)) EXPECT_DOUBLE_EQ(error, 1.0) << region;
  const std::span<const float> truth = data_.faces.vertices(0);
  EXPECT_EQ(test_.ErrorMap(truth, 0)[test_.region()[0]], 0);
}

TEST_F(SketchTestSetTest, ReportsProgressAndStops) {
  std::stop_source stop;
  std::vector<int64_t> done;
  const Task task(stop.get_token(), [&](const TaskProgress& progress) { done.push_back(progress.done); });
  const SketchTestSet test(data_, {}, task);
  const auto predict = [&](const FaceBlock& block) { return Shifted(block, 0); };
  test.Measure("exact", predict);
  EXPECT_EQ(done, (std::vector<int64_t>{0, int64_t(test.faces().size())}));
  stop.request_stop();
  EXPECT_THROW(test.Measure("exact", predict), Cancelled);
}

TEST_F(SketchTestSetTest, OptionsSayHowSketchesAreDrawn) {
  const int face = test_.faces()[0];
  const auto points = [&](const SketchEvalOptions& options) {
    std::vector<std::vector<std::array<float, 2>>> lines;
    for (const render::Stroke& stroke : SketchTestSet(data_, options, {}).reader().SketchOf(face).strokes)
      lines.push_back(stroke.points);
    return lines;
  };
  const auto exact = points({}), styled = points({.styled = true});
  std::vector<std::vector<std::array<float, 2>>> of_database;
  for (const render::Stroke& stroke : data_.sketches.strokes(face)) of_database.push_back(stroke.points);
  EXPECT_EQ(exact, of_database);
  EXPECT_NE(styled, exact);
  EXPECT_NE(points({.strength = 1}), exact);
  EXPECT_EQ(points({.styled = true}), styled);
}

TEST_F(SketchTestSetTest, AnErrorThatIsNotFiniteIsRefusedByTheNameOfItsRow) {
  const SketchErrors errors = test_.Measure("row", [&](const FaceBlock& block) { return Shifted(block, NAN); });
  testing::ExpectError([&] { test_.Row("network", "none", errors); }, "row 'network'");
}

}  // namespace
}  // namespace daumier::sketch
