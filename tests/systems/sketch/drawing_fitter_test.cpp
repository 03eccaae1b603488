#include "systems/sketch/drawing_fitter.h"

#include "geometry/coordinates.h"
#include "systems/sketch/parsed_face.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_parser_network.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class DrawingFitterTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const testing::TempDir folder;
    testing::WritePlainSketchRun(folder.path());
    run_ = std::make_unique<SketchRunFolder>(ReadSketchRunFolder(folder.path()));
    fitter_ = std::make_unique<DrawingFitter>(*run_, Parser());
    points_ = faces::FindFacePoints(run_->face_template);
  }
  static void TearDownTestSuite() {
    fitter_.reset();
    run_.reset();
  }

  static std::shared_ptr<const DrawingParser> Parser() {
    return std::make_shared<const DrawingParser>(ParserNetworkOptions(),
                                                 std::make_shared<testing::IdealParserNetwork>(ParserNetworkOptions()));
  }
  static std::vector<float> FaceOf(const Eigen::VectorXf& coordinates) {
    return {coordinates.begin(), coordinates.end()};
  }
  static std::vector<float> MeanFace() { return FaceOf(run_->models.gaussian.mean); }
  /// A face that is one deviation of some components away from the mean.
  static std::vector<float> OtherFace() {
    Eigen::VectorXf coefficients = Eigen::VectorXf::Zero(run_->models.gaussian.size());
    coefficients.head(4) << 1, -1, 1, 1;
    return FaceOf(faces::Reconstruct(run_->models.gaussian, coefficients));
  }
  /// The points of a face on the canvas; on a contour the places nearest to `near`.
  static std::array<Eigen::Vector2d, faces::kNumFacePoints> PointsOf(
      const std::vector<float>& face, const std::array<Eigen::Vector2d, faces::kNumFacePoints>* near = nullptr) {
    const Eigen::MatrixX2d projected = render::Project(run_->camera, geometry::PointsFrom(face)).leftCols<2>();
    std::array<Eigen::Vector2d, faces::kNumFacePoints> points;
    for (int i = 0; i < faces::kNumFacePoints; ++i) {
      const auto point = faces::FacePoint(i);
      const auto contour = faces::ContourOf(point);
      const Eigen::Vector2d on_contour = contour
                                             ? projected.row(points_.contours[size_t(*contour)][4]).transpose().eval()
                                             : Eigen::Vector2d::Zero().eval();
      points[size_t(i)] =
          faces::ProjectedFacePoint(points_, point, projected, near != nullptr ? (*near)[size_t(i)] : on_contour);
    }
    return points;
  }
  /// A label whose lines show the point, of which the fit has no curve where it can be avoided.
  static faces::LineLabel LabelOf(size_t point) {
    for (const auto label : {faces::LineLabel::kIris, faces::LineLabel::kNose, faces::LineLabel::kBrow,
                             faces::LineLabel::kInnerMouth, faces::LineLabel::kSilhouette})
      if (CanShow(label, faces::FacePoint(point))) return label;
    return faces::LineLabel::kOther;
  }
  /// A face as it lies on a sheet: its points, with a dot at each.
  static ParsedDrawing DrawingOfPoints(const std::vector<float>& face, const render::Placement& sheet_from_canvas) {
    ParsedDrawing drawing;
    drawing.points = PointsOf(face);
    for (Eigen::Vector2d& point : drawing.points) point = render::ToCanvas(sheet_from_canvas, point);
    std::fill_n(drawing.confidences.begin(), faces::kNumLandmarkPoints, 1.0);
    for (size_t i = 0; i < size_t(faces::kNumLandmarkPoints); ++i) {
      drawing.strokes.push_back({0, {{float(drawing.points[i].x()), float(drawing.points[i].y())}}});
      drawing.labels.push_back({LabelOf(i)});
    }
    drawing.frame = FrameOfPoints(drawing.points);
    return drawing;
  }
  static double MeanDistance(const std::array<Eigen::Vector2d, faces::kNumFacePoints>& a,
                             const std::array<Eigen::Vector2d, faces::kNumFacePoints>& b) {
    double sum = 0;
    for (size_t i = 0; i < size_t(faces::kNumLandmarkPoints); ++i) sum += (a[i] - b[i]).norm();
    return sum / faces::kNumLandmarkPoints;
  }

  static inline std::unique_ptr<SketchRunFolder> run_;
  static inline std::unique_ptr<DrawingFitter> fitter_;
  static inline faces::FacePointVertices points_;
};

const render::Placement kSheet{.scale = 3, .shift = {250, 40}, .turn_degrees = 7};

