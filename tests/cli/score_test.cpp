// `daumier score` as its users run it.
#include "core/files.h"
#include "core/json.h"
#include "datasets/build/sketch_views.h"
#include "eval/drawing_score.h"
#include "faces/face_database.h"
#include "geometry/obj.h"
#include "render/framing.h"
#include "tests/cli/pipeline.h"
#include "tests/support/synthetic_database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Predictions of the mean face of the shipped face model, with labels of two drawings that it fits exactly.
class ScoreCommand : public ::testing::Test {
 protected:
  ScoreCommand() : face_(faces::ReadFaceTemplate(SourceRoot() / "weights/face-ict")) {
    const render::Placement frame{0.5, {10, 20}, 8};
    const eval::DrawingScorer scorer(
        face_, datasets::SketchCamera(face_, faces::View::kFrontal, render::FrameOptions{}.curve_height));
    const Eigen::MatrixX2d on_sheet = scorer.OnPicture({face_.neutral, frame});
    const faces::FacePointVertices vertices = faces::FindFacePoints(face_);
    Json points = Json::object();
    for (const faces::FacePoint point : {faces::FacePoint::kEyeRightOuter, faces::FacePoint::kEyeLeftOuter,
                                         faces::FacePoint::kMouthLeft, faces::FacePoint::kChin}) {
      const Eigen::Vector2d at = faces::ProjectedFacePoint(vertices, point, on_sheet, {0, 0});
      points[faces::kFacePointNames[size_t(point)]] = {at.x(), at.y()};
    }
    const Json drawing = {
        {"file", "a.png"}, {"points", points}, {"interocular", 100}, {"mouth", "closed"}, {"eyes", "open"}};
    WriteFileAtomically(folder_ / "labels.json", Json{{"drawings", {{"a", drawing}}}}.dump());
    MakeDirectory(folder_ / "predicted");
    WriteMesh("predicted/a.obj", face_.neutral);
    WriteFileAtomically(folder_ / "predicted/manifest.json",
                        Json{{"details", {{"drawings", {{"a", {{"frame", render::PlacementToJson(frame)}}}}}}}}.dump());
  }
  void WriteMesh(const std::string& name, const geometry::Points& vertices) const {
    geometry::WriteObj(folder_ / name, faces::SurfaceMesh(face_, vertices));
  }
  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  ProcessResult Score(const std::vector<std::string>& options) const {
    std::vector<std::string> words{"score", In("predicted")};
    words.insert(words.end(), options.begin(), options.end());
    return Daumier(words);
  }

  const std::string template_ = (SourceRoot() / "weights/face-ict").string();
  const faces::FaceTemplate face_;
  const TempDir folder_;
};

