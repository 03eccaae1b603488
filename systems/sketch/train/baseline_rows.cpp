#include "systems/sketch/train/baseline_rows.h"

#include "core/log.h"
#include "eval/nearest_neighbour.h"
#include "eval/ridge_regression.h"
#include "faces/bilinear_projector.h"
#include "systems/sketch/metrics.h"

namespace daumier::sketch {
namespace {

constexpr const char* kShapeRidge = "ridge on shape numbers";

std::vector<float> AsFloats(const Eigen::VectorXf& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

Eigen::VectorXf AsVector(std::span<const float> face) {
  return Eigen::Map<const Eigen::VectorXf>(face.data(), Eigen::Index(face.size()));
}

class Baselines {
 public:
  Baselines(const SketchTestSet& test, const ShapeCodes& codes, double strength)
      : test_(test), codes_(codes), strength_(strength) {}

  BaselineRows Measure() {
    const SketchRunData& data = test_.data();
    log::Info("Fitting the training-free baselines on {} training faces", data.split.train.size());
    const eval::SketchSamples samples{[&](int face) { return data.faces.vertices(face); },
                                      [&](int face) { return CurvePoints(face); }};
    const Eigen::VectorXf mean_face = eval::MeanFace(samples.vertices, data.split.train).transpose();
    AddEachFace(kMeanFace, [&](int) { return mean_face; });
    const eval::NearestNeighbour nearest(eval::ReadRows(samples.curve_points, data.split.train));
    AddEachFace(kNearestNeighbour, [&](int face) {
      return AsVector(samples.vertices(data.split.train[size_t(nearest.Nearest(samples.curve_points(face)))]));
    });
    const eval::RidgeFit ridge = Fit(samples);
    rows_.ridge_lambda = ridge.lambda;
    Add(kRidge, "none",
        [&](const FaceBlock& block) { return ridge.model.Predict(eval::ReadRows(samples.curve_points, block.faces)); });
    rows_.rows.back().baseline = true;
    Eigen::VectorXf weights = Eigen::VectorXf::Zero(test_.num_coordinates());
    for (const int vertex : test_.region()) weights.segment<3>(3 * vertex).setOnes();
    const faces::BilinearProjector projector(data.run.models.bilinear, weights);
    AddEachFace(kModelLimit, [&](int face) { return projector.Project(data.faces.vertices(face)).vertices; });
    MeasureShapeRidge();
    return std::move(rows_);
  }

 private:
  std::vector<float> CurvePoints(int face) const {
    return strength_ == 0 ? test_.data().sketches.curve_points(face) : AsFloats(codes_.given(face).points);
  }

  eval::RidgeFit Fit(const eval::SketchSamples& samples) const {
    const datasets::Split& split = test_.data().split;
    return eval::FitRidge(samples, split.train, split.validation, test_.region(), eval::DefaultRidgeLambdas());
  }

  void Add(const std::string& name, const std::string& input, const SketchTestSet::Predictor& predict) {
    rows_.rows.push_back(test_.Row(name, input, test_.Measure(name, predict)));
  }

  void AddEachFace(const std::string& name, const std::function<Eigen::VectorXf(int face)>& predict) {
    Add(name, "none", [&](const FaceBlock& block) {
      return eval::RowsOnAllCores(block.faces.size(), test_.num_coordinates(),
                                  [&](int i) { return predict(block.faces[size_t(i)]); });
    });
    rows_.rows.back().baseline = true;
  }

  /// Fitted on given coefficients.
  void MeasureShapeRidge() {
    const SketchRunData& data = test_.data();
    const eval::RidgeFit ridge = Fit({[&](int face) { return data.faces.vertices(face); },
                                      [&](int face) { return AsFloats(codes_.given(face).numbers()); }});
    std::vector<std::string> inputs = {"given"};
    if (codes_.can_recover()) inputs.insert(inputs.end(), {"predicted", "recovered"});
    std::vector<double> errors_px(inputs.size(), 0);
    const std::vector<SketchErrors> errors = test_.Measure(kShapeRidge, inputs.size(), [&](const FaceBlock& block) {
      std::vector<eval::FaceRows> predicted;
      for (size_t input = 0; input < inputs.size(); ++input)
        predicted.push_back(ridge.model.Predict(NumbersOf(CodesOf(inputs[input], block), block, errors_px[input])));
      return predicted;
    });
    for (size_t input = 0; input < inputs.size(); ++input) {
      rows_.rows.push_back(test_.Row(kShapeRidge, inputs[input], errors[input]));
      rows_.shape_error_px[inputs[input]] = errors_px[input];
    }
  }

  /// The codes of a block's sketches, of a source as in MeasureShapeRidge.
  std::vector<faces::CurveCode> CodesOf(const std::string& input, const FaceBlock& block) const {
    if (input == "predicted") return codes_.Predicted(block);
    std::vector<faces::CurveCode> codes;
    for (size_t i = 0; i < block.faces.size(); ++i)
      codes.push_back(input == "given" ? codes_.given(block.faces[i]) : codes_.recovered(block.begin + i));
    return codes;
  }

  /// One code a row; adds the block's share of their mean error.
  eval::FaceRows NumbersOf(const std::vector<faces::CurveCode>& codes, const FaceBlock& block, double& error_px) const {
    eval::FaceRows numbers(Eigen::Index(codes.size()), codes.front().numbers().size());
    for (size_t i = 0; i < codes.size(); ++i) {
      error_px += codes_.ErrorPx(codes[i], block.faces[i]) / double(test_.faces().size());
      numbers.row(Eigen::Index(i)) = codes[i].numbers().transpose();
    }
    return numbers;
  }

  const SketchTestSet& test_;
  const ShapeCodes& codes_;
  const double strength_;
  BaselineRows rows_;
};

}  // namespace

BaselineRows MeasureBaselines(const SketchTestSet& test, const ShapeCodes& codes, double strength) {
  return Baselines(test, codes, strength).Measure();
}

}  // namespace daumier::sketch