TEST_F(DrawingFitterTest, TheFrameLaysThePointsOntoThoseOfTheMeanFace) {
  const ParsedDrawing drawing = DrawingOfPoints(MeanFace(), kSheet);
  const render::Placement frame = fitter_->FrameOf(drawing), expected = render::Inverse(kSheet);
  EXPECT_NEAR(frame.scale, expected.scale, 0.02 * expected.scale);
  EXPECT_NEAR(frame.turn_degrees, expected.turn_degrees, 0.5);
  const auto points = PointsOf(MeanFace());
  for (size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((render::ToCanvas(frame, drawing.points[i]) - points[i]).norm(), 2) << faces::kFacePointNames[i];
}

TEST_F(DrawingFitterTest, TheFittedFaceIsNearerToTheDrawnPointsThanTheMeanFace) {
  const ParsedDrawing drawing = DrawingOfPoints(OtherFace(), kSheet);
  const render::Placement frame = fitter_->FrameOf(drawing);
  const fitting::LabelledFit fit = fitter_->Fit(drawing, frame, MeanFace());
  const render::Placement of_fit = render::Composed(render::Inverse(fit.frame), frame);
  const auto drawn_in = [&](const render::Placement& placement) {
    auto points = drawing.points;
    for (Eigen::Vector2d& point : points) point = render::ToCanvas(placement, point);
    return points;
  };
  const auto of_frame = drawn_in(frame), fitted = drawn_in(of_fit);
  EXPECT_LT(MeanDistance(PointsOf(fit.vertices, &fitted), fitted),
            0.5 * MeanDistance(PointsOf(MeanFace(), &of_frame), of_frame));
}

TEST_F(DrawingFitterTest, TheFaceOfASketchIsThatOfItsParse) {
  const std::vector<render::Stroke> circles = fitting::Circles();
  const ParsedDrawing parsed = fitter_->Parse(circles);
  const render::Placement frame = fitter_->FrameOf(parsed);
  const fitting::LabelledFit fit = fitter_->Fit(parsed, frame, MeanFace());
  const FittedFace fitted = fitter_->FittedTo(circles, MeanFace());
  EXPECT_EQ(fitted.vertices, fitting::Upright(fit));
  const Eigen::Vector2d p(100, 80), in_fit = render::ToSheet(fit.frame, render::ToCanvas(frame, p));
  EXPECT_LT((render::ToCanvas(fitted.frame, p) - in_fit).norm(), 1e-9);
  EXPECT_TRUE(geometry::PointsFrom(fit.vertices).allFinite());
}

TEST_F(DrawingFitterTest, ALabelledDrawingIsTheParsedOneOnTheCanvas) {
  const ParsedDrawing parsed = fitter_->Parse(fitting::Circles());
  const fitting::LabelledDrawing labelled = ToLabelled(parsed, kSheet);
  ASSERT_EQ(labelled.strokes.size(), parsed.strokes.size());
  EXPECT_EQ(labelled.strokes[1].labels, parsed.labels[1]);
  EXPECT_EQ(labelled.mouth, parsed.mouth);
  EXPECT_EQ(labelled.view, parsed.view);
  for (size_t i = 0; i < parsed.points.size(); ++i) {
    EXPECT_EQ(labelled.points[i].position, render::ToCanvas(kSheet, parsed.points[i]));
    EXPECT_EQ(labelled.points[i].confidence, parsed.confidences[i]);
  }
}

TEST_F(DrawingFitterTest, APointThatNoLineShowsKeepsTheLeastSupportOfItsConfidence) {
  ParsedDrawing drawing = DrawingOfPoints(MeanFace(), kSheet);
  const auto chin = size_t(faces::FacePoint::kChin), nose = size_t(faces::FacePoint::kNoseBottom);
  for (auto& labels : drawing.labels)
    if (labels[0] == faces::LineLabel::kSilhouette) labels[0] = faces::LineLabel::kHair;
  const fitting::LabelledDrawing labelled = ToLabelled(drawing, kSheet, 0.25);
  EXPECT_NEAR(labelled.points[chin].confidence, 0.25, 1e-12);
  EXPECT_NEAR(labelled.points[nose].confidence, 1, 1e-12);
}

TEST_F(DrawingFitterTest, FeaturesCountAsFarAsLinesShowThem) {
  ParsedDrawing drawing = DrawingOfPoints(MeanFace(), kSheet);
  EXPECT_NEAR(NumFeatures(drawing), 6, 1e-9);
  drawing.strokes.resize(4);  // The right eye alone.
  drawing.labels.resize(4);
  EXPECT_LT(NumFeatures(drawing), 1.2);
  EXPECT_GE(NumFeatures(drawing), 1);
}

TEST(TrustOf, IsHalfAtHalfTrust) {
  EXPECT_EQ(TrustOf(0, 2), 0);
  EXPECT_EQ(TrustOf(2, 2), 0.5);
  EXPECT_NEAR(TrustOf(4, 2), 256.0 / 257, 1e-12);
  EXPECT_EQ(TrustOf(0, 0), 1);
}

TEST_F(DrawingFitterTest, OfALoneEyeTheNeutralFaceIsLeft) {
  ParsedDrawing drawing = DrawingOfPoints(MeanFace(), kSheet);
  drawing.strokes.resize(4);
  drawing.labels.resize(4);
  const auto distance = [&](const std::vector<float>& face) {
    return (geometry::PointsFrom(face) - run_->face_template.neutral).rowwise().norm().mean();
  };
  const fitting::LabelledFit fit = fitter_->Fit(drawing, render::Inverse(kSheet), OtherFace());
  EXPECT_LT(distance(fitting::Upright(fit)), 0.1 * distance(OtherFace()));
}

TEST_F(DrawingFitterTest, ADrawingWithoutAPointIsRefused) {
  ParsedDrawing drawing = DrawingOfPoints(MeanFace(), kSheet);
  drawing.confidences.fill(0);
  testing::ExpectError([&] { fitter_->FrameOf(drawing); }, "no point of a face is found in the drawing");
}

TEST_F(DrawingFitterTest, ARunOfAnEarlierVersionIsRefusedWithTheRepair) {
  SketchRunFolder earlier = *run_;
  earlier.models.gaussian = {};
  testing::ExpectError([&] { DrawingFitter(earlier, Parser()); }, "the run has no gaussian.safetensors");
  testing::ExpectError([&] { DrawingFitter(earlier, Parser()); }, "--keep-frame");
}

}  // namespace
}  // namespace daumier::sketch
