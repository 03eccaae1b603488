#include "systems/sketch/train/test_set.h"

#include "core/error.h"
#include "core/progress.h"
#include "eval/metrics.h"
#include "systems/sketch/metrics.h"

#include <algorithm>
#include <limits>
#include <set>

namespace daumier::sketch {
namespace {

/// The sketches of a test: those of the training in the exact view, augmented or styled as the options specify.
datasets::SketchVariation TestVariation(const SketchRunData& data, const SketchEvalOptions& options) {
  datasets::SketchVariation variation = data.sketch;
  variation.all_views = false;
  variation.augmentation.strength = options.strength;
  variation.styled.share = options.styled ? 1 : 0;
  return variation;
}

template <class Indices>
double MeanAt(const std::vector<double>& values, const Indices& indices) {
  double sum = 0;
  for (const int index : indices) sum += values[size_t(index)];
  return sum / double(indices.size());
}

}  // namespace

SketchTestSet::SketchTestSet(const SketchRunData& data, const SketchEvalOptions& options, const Task& task)
    : data_(data),
      faces_(data.side(options.split)),
      annotation_(data.faces.face_template().annotation),
      region_(faces::RegionFor(annotation_, "face", "measuring errors")),
      mm_per_cm_(faces::MillimetresPerCm(data.faces.face_template())),
      reader_(data.sketches, TestVariation(data, options), data.run.manifest.seed),
      task_(task) {
  if (faces_.empty()) throw UsageError(fmt::format("the split has no {} face", options.split));
  for (const int face : faces_) {
    groups_.push_back(data.faces.group(face));
    const std::span<const float> truth = data.faces.vertices(face);
    interocular_mm_.push_back(mm_per_cm_ *
                              eval::VertexDistance(truth, annotation_.landmarks[36], annotation_.landmarks[45]));
  }
}

int SketchTestSet::num_persons() const {
  std::set<int> persons;
  for (const int face : faces_)
    for (const int person : data_.faces.persons(face)) persons.insert(person);
  return int(persons.size());
}

reports::MetricTable SketchTestSet::EmptyTable() const {
  return {.columns = SketchColumns(),
          .faces = faces_,
          .groups = groups_,
          .data_hash = data_.run.manifest.details.at("data")};
}

SketchErrors SketchTestSet::Measure(const std::string& stage, const Predictor& predict) const {
  return Measure(stage, 1, [&](const FaceBlock& block) { return std::vector{predict(block)}; }).front();
}

std::vector<SketchErrors> SketchTestSet::Measure(const std::string& stage, size_t num_predictors,
                                                 const Predictors& predict) const {
  Progress progress(task_.Stage(stage), int64_t(faces_.size()), "faces");
  std::vector<SketchErrors> errors(num_predictors, {{}, std::vector<double>(size_t(data_.faces.num_vertices()), 0)});
  for (size_t begin = 0; begin < faces_.size(); begin += kBlock) {
    task_.ThrowIfCancelled("the evaluation was stopped; nothing was written");
    const FaceBlock block{begin, std::span(faces_).subspan(begin, std::min(kBlock, faces_.size() - begin))};
    const std::vector<eval::FaceRows> predicted = predict(block);
    for (size_t predictor = 0; predictor < num_predictors; ++predictor)
      for (size_t i = 0; i < block.faces.size(); ++i)
        Add(eval::RowSpan(predicted.at(predictor), i), block.faces[i], errors[predictor]);
    progress.Step(int64_t(block.faces.size()));
  }
  return errors;
}

void SketchTestSet::Add(std::span<const float> prediction, int face, SketchErrors& errors) const {
  const std::span<const float> truth = data_.faces.vertices(face);
  errors.of_faces.push_back(eval::MeanVertexError(prediction, truth, region_, mm_per_cm_));
  const std::vector<double> distances = eval::VertexErrors(prediction, truth, mm_per_cm_);
  for (size_t vertex = 0; vertex < distances.size(); ++vertex)
    errors.of_vertices[vertex] += distances[vertex] / double(faces_.size());
}

reports::MetricRow SketchTestSet::Row(const std::string& name, const std::string& input,
                                      const SketchErrors& errors) const {
  std::vector<double> shares(errors.of_faces.size());
  for (size_t i = 0; i < shares.size(); ++i) shares[i] = errors.of_faces[i] / interocular_mm_[i];
  reports::MetricRow row = reports::MakeRow(
      EmptyTable(), name, {{"error", errors.of_faces}, {"interocular_share", shares}}, data_.run.manifest.seed);
  row.input = input;
  return row;
}

Eigen::VectorXd SketchTestSet::InRegion(const std::vector<double>& of_vertices) const {
  Eigen::VectorXd kept =
      Eigen::VectorXd::Constant(Eigen::Index(of_vertices.size()), std::numeric_limits<double>::quiet_NaN());
  for (const int vertex : region_) kept[vertex] = of_vertices[size_t(vertex)];
  return kept;
}

Eigen::VectorXd SketchTestSet::ErrorMap(std::span<const float> prediction, int face) const {
  return InRegion(eval::VertexErrors(prediction, data_.faces.vertices(face), mm_per_cm_));
}

std::map<std::string, double> SketchTestSet::RegionErrors(const std::vector<double>& of_vertices) const {
  std::set<int> elsewhere(region_.begin(), region_.end());
  std::map<std::string, double> errors;
  for (const char* name : {"eyes", "mouth", "nose"}) {
    const auto found = annotation_.regions.find(name);
    if (found == annotation_.regions.end()) continue;
    std::vector<int> in_face;
    for (const int vertex : found->second) {
      if (elsewhere.erase(vertex) > 0) in_face.push_back(vertex);
    }
    if (!in_face.empty()) errors[name] = MeanAt(of_vertices, in_face);
  }
  if (!elsewhere.empty()) errors["elsewhere"] = MeanAt(of_vertices, elsewhere);
  return errors;
}

}  // namespace daumier::sketch
