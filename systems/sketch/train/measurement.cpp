#include "systems/sketch/train/measurement.h"

#include "core/error.h"
#include "core/log.h"
#include "core/parallel.h"
#include "eval/metrics.h"
#include "eval/nearest_neighbour.h"
#include "eval/ridge_regression.h"
#include "systems/sketch/train/fits.h"
#include "faces/bilinear_projector.h"

#include <algorithm>
#include <limits>

namespace daumier::sketch {
namespace {

/// Faces that are predicted at once.
constexpr size_t kBlock = 64;

std::vector<float> AsNumbers(const Eigen::VectorXf& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

Eigen::VectorXf AsVector(std::span<const float> face) {
  return Eigen::Map<const Eigen::VectorXf>(face.data(), Eigen::Index(face.size()));
}

eval::FaceRows Rows(std::span<const int> faces, Eigen::Index num_coordinates,
              const std::function<Eigen::VectorXf(int face)>& predict) {
  return eval::RowsOnAllCores(faces.size(), num_coordinates, [&](int i) { return predict(faces[size_t(i)]); });
}

/// What the sketches of a test are like: those of the training, augmented as asked for, in the exact view.
datasets::SketchVariation TestVariation(const SketchRunData& data, double strength) {
  datasets::SketchVariation variation = data.sketch;
  variation.all_views = false;
  variation.augmentation.strength = strength;
  return variation;
}

}  // namespace

SketchMeasurement::SketchMeasurement(const SketchRunData& data, const SketchEvalOptions& options)
    : data_(data),
      options_(options),
      test_(data.side(options.split)),
      annotation_(data.faces.face_template().annotation),
      region_(annotation_.regions.at("face")),
      mm_per_cm_(faces::MillimetresPerCm(data.faces.face_template())),
      shape_input_(data.run.models.curves, data.sketches, data.faces.face_template()),
      reader_(data.sketches, TestVariation(data, options.strength), data.run.manifest.seed),
      mean_error_map_(size_t(data.faces.num_vertices()), 0) {
  if (test_.empty()) throw UsageError(fmt::format("the split has no {} face", options.split));
  if (!options.recover_with.empty()) OpenRecoveringRun();
  for (const int face : test_) {
    groups_.push_back(data.faces.group(face));
    for (const int person : data.faces.persons(face)) persons_.insert(person);
    const std::span<const float> truth = data.faces.vertices(face);
    interocular_mm_.push_back(mm_per_cm_ * eval::VertexDistance(truth, annotation_.landmarks[36], annotation_.landmarks[45]));
  }
}

void SketchMeasurement::OpenRecoveringRun() {
  recovering_ = LoadSketchRun(options_.recover_with);
  DAUMIER_CHECK(!recovering_->network->options().reads_shape(),
                "{} reads shape-level numbers itself, and cannot be what they are recovered with",
                options_.recover_with);
  for (const char* key : {"data", "split"}) {
    DAUMIER_CHECK(recovering_->manifest.details.at(key) == data_.run.manifest.details.at(key),
                  "{} was trained on another {} than {}", options_.recover_with, key, data_.run.directory.string());
  }
}

void SketchMeasurement::Measure() {
  Encode();
  MeasureNetwork();
  MeasureFits();
  if (options_.baselines) MeasureBaselines();
}

std::optional<double> SketchMeasurement::error_of(const std::string& name) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const ErrorRow& row) { return row.name == name; });
  return found == rows_.end() ? std::nullopt : std::optional(found->error_mm);
}

void SketchMeasurement::Encode() {
  codes_.resize(size_t(data_.faces.num_faces()));
  std::set<int> faces(test_.begin(), test_.end());
  if (options_.baselines) {
    faces.insert(data_.split.train.begin(), data_.split.train.end());
    faces.insert(data_.split.validation.begin(), data_.split.validation.end());
  }
  log::Info("Encoding the curves of {} faces", faces.size());
  const std::vector<int> order(faces.begin(), faces.end());
  auto next = order.begin();
  ForEachInOrder(
      int(order.size()), [&](int i) { return GivenCode(order[size_t(i)]); },
      [&](faces::CurveCode code) { codes_[size_t(*next++)] = std::move(code); });
}

faces::CurveCode SketchMeasurement::GivenCode(int face) const {
  const auto sketch = Seen(face);
  return shape_input_.Given(sketch.moved, sketch.visible);
}

void SketchMeasurement::MeasureNetwork() {
  log::Info("Predicting {} {} faces by the network", test_.size(), options_.split);
  const SketchNetwork& network = data_.run.network;
  const bool reads_shape = network->options().reads_shape();
  if (reads_shape && can_recover()) {
    AddRow("network", "given", Errors([&](auto faces) {
             const eval::FaceRows numbers = GivenNumbers(faces);
             return reader_.Predict(network, faces, &numbers);
           }));
  }
  result_ = rows_.size();
  const auto errors_mm = Errors([this](auto faces) { return PredictResult(faces); }, &mean_error_map_);
  AddRow("network", !reads_shape ? "none" : can_recover() ? "recovered" : "given", errors_mm);
}

