#include "eval/drawing_score.h"

#include "core/files.h"
#include "faces/face_database.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::eval {
namespace {

using Eigen::MatrixX2d;
using Eigen::Vector2d;
using faces::FacePoint;

render::Camera CameraOfScores() {
  return render::FrontalCamera({0, 0, 0}, 14, render::kSketchCanvas);
}

/// The synthetic face, and labels that are its own points on a sheet.
struct SyntheticDrawing {
  LabelledDrawing Labelled(const geometry::Points& vertices, const render::Placement& frame,
                           const Vector2d& offset = Vector2d::Zero()) const {
    LabelledDrawing drawing{.name = "face", .group = "pictures"};
    const MatrixX2d on_sheet = scorer.OnPicture({vertices, frame});
    for (size_t i = 0; i < drawing.points.size(); ++i) {
      const auto point = static_cast<FacePoint>(i);
      if (const auto contour = faces::ContourOf(point)) {
        drawing.points[i] = on_sheet.row(points.contours[size_t(*contour)][3]).transpose() + offset;
      } else {
        drawing.points[i] = faces::ProjectedFacePoint(points, point, on_sheet, Vector2d::Zero()) + offset;
      }
    }
    drawing.interocular = (*drawing.points[0] - *drawing.points[5]).norm();
    return drawing;
  }

