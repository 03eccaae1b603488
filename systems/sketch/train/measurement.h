#pragma once
#include "datasets/read/training_fit.h"
#include "systems/sketch/shape_input.h"
#include "systems/sketch/train/evaluation.h"
#include "systems/sketch/train/reader.h"
#include "systems/sketch/train/error_table.h"

#include <functional>
#include <map>
#include <set>

namespace daumier::sketch {

/// The rows of a table of errors and what they are made from: a run, its rivals without training, one side of its
/// split. See EvaluateSketchRun.
class SketchMeasurement {
 public:
  /// `data` has to outlive it. @throws as EvaluateSketchRun.
  SketchMeasurement(const SketchRunData& data, const SketchEvalOptions& options);

  /// Fits the baselines, predicts with all and fills the rows.
  void Measure();

  const SketchRunData& data() const { return data_; }
  const SketchEvalOptions& options() const { return options_; }
  const std::vector<int>& faces() const { return test_; }
  const std::vector<int>& groups() const { return groups_; }
  int num_persons() const { return int(persons_.size()); }
  const std::vector<ErrorRow>& rows() const { return rows_; }
  /// The network's own row: with recovered shape-level numbers if it reads them and they are there.
  const ErrorRow& result() const { return rows_[result_]; }
  /// Mean of the row of that name, if it was measured.
  std::optional<double> error_of(const std::string& name) const;
  double ridge_lambda() const { return ridge_lambda_; }
  const Json& shape_error_px() const { return shape_error_px_; }
  /// Of the result: one a face; one a vertex, mean over faces, NaN outside of the region `face`; one a region.
  const std::vector<double>& errors_mm() const { return result().face_errors_mm; }
  Eigen::VectorXd mean_error_map() const { return InFaceOnly(mean_error_map_); }
  std::map<std::string, double> region_errors_mm() const;

  /// A face as the result predicts it, 3V cm, beside the truth, and what was seen; without Measure too.
  eval::FaceRows PredictResult(std::span<const int> faces) const { return AskResult(faces).faces; }
  datasets::AugmentedSketch Seen(int face) const { return reader_.Seen(face); }
  /// Distance of each vertex in mm, NaN outside of the region `face`.
  Eigen::VectorXd ErrorMap(const eval::FaceRows& prediction, int face) const;

 private:
  /// num_faces x 3V coordinates in cm of some faces of the database.
  using Predictor = std::function<eval::FaceRows(std::span<const int> faces)>;

  void OpenRecoveringRun();
  void Encode();
  faces::CurveCode GivenCode(int face) const;
  SketchAnswers AskResult(std::span<const int> faces) const;
  void MeasureNetwork();
  void MeasureFits();
  void MeasureShapeInput();
  void MeasureBaselines();
  /// Whose faces recovered numbers start from: a network that reads none.
  bool can_recover() const { return recovering_.has_value() || !data_.run.network->options().reads_shape(); }
  eval::FaceRows PredictWithoutShape(std::span<const int> faces) const;
  eval::FaceRows GivenNumbers(std::span<const int> faces) const;
  eval::FaceRows RecoveredNumbers(std::span<const int> faces) const;
  std::vector<float> CurvePoints(int face) const;
  std::vector<double> Errors(const Predictor& predict, std::vector<double>* map = nullptr) const;
  void AddRow(const std::string& name, const std::string& shape_input, const std::vector<double>& errors_mm);
  Eigen::VectorXd InFaceOnly(const std::vector<double>& errors) const;

  const SketchRunData& data_;
  const SketchEvalOptions options_;
  const std::vector<int>& test_;
  const faces::Annotation& annotation_;
  const std::vector<int>& region_;
  const double mm_per_cm_;
  const ShapeInput shape_input_;
  const SketchReader reader_;
  std::optional<SketchRun> recovering_;
  std::vector<faces::CurveCode> codes_;  ///< Of every face that is seen, from labelled strokes.
  Json shape_error_px_ = Json::object();
  std::set<int> persons_;    ///< Who is seen.
  std::vector<int> groups_;  ///< Of each test face: what is resampled as one.
  std::vector<double> interocular_mm_, mean_error_map_;
  std::vector<ErrorRow> rows_;
  size_t result_ = 0;
  double ridge_lambda_ = 0;
};

}  // namespace daumier::sketch