SketchAnswers SketchMeasurement::AskResult(std::span<const int> faces) const {
  const SketchNetwork& network = data_.run.network;
  if (!network->options().reads_shape()) return reader_.Ask(network, faces);
  const eval::FaceRows numbers = can_recover() ? RecoveredNumbers(faces) : GivenNumbers(faces);
  return reader_.Ask(network, faces, &numbers);
}

void SketchMeasurement::MeasureFits() {
  if (options_.refine || options_.deform) {
    log::Info("Matching contours of {} faces", test_.size());
    const RefinedRow refined(data_, reader_);
    AddRow("network, refined", result().shape_input,
           Errors([&](auto faces) { return refined.Refine(faces, AskResult(faces)); }));
    if (options_.deform) {
      log::Info("Moving the surfaces of {} faces onto the strokes", test_.size());
      const DeformedRow deformed(data_, reader_);
      AddRow("network, deformed", result().shape_input,
             Errors([&](auto faces) { return deformed.Deform(faces, refined.Refine(faces, AskResult(faces))); }));
    }
  }
  if (!options_.fit) return;
  log::Info("Fitting the bilinear model to the strokes of {} faces", test_.size());
  const MorphableRow fit(data_, reader_);
  const auto with_prior = fit.ChooseOptions(data_.split.validation, region_);
  log::Info("Labelled points are taken to stray by {} pixels", with_prior.deviation_px);
  AddRow("morphable model fit", "given", Errors([&](auto faces) { return fit.Predict(faces, with_prior); }));
  AddRow("morphable model fit without prior", "given",
         Errors([&](auto faces) { return fit.Predict(faces, {.prior = false}); }));
}

eval::FaceRows SketchMeasurement::PredictWithoutShape(std::span<const int> faces) const {
  return reader_.Predict(recovering_ ? recovering_->network : data_.run.network, faces);
}

eval::FaceRows SketchMeasurement::GivenNumbers(std::span<const int> faces) const {
  return Rows(faces, data_.run.network->num_shape(),
              [this](int face) { return (codes_.empty() ? GivenCode(face) : codes_[size_t(face)]).numbers(); });
}

eval::FaceRows SketchMeasurement::RecoveredNumbers(std::span<const int> faces) const {
  const eval::FaceRows start = PredictWithoutShape(faces);
  return eval::RowsOnAllCores(faces.size(), data_.run.network->num_shape(), [&](int i) {
    return shape_input_.Recovered(eval::RowSpan(start, size_t(i)), Seen(faces[size_t(i)]).strokes).numbers();
  });
}

std::vector<float> SketchMeasurement::CurvePoints(int face) const {
  if (options_.strength == 0) return data_.sketches.curve_points(face);
  return AsNumbers(codes_[size_t(face)].points);
}

void SketchMeasurement::MeasureBaselines() {
  const eval::SketchSamples samples{[this](int face) { return data_.faces.vertices(face); },
                              [this](int face) { return CurvePoints(face); }};
  const Eigen::Index num_coordinates = 3 * Eigen::Index(data_.faces.num_vertices());
  log::Info("Fitting the free baselines on {} training faces", data_.split.train.size());
  const eval::RidgeFit ridge = eval::FitRidge(samples, data_.split.train, data_.split.validation, region_, eval::DefaultRidgeLambdas());
  ridge_lambda_ = ridge.lambda;
  AddRow("ridge regression", "none",
         Errors([&](auto faces) { return ridge.model.Predict(eval::ReadRows(samples.curve_points, faces)); }));
  MeasureShapeInput();
  const eval::NearestNeighbour nearest(eval::ReadRows(samples.curve_points, data_.split.train));
  AddRow("nearest neighbour", "none", Errors([&](auto faces) {
           return Rows(faces, num_coordinates, [&](int face) {
             return AsVector(samples.vertices(data_.split.train[size_t(nearest.Nearest(samples.curve_points(face)))]));
           });
         }));
  Eigen::VectorXf mean_face = eval::MeanFace(samples.vertices, data_.split.train);
  AddRow("mean face", "none",
         Errors([&](auto faces) { return Rows(faces, num_coordinates, [&](int) { return mean_face; }); }));
  log::Info("Projecting the true faces on the bilinear model");
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(num_coordinates);
  for (const int vertex : region_) weights.segment<3>(3 * vertex).setOnes();
  const faces::BilinearProjector projector(data_.run.models.bilinear, weights);
  AddRow("limit of the model", "none", Errors([&](auto faces) {
           return Rows(faces, num_coordinates,
                       [&](int face) { return projector.Project(data_.faces.vertices(face)).vertices; });
         }));
}