  const faces::FaceTemplate face = testing::SyntheticFace();
  const faces::FacePointVertices points = faces::FindFacePoints(face);
  const DrawingScorer scorer{face, CameraOfScores()};
  const render::Placement frame{0.5, {12, -7}};
};

/// The neutral face, half as wide again, or with an open mouth.
geometry::Points WideFace(geometry::Points vertices) {
  vertices.col(0) *= 1.5;
  return vertices;
}

TEST(AlignInPlane, FindsTheSimilarity) {
  MatrixX2d points(4, 2), targets(4, 2);
  points << 0, 0, 3, 1, -2, 5, 4, 4;
  const Eigen::Rotation2Dd turn(0.7);
  for (int i = 0; i < 4; ++i) targets.row(i) = (2.5 * (turn * Vector2d(points.row(i))) + Vector2d(3, -8)).transpose();
  const PlaneSimilarity found = AlignInPlane(points, targets);
  EXPECT_LT((found.matrix - 2.5 * turn.toRotationMatrix()).norm(), 1e-12);
  EXPECT_LT((found.shift - Vector2d(3, -8)).norm(), 1e-12);
  testing::ExpectError([&] { AlignInPlane(MatrixX2d::Ones(3, 2), targets.topRows(3)); }, "in one point");
}

TEST(MeanOf, AveragesAllPointsOrThoseOfAPart) {
  PointErrors errors;
  errors[size_t(FacePoint::kMouthLeft)] = 0.1;
  errors[size_t(FacePoint::kInnerTop)] = 0.3;
  errors[size_t(FacePoint::kChin)] = 0.5;
  EXPECT_NEAR(*MeanOf(errors), 0.3, 1e-12);
  EXPECT_NEAR(*MeanOf(errors, 3), 0.2, 1e-12) << "mouth";
  EXPECT_NEAR(*MeanOf(errors, 4), 0.5, 1e-12) << "contour";
  EXPECT_FALSE(MeanOf(errors, 0).has_value());
  EXPECT_FALSE(MeanOf({}).has_value());
}

TEST(DrawnPartOf, GroupsAllPoints) {
  std::array<int, kNumDrawnParts> counts = {};
  for (int i = 0; i < faces::kNumFacePoints; ++i) ++counts[size_t(DrawnPartOf(static_cast<FacePoint>(i)))];
  EXPECT_EQ(counts, (std::array<int, kNumDrawnParts>{10, 4, 3, 6, 3}));
}

TEST(DrawingScorer, ErrorsAreZeroWhereTheLabelsAreTheFace) {
  const SyntheticDrawing drawing;
  const LabelledDrawing labels = drawing.Labelled(drawing.face.neutral, drawing.frame);
  const PointErrors errors =
      drawing.scorer.Errors(drawing.scorer.OnPicture({drawing.face.neutral, drawing.frame}), labels);
  for (const auto& error : errors) EXPECT_NEAR(error.value(), 0, 1e-12);
}

TEST(DrawingScorer, LabelsThreeRightAndFourDownAreFiveOff) {
  const SyntheticDrawing drawing;
  const LabelledDrawing labels = drawing.Labelled(drawing.face.neutral, drawing.frame, {3, 4});
  const MatrixX2d on_sheet = drawing.scorer.OnPicture({drawing.face.neutral, drawing.frame});
  const PointErrors errors = drawing.scorer.Errors(on_sheet, labels);
  for (size_t i = 0; i < errors.size(); ++i) {
    if (faces::ContourOf(static_cast<FacePoint>(i))) {
      EXPECT_LE(*errors[i], 5 / labels.interocular + 1e-12) << "the nearest point of the contour";
    } else {
      EXPECT_NEAR(*errors[i], 5 / labels.interocular, 1e-9) << faces::kFacePointNames[i];
    }
  }
}

TEST(DrawingScorer, AFrameWithATurnIsUndone) {
  const SyntheticDrawing drawing;
  const render::Placement turned{0.5, {12, -7}, 20};
  const LabelledDrawing labels = drawing.Labelled(drawing.face.neutral, turned);
  const Vector2d eyes = *labels.points[5] - *labels.points[0];
  EXPECT_NEAR(std::atan2(eyes.y(), eyes.x()) * 180 / std::numbers::pi, -20, 1e-9) << "on the sheet";
  const PointErrors errors = drawing.scorer.Errors(drawing.scorer.OnPicture({drawing.face.neutral, turned}), labels);
  EXPECT_NEAR(*MeanOf(errors), 0, 1e-12);
}

TEST(DrawingScorer, OfARectifiedSheetThePixelsOfThePhotographCount) {
  const SyntheticDrawing drawing;
  DrawnPrediction prediction{drawing.face.neutral, drawing.frame, Eigen::Matrix3d::Identity()};
  const MatrixX2d on_sheet = drawing.scorer.OnPicture(prediction);
  EXPECT_EQ(on_sheet, drawing.scorer.OnPicture({drawing.face.neutral, drawing.frame}));
  *prediction.picture_from_sheet << 2, 0, 30, 0, 2, 5, 0, 0.001, 1;
  const MatrixX2d in_picture = drawing.scorer.OnPicture(prediction);
  const double x = on_sheet(3, 0), y = on_sheet(3, 1), w = 0.001 * y + 1;
  EXPECT_NEAR(in_picture(3, 0), (2 * x + 30) / w, 1e-9);
  EXPECT_NEAR(in_picture(3, 1), (2 * y + 5) / w, 1e-9);
}

TEST(DrawingScorer, PlacedBestUndoesAnyFrame) {
  const SyntheticDrawing drawing;
  const LabelledDrawing labels = drawing.Labelled(drawing.face.neutral, {0.3, {40, 9}, -35});
  const MatrixX2d placed = drawing.scorer.PlacedBest(drawing.scorer.OnCanvas(drawing.face.neutral), labels);
  EXPECT_LT(*MeanOf(drawing.scorer.Errors(placed, labels)), 1e-4);
}

TEST(DrawingScorer, StatesAreGapsOfLandmarks) {
  const SyntheticDrawing drawing;
  const auto& landmarks = drawing.face.annotation.landmarks;
  geometry::Points face = drawing.face.neutral;
  const auto set_gap = [&](double cm) {
    face.row(landmarks[62]) = face.row(landmarks[66]);
    face(landmarks[62], 1) += cm;
  };
  set_gap(0.16);
  EXPECT_NEAR(drawing.scorer.StatesOf(face).lip_gap_mm, 1.6, 1e-9);
  EXPECT_TRUE(drawing.scorer.StatesOf(face).mouth_is_open());
  set_gap(0.14);
  EXPECT_FALSE(drawing.scorer.StatesOf(face).mouth_is_open());
  set_gap(-0.11);
  EXPECT_TRUE(drawing.scorer.StatesOf(face).lips_cross());
  EXPECT_FALSE(drawing.scorer.StatesOf(face).eyes_are_closed());
  for (const auto& [upper, lower] : {std::pair(37, 41), {38, 40}, {43, 47}, {44, 46}}) {
    face.row(landmarks[size_t(upper)]) = face.row(landmarks[size_t(lower)]);
    face(landmarks[size_t(upper)], 1) += 0.05;
  }
  EXPECT_NEAR(drawing.scorer.StatesOf(face).lid_gap_mm, 0.5, 1e-9);
  EXPECT_TRUE(drawing.scorer.StatesOf(face).eyes_are_closed());
}

TEST(ScoreDrawings, EachDrawingIsRecognisedAmongOthers) {
  const SyntheticDrawing drawing;
  const geometry::Points wide = WideFace(drawing.face.neutral);
  LabelledDrawing first = drawing.Labelled(drawing.face.neutral, drawing.frame),
                  second = drawing.Labelled(wide, drawing.frame), doodle = first, unusable = first;
  first.mouth = faces::MouthState::kOpen;
  second.name = "wide";
  doodle.name = "doodle", doodle.group = "doodles";
  unusable.name = "unusable", unusable.usable = false;
  const std::vector<LabelledDrawing> drawings{first, second, doodle, unusable};
  const std::map<std::string, DrawnPrediction> right = {{"face", {drawing.face.neutral, drawing.frame}},
                                                        {"wide", {wide, drawing.frame}},
                                                        {"doodle", {wide, drawing.frame}}};
  const auto scores = ScoreDrawings(drawing.scorer, drawings, right);
  ASSERT_EQ(scores.size(), 3U) << "those that are usable";
  EXPECT_NEAR(*MeanOf(scores[1].errors), 0, 1e-9);
  EXPECT_GT(*MeanOf(scores[1].mean_face), 0.01);
  EXPECT_NEAR(*MeanOf(scores[0].mean_face), 0, 1e-4) << "its labels are those of the mean face";
  EXPECT_EQ(scores[0].is_recognised, true);
  EXPECT_EQ(scores[1].is_recognised, true);
  EXPECT_FALSE(scores[2].is_recognised.has_value()) << "alone in its group";
  EXPECT_TRUE(scores[0].mouth_is_right.has_value());
  EXPECT_FALSE(scores[1].mouth_is_right.has_value()) << "no label";

  const std::map<std::string, DrawnPrediction> swapped = {{"face", {wide, drawing.frame}},
                                                          {"wide", {drawing.face.neutral, drawing.frame}},
                                                          {"doodle", {wide, drawing.frame}}};
  EXPECT_EQ(ScoreDrawings(drawing.scorer, drawings, swapped)[0].is_recognised, false);

  const auto refused = ScoreDrawings(drawing.scorer, drawings, {{"wide", {wide, drawing.frame}}},
                                     [&](const LabelledDrawing&) { return drawing.frame; });
  EXPECT_EQ(refused[0].is_recognised, false) << "though its labels are those of the mean face";
  EXPECT_EQ(refused[1].is_recognised, true);
}

TEST(ScoreDrawings, WithoutAPredictionTheMeanFaceCounts) {
  const SyntheticDrawing drawing;
  const LabelledDrawing labels = drawing.Labelled(drawing.face.neutral, drawing.frame, {3, 4});
  const auto scores =
      ScoreDrawings(drawing.scorer, std::vector{labels}, {}, [&](const LabelledDrawing&) { return drawing.frame; });
  ASSERT_EQ(scores.size(), 1U);
  EXPECT_FALSE(scores[0].is_predicted);
  EXPECT_NEAR(*scores[0].errors[size_t(FacePoint::kChin)], 5 / labels.interocular, 1e-9);
}

TEST(FrameOfExtents, IsThatOfTheLineOfAFile) {
  const testing::TempDir folder;
  LabelledDrawing drawing{.name = "face-2", .file = folder / "face.ndjson", .line = 2};
  testing::ExpectError([&] { FrameOfExtents(drawing); }, "face.ndjson: this drawing has no prediction");
  WriteFileAtomically(drawing.file,
                      "{\"word\": \"face\", \"drawing\": [[[0, 10], [0, 10]]]}\n"
                      "{\"word\": \"face\", \"drawing\": [[[0, 50, 100], [0, 200, 0]]]}\n");
  EXPECT_NEAR(FrameOfExtents(drawing).scale, 0.62 * render::kSketchCanvas / 200, 1e-9);
  drawing.line = 3;
  testing::ExpectError([&] { FrameOfExtents(drawing); }, "has 2 drawings, but the labels of face-2 name drawing 3");
}

/// The figures that the labels' own text has of the mean face: 5.3 and 26.3 %.
TEST(ScoreDrawings, TheMeanFaceOnTheSharedLabels) {
  const auto shared = testing::SharedData();
  if (!shared || !std::filesystem::exists(*shared / "sketches/landmarks.json"))
    GTEST_SKIP() << "no labelled drawings next to the checkout";
  const faces::FaceTemplate face = faces::ReadFaceTemplate(testing::SourceRoot() / "weights/face-ict");
  const DrawingScorer scorer(face, CameraOfScores());
  std::map<std::string, std::vector<double>> errors;
  for (const LabelledDrawing& drawing : ReadDrawingLabels(*shared / "sketches/landmarks.json")) {
    if (!drawing.is_scored()) continue;
    const MatrixX2d placed = scorer.PlacedBest(scorer.OnCanvas(face.neutral), drawing);
    errors[drawing.group].push_back(100 * *MeanOf(scorer.Errors(placed, drawing)));
  }
  const auto mean = [&](const char* group) {
    return Eigen::Map<const Eigen::VectorXd>(errors[group].data(), Eigen::Index(errors[group].size())).mean();
  };
  EXPECT_NEAR(mean("pictures"), 5.3, 0.05);
  EXPECT_NEAR(mean("doodles"), 26.3, 0.05);
}

}  // namespace
}  // namespace daumier::eval