TEST_F(ScoreCommand, MeasuresLabelledDrawings) {
  const ProcessResult json = Score({"--labels", In("labels.json"), "--template", template_, "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const Json group = Json::parse(json.out).at("groups").at(0);
  EXPECT_EQ(group.at("num_drawings"), 1);
  EXPECT_LT(group.at("nme").get<double>(), 1e-3) << "the labels are the face's own points";
  EXPECT_EQ(group.at("eyes_right"), 1);
  const ProcessResult text = Score({"--labels", In("labels.json"), "--template", template_});
  EXPECT_THAT(text.out, AllOf(HasSubstr("NME"), HasSubstr("pictures"), HasSubstr("mean face placed best")));
}

TEST_F(ScoreCommand, MeasuresMeshesAgainstTrueOnes) {
  MakeDirectory(folder_ / "truth");
  geometry::Points moved = face_.neutral;
  moved.col(0).array() += 0.1;
  WriteMesh("truth/a.obj", moved);
  const ProcessResult json = Score({"--truth", In("truth"), "--template", template_, "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const Json result = Json::parse(json.out);
  EXPECT_NEAR(result.at("mean_vertex_error_mm").get<double>(), 0.1 * faces::MillimetresPerCm(face_), 1e-3);
  EXPECT_NEAR(result.at("aligned").at("mean").get<double>(), 0, 1e-3);
}

TEST_F(ScoreCommand, MeasuresHowNearFacesAreToOthers) {
  BuildSyntheticFaces(folder_ / "faces");
  const faces::FaceDatabase database(folder_ / "faces");
  MakeDirectory(folder_ / "meshes");
  geometry::WriteObj(folder_ / "meshes/own.obj", faces::SurfaceMesh(database.face_template(), database.points(3)));
  geometry::Points folded = database.points(3);
  folded.col(1) = folded.col(1).cwiseAbs();
  geometry::WriteObj(folder_ / "meshes/folded.obj", faces::SurfaceMesh(database.face_template(), folded));
  const ProcessResult json = Daumier({"score", In("meshes"), "--plausible", In("faces"), "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const Json result = Json::parse(json.out);
  EXPECT_EQ(result.at("num_population"), database.num_faces());
  EXPECT_EQ(result.at("num_within"), 1);
  EXPECT_EQ(result.at("predictions")[1].at("name"), "own");
  EXPECT_NEAR(result.at("predictions")[1].at("distance_mm").get<double>(), 0, 1e-3);
  EXPECT_EQ(result.at("predictions")[1].at("nearest"), database.Describe(3));
  const ProcessResult text = Daumier({"score", In("meshes"), "--plausible", In("faces")});
  EXPECT_THAT(text.out, HasSubstr("1 of 2 predictions are within"));
}

TEST_F(ScoreCommand, SaysWhatIsMissing) {
  EXPECT_EQ(Score({}).exit_code, 2);
  EXPECT_THAT(Score({}).err, HasSubstr("one of --labels FILE (of drawings), --truth FOLDER"));
  const ProcessResult no_template = Score({"--labels", In("labels.json")});
  EXPECT_EQ(no_template.exit_code, 2);
  EXPECT_THAT(no_template.err, HasSubstr("Name a run, weights or a folder of faces: --template FOLDER"));
  WriteFileAtomically(folder_ / "predicted/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProcessResult other = Score({"--labels", In("labels.json"), "--template", template_});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("a.obj has 3 vertices (expected 10350"));
  std::filesystem::remove(folder_ / "predicted/manifest.json");
  const ProcessResult no_frames = Score({"--labels", In("labels.json"), "--template", template_});
  EXPECT_EQ(no_frames.exit_code, 1);
  EXPECT_THAT(no_frames.err, HasSubstr("manifest.json is missing: it holds the frame of each drawing"));
}

TEST_F(ScoreCommand, TheTemplateMayBeThatOfWeightsThatNeedIt) {
  const ProcessResult result =
      Score({"--labels", In("labels.json"), "--template", (SourceRoot() / "weights/portrait").string(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LT(Json::parse(result.out).at("groups").at(0).at("nme").get<double>(), 1e-3);
}

TEST_F(ScoreCommand, CountsTheVotesOfAStudy) {
  WriteFileAtomically(folder_ / "votes.csv",
                      "participant,item,method,place,question,value,seconds\n"
                      "1,a,ours,2,best,1,3\n1,a,other,1,best,0,3\n2,a,ours,1,best,1,5\n2,a,other,2,best,0,5\n");
  const ProcessResult text = Daumier({"score", In("votes.csv")});
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, AllOf(HasSubstr("2 of 2"), HasSubstr("0 of 2"), HasSubstr("participants: 2, items: 1")));
  const Json json = Json::parse(Daumier({"score", In("votes.csv"), "--json"}).out);
  EXPECT_EQ(json.at("methods")[1].at("method"), "ours");
  EXPECT_EQ(json.at("methods")[1].at("mean"), 1);
  const ProcessResult both = Daumier({"score", In("votes.csv"), "--labels", In("labels.json")});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("scored alone"));
  WriteFileAtomically(folder_ / "notes.csv", "a,b\n");
  EXPECT_THAT(Daumier({"score", In("notes.csv")}).err, HasSubstr("these are no votes"));
}

}  // namespace
}  // namespace daumier::testing