/// Ridge regression on the shape-level numbers, fitted on given ones, tested on given, predicted and recovered ones.
void SketchMeasurement::MeasureShapeInput() {
  const eval::SketchSamples samples{[this](int face) { return data_.faces.vertices(face); },
                              [this](int face) { return AsNumbers(codes_[size_t(face)].numbers()); }};
  const eval::RidgeFit ridge = eval::FitRidge(samples, data_.split.train, data_.split.validation, region_, eval::DefaultRidgeLambdas());
  const auto measure = [&](const std::string& input,
                           const std::function<faces::CurveCode(int face, std::span<const float> predicted)>& code) {
    double error_px = 0;
    AddRow("ridge on shape numbers", input, Errors([&](std::span<const int> faces) {
             const eval::FaceRows predicted = input == "given" ? eval::FaceRows() : PredictWithoutShape(faces);
             eval::FaceRows numbers(Eigen::Index(faces.size()), data_.run.network->num_shape());
             for (size_t i = 0; i < faces.size(); ++i) {
               const faces::CurveCode one =
                   code(faces[i], input == "given" ? std::span<const float>() : eval::RowSpan(predicted, i));
               error_px += shape_input_.ErrorPx(one, Seen(faces[i]).moved) / double(test_.size());
               numbers.row(Eigen::Index(i)) = one.numbers().transpose();
             }
             return ridge.model.Predict(numbers);
           }));
    shape_error_px_[input] = error_px;
  };
  measure("given", [&](int face, auto) { return codes_[size_t(face)]; });
  if (!can_recover()) return;
  measure("predicted", [&](int face, auto predicted) {
    return shape_input_.Recovered(predicted, Seen(face).strokes, {.snaps = 0});
  });
  measure("recovered", [&](int face, auto predicted) { return shape_input_.Recovered(predicted, Seen(face).strokes); });
}

/// One error a test face in mm; adds the mean distance of each vertex to `map` where one is given.
std::vector<double> SketchMeasurement::Errors(const Predictor& predict, std::vector<double>* map) const {
  std::vector<double> errors;
  for (size_t begin = 0; begin < test_.size(); begin += kBlock) {
    const std::span<const int> block = std::span(test_).subspan(begin, std::min(kBlock, test_.size() - begin));
    const eval::FaceRows predicted = predict(block);
    for (size_t i = 0; i < block.size(); ++i) {
      const std::span<const float> prediction = eval::RowSpan(predicted, i), truth = data_.faces.vertices(block[i]);
      errors.push_back(eval::MeanVertexError(prediction, truth, region_, mm_per_cm_));
      if (map == nullptr) continue;
      const std::vector<double> distances = eval::VertexErrors(prediction, truth, mm_per_cm_);
      for (size_t vertex = 0; vertex < distances.size(); ++vertex)
        (*map)[vertex] += distances[vertex] / double(test_.size());
    }
  }
  return errors;
}

void SketchMeasurement::AddRow(const std::string& name, const std::string& shape_input,
                               const std::vector<double>& errors_mm) {
  ErrorRow row = MakeErrorRow(name, errors_mm, interocular_mm_, groups_, data_.run.manifest.seed);
  row.shape_input = shape_input;  // May be that of a row that moves as the list grows.
  rows_.push_back(std::move(row));
}

Eigen::VectorXd SketchMeasurement::InFaceOnly(const std::vector<double>& errors) const {
  Eigen::VectorXd kept =
      Eigen::VectorXd::Constant(Eigen::Index(errors.size()), std::numeric_limits<double>::quiet_NaN());
  for (const int vertex : region_) kept[vertex] = errors[size_t(vertex)];
  return kept;
}

Eigen::VectorXd SketchMeasurement::ErrorMap(const eval::FaceRows& prediction, int face) const {
  return InFaceOnly(eval::VertexErrors(eval::RowSpan(prediction, 0), data_.faces.vertices(face), mm_per_cm_));
}

std::map<std::string, double> SketchMeasurement::region_errors_mm() const {
  std::set<int> elsewhere(region_.begin(), region_.end());
  const auto mean = [&](const auto& vertices) {
    double sum = 0;
    for (const int vertex : vertices) sum += mean_error_map_[size_t(vertex)];
    return sum / double(vertices.size());
  };
  std::map<std::string, double> errors;
  for (const char* name : {"eyes", "mouth", "nose"}) {
    const auto found = annotation_.regions.find(name);
    if (found == annotation_.regions.end()) continue;
    std::vector<int> in_face;
    for (const int vertex : found->second) {
      if (elsewhere.erase(vertex) > 0) in_face.push_back(vertex);
    }
    if (!in_face.empty()) errors[name] = mean(in_face);
  }
  if (!elsewhere.empty()) errors["elsewhere"] = mean(elsewhere);
  return errors;
}

}  // namespace daumier::sketch
