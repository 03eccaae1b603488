#include "systems/sketch/train/fits.h"

#include "eval/metrics.h"
#include "faces/bilinear_projector.h"
#include "tests/support/ideal_parser_network.h"
#include "tests/systems/sketch/train/run_fixture.h"

#include <algorithm>

namespace daumier::sketch {
namespace {

class SketchFitsTest : public SketchRunFixture {
 protected:
  SketchFitsTest() : data_(OpenSketchRunData(*folder_ / "run")), reader_(data_.sketches, {}, 7) {}

  double MeanError(const eval::FaceRows& predicted, std::span<const int> faces) const {
    std::vector<double> errors;
    for (size_t i = 0; i < faces.size(); ++i) {
      const auto row = predicted.row(Eigen::Index(i));
      errors.push_back(
          eval::MeanVertexError({row.data(), size_t(row.size())}, data_.faces.vertices(faces[i]), region(), 10));
    }
    return Mean(errors);
  }
  const std::vector<int>& region() const { return data_.faces.face_template().annotation.regions.at("face"); }

  const SketchRunData data_;
  const SketchReader reader_;
};

TEST_F(SketchFitsTest, MorphableFitIsThatOfTheLabelledStrokes) {
  const MorphableRow fit(data_, reader_);
  const auto faces = std::span(data_.split.train).first(3);
  const eval::FaceRows fitted = fit.Predict(faces, {});
  const auto curves = fitting::SeeCurves(data_.run.face_template, data_.run.feature_curves, data_.run.camera);
  const auto model = fitting::ProjectModel(curves, data_.run.models.bilinear);
  for (size_t i = 0; i < faces.size(); ++i) {
    const auto points = datasets::PointsOf(data_.sketches.strokes(faces[i]), data_.sketches.feature_curves());
    std::vector<float> weights(points.size() / 2, 0.0f);
    for (size_t k = 0; k < weights.size(); k += 4) weights[k] = 4;
    const auto one = fitting::FitMorphable(model, points, weights);
    const Eigen::VectorXf face = faces::Reconstruct(data_.run.models.bilinear, one.u, one.v);
    EXPECT_LT((fitted.row(Eigen::Index(i)).transpose() - face).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST_F(SketchFitsTest, TheChosenFitIsTheBestOfItsListOnValidationFaces) {
  const MorphableRow fit(data_, reader_);
  const auto chosen = fit.ChooseOptions(data_.split.validation, region());
  EXPECT_TRUE(chosen.prior);
  const double least = MeanError(fit.Predict(data_.split.validation, chosen), data_.split.validation);
  for (const double deviation_px : {0.25, 1.0, 8.0}) {
    const eval::FaceRows other = fit.Predict(data_.split.validation, {.prior = true, .deviation_px = deviation_px});
    EXPECT_LE(least, MeanError(other, data_.split.validation) + 1e-9) << deviation_px;
  }
}

TEST_F(SketchFitsTest, RefiningTheFaceOfOwnStrokesHelps) {
  const RefinedRow refined(data_, reader_);
  const auto faces = std::span(data_.split.train).first(4);
  // Wrong by a little: what the model makes of the true coefficients, pulled towards the mean.
  SketchPredictions predictions;
  const auto& model = data_.run.models.bilinear;
  const faces::BilinearProjector projector(model);
  predictions.u.resize(4, model.num_identity), predictions.v.resize(4, model.num_expression);
  predictions.faces.resize(4, model.num_coordinates());
  for (Eigen::Index i = 0; i < 4; ++i) {
    const auto truth = projector.Project(data_.faces.vertices(faces[size_t(i)]));
    predictions.u.row(i) = 0.8f * truth.u.transpose() + 0.2f * model.identity_factors.colwise().mean();
    predictions.v.row(i) = truth.v.transpose();
    predictions.faces.row(i) =
        faces::Reconstruct(model, predictions.u.row(i).transpose(), predictions.v.row(i).transpose()).transpose();
  }
  const eval::FaceRows rows = refined.Refine(faces, predictions);
  EXPECT_LT(MeanError(rows, faces), MeanError(predictions.faces, faces));
}

TEST_F(SketchFitsTest, AFittedRowHasTheFaceOfEachParsedSketch) {
  const auto parser = std::make_shared<const DrawingParser>(
      ParserNetworkOptions(), std::make_shared<testing::IdealParserNetwork>(ParserNetworkOptions()));
  const auto faces = std::span(data_.split.train).first(3);
  eval::FaceRows start(3, 3 * Eigen::Index(data_.faces.num_vertices()));
  const faces::FaceGaussian& gaussian = data_.run.models.gaussian;
  start.rowwise() = gaussian.mean.transpose() + 2 * gaussian.rows.row(0);
  const eval::FaceRows fitted = FittedRow(data_, reader_, parser).Fit(faces, start);
  const DrawingFitter fitter(data_.run, parser);
  for (size_t i = 0; i < faces.size(); ++i) {
    const std::vector<float> one =
        fitter.FittedTo(reader_.SketchOf(faces[i]).strokes, eval::RowSpan(start, i)).vertices;
    const std::span<const float> row = eval::RowSpan(fitted, i);
    EXPECT_TRUE(std::ranges::equal(row, one)) << i;
  }
  EXPECT_FALSE(fitted.row(0).isApprox(start.row(0), 1e-4f));
}

}  // namespace
}  // namespace daumier::sketch
