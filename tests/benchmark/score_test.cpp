#include "benchmark/score.h"

#include "geometry/alignment.h"
#include "geometry/subdivision.h"
#include "tests/support/expect_error.h"
#include "tests/support/kit_predictions.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace daumier::benchmark {
namespace {

using testing::ExpectError;
using testing::SmallKit;

class KitScore : public ::testing::Test {
 protected:
  KitScores Score(KitTask task) const { return ScorePredictions(folder_.path(), kit_, task, KitSplit::kTest); }
  double Mean(KitTask task, const char* key) const { return KitScoresToJson(Score(task)).at(key).at("mean"); }
  void Clear() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) std::filesystem::remove(entry.path());
  }
  const Kit kit_{SmallKit()};
  const testing::TempDir folder_;
};

geometry::Points Moved(const geometry::Points& face) {
  const geometry::Similarity similarity{
      10, Eigen::AngleAxisd(2, Eigen::Vector3d(3, 1, 2).normalized()).toRotationMatrix(), {1, 2, 3}};
  return similarity.Apply(face);
}

TEST_F(KitScore, OfThePerfectPredictionIsZero) {
  for (const KitTask task : {KitTask::kDrawings, KitTask::kCaricatures, KitTask::kPortraits}) {
    testing::WriteTrueFaces(kit_, task, folder_.path());
    EXPECT_LT(Mean(task, "vertex_error_mm"), 1e-4) << kKitTaskNames[size_t(task)];
    EXPECT_LT(Mean(task, "surface_error_mm"), 1e-4);
    Clear();
  }
  testing::WriteTrueLandmarks(kit_, folder_.path());
  EXPECT_LT(Mean(KitTask::kLandmarks, "nme_percent"), 1e-3);
}

TEST_F(KitScore, IsFreeOfUnitAndAxesAndNamesThem) {
  testing::WriteTrueFaces(kit_, KitTask::kCaricatures, folder_.path(), {}, Moved);
  const KitScores scores = Score(KitTask::kCaricatures);
  EXPECT_LT(KitScoresToJson(scores).at("vertex_error_mm").at("mean").get<double>(), 1e-3);
  EXPECT_NE(scores.frame_mistake.value_or("").find("millimetres"), std::string::npos);
  EXPECT_NE(scores.frame_mistake.value_or("").find("turned by"), std::string::npos);
}

TEST_F(KitScore, OfExchangedPersonsIsWorse) {
  const size_t count = kit_.items(KitTask::kCaricatures, KitSplit::kTest).size();
  testing::WriteTrueFaces(kit_, KitTask::kCaricatures, folder_.path(), [=](size_t i) { return (i + 2) % count; });
  EXPECT_GT(Mean(KitTask::kCaricatures, "vertex_error_mm"), 1);
  EXPECT_GT(Mean(KitTask::kCaricatures, "surface_error_mm"), 0.5);
}

TEST_F(KitScore, CountsWhatIsMissingAsTheMean) {
  testing::WriteTrueFaces(kit_, KitTask::kCaricatures, folder_.path());
  std::filesystem::remove(folder_ / "person-008-b.ply");
  const KitScores scores = Score(KitTask::kCaricatures);
  EXPECT_EQ(scores.num_missing(), 1);
  const Json json = KitScoresToJson(scores);
  EXPECT_EQ(json.at("num_items"), 6);
  EXPECT_EQ(json.at("num_missing"), 1);
  EXPECT_EQ(json.at("missing"), Json::array({"person-008-b"}));
  testing::WriteFace(kit_, folder_ / "person-008-b.ply", MeanTrainingFace(kit_, KitTask::kCaricatures));
  EXPECT_NEAR(Mean(KitTask::kCaricatures, "vertex_error_mm"), json.at("vertex_error_mm").at("mean").get<double>(),
              1e-4);
  EXPECT_GT(json.at("vertex_error_mm").at("mean").get<double>(), 0.1);
}

TEST_F(KitScore, OfAnotherTopologyIsThatOfTheSurface) {
  for (const KitItem& item : kit_.items(KitTask::kCaricatures, KitSplit::kTest)) {
    const geometry::Points face = kit_.TrueFace(KitTask::kCaricatures, KitSplit::kTest, item);
    geometry::WritePly(folder_ / (item.name + ".ply"),
                       geometry::Subdivide(geometry::TriangleMesh{face, kit_.face_template().triangles}, 1));
  }
  ExpectError([&] { Score(KitTask::kCaricatures); }, "write landmarks.txt");
  std::string lines;
  for (const int vertex : kit_.face_template().annotation.landmarks) lines += fmt::format("{}\n", vertex);
  WriteFileAtomically(folder_ / "landmarks.txt", lines);
  const Json json = KitScoresToJson(Score(KitTask::kCaricatures));
  EXPECT_EQ(json.at("topology"), "own");
  EXPECT_FALSE(json.contains("vertex_error_mm"));
  EXPECT_LT(json.at("surface_error_mm").at("mean").get<double>(), 1e-3);
}

TEST_F(KitScore, RefusesAMirrorImageNamingTheFile) {
  testing::WriteTrueFaces(kit_, KitTask::kCaricatures, folder_.path(), {}, [](geometry::Points face) {
    face.col(0) *= -1;
    return face;
  });
  ExpectError([&] { Score(KitTask::kCaricatures); }, "person-007-a.ply: it is a mirror image");
}

TEST_F(KitScore, OfLandmarksNamesTheWrongUnit) {
  const double size = kit_.portrait_size();
  testing::WriteTrueLandmarks(kit_, folder_.path(), [=](double& x, double& y) { x /= size, y /= size; });
  ExpectError([&] { Score(KitTask::kLandmarks); }, "Multiply them by the picture's size");
  testing::WriteTrueLandmarks(kit_, folder_.path(), [=](double&, double& y) { y = size - y; });
  ExpectError([&] { Score(KitTask::kLandmarks); }, "upwards");
}

/// One landmark of 68 is moved by the distance of the eye corners: NME 1 / 68.
TEST_F(KitScore, OfLandmarksByHand) {
  MakeDirectory(folder_.path());
  for (const KitItem& item : kit_.items(KitTask::kLandmarks, KitSplit::kTest)) {
    eval::LandmarkRow row = kit_.TrueLandmarks(KitSplit::kTest, item);
    row[0] += std::hypot(row[72] - row[90], row[73] - row[91]);
    WriteFileAtomically(folder_ / (item.name + ".txt"), testing::LandmarkLines(row));
  }
  EXPECT_NEAR(Mean(KitTask::kLandmarks, "nme_percent"), 100.0 / 68, 1e-3);
}

TEST_F(KitScore, IsARowThatNamesKitPredictionsAndMethod) {
  testing::WriteTrueFaces(kit_, KitTask::kDrawings, folder_.path());
  WriteFileAtomically(folder_ / "method.json", R"({"name": "truth", "command": "cp"})");
  const KitScores scores = Score(KitTask::kDrawings);
  const Json json = KitScoresToJson(scores);
  EXPECT_EQ(json.at("benchmark"), "small");
  EXPECT_EQ(json.at("kit_hash"), DataHash(SmallKit()));
  EXPECT_EQ(json.at("method").at("name"), "truth");
  EXPECT_EQ(json.at("groups").size(), 3u);
  EXPECT_EQ(json.at("items").size(), 18u);
  const reports::ReportTable table = KitScoreTable(scores);
  EXPECT_EQ(table.rows.size(), 2u + 2 * 3) << "two measures of all and of three styles";
}

}  // namespace
}  // namespace daumier::benchmark
