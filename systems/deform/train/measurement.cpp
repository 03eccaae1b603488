#include "systems/deform/train/measurement.h"

#include "core/error.h"
#include "core/log.h"
#include "core/progress.h"
#include "core/random.h"
#include "eval/surface_metrics.h"
#include "geometry/self_intersections.h"
#include "geometry/surface_samples.h"
#include "tensor/eigen.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <algorithm>

namespace daumier::deform {
namespace {

constexpr int kNumSamples = 10000;
constexpr int kIntersectionFaces = 16;
/// One for all runs, so that they are measured at the same points.
constexpr uint64_t kSampleSeed = 1;

geometry::Points PointsOf(const torch::Tensor& vertices) {
  return tensor::CopyToMatrix<double>(vertices);
}

/// Where points of triangles lie on a mesh, (S, 3).
torch::Tensor OnMesh(const SurfacePoints& points, const torch::Tensor& vertices) {
  const torch::Tensor corners = vertices.index_select(0, points.corners.flatten()).reshape({-1, 3, 3});
  return (corners * points.weights.unsqueeze(-1)).sum(1);
}

/// Points of a surface, with their places on the template.
SurfacePoints SamplesOf(const geometry::TriangleMesh& mesh, int face, const torch::Tensor& template_vertices) {
  Rng rng = Stream(kSampleSeed, "surface samples of an evaluation", uint64_t(face));
  geometry::SurfaceSamples drawn = geometry::SampleSurface(mesh, kNumSamples, rng);
  geometry::Triangles triangles = mesh.triangles;
  SurfacePoints points;
  points.corners = tensor::ViewAsTensor(triangles).index_select(0, torch::tensor(drawn.triangles)).to(torch::kInt64);
  const torch::Tensor two = torch::tensor(drawn.weights).reshape({-1, 2});
  points.weights = torch::cat({two, 1 - two.sum(1, true)}, 1);
  points.positions = OnMesh(points, template_vertices);
  return points;
}

torch::Tensor Distances(const torch::Tensor& a, const torch::Tensor& b) {
  return (a - b).norm(2, {-1});
}

double MeanOf(const torch::Tensor& values) {
  return values.to(torch::kFloat64).mean().item<double>();
}

double CountSelfIntersections(const geometry::TriangleMesh& mesh) {
  return double(geometry::SelfIntersections(mesh).size());
}

}  // namespace

DeformMeasurement::DeformMeasurement(DeformNetwork& network, MeasuredFaces faces, uint64_t seed, const ModelUnit& unit,
                                     const Task& task)
    : network_(network), faces_(std::move(faces)), seed_(seed), unit_(unit), task_(task) {
  DAUMIER_CHECK(num_faces() > 0 && faces_.groups.size() == faces_.faces.size(), "{} faces of {} groups are measured",
                num_faces(), faces_.groups.size());
  tensor::CheckShape(faces_.vertices, {num_faces(), network.num_vertices(), 3}, "vertices of the faces");
  for (int i = 0; i < num_faces(); ++i)
    samples_.push_back(SamplesOf(TrueMesh(i), faces_.faces[size_t(i)], network.template_vertices()));
  table_ = {.columns = DeformColumns(), .faces = faces_.faces, .groups = faces_.groups};
}

void DeformMeasurement::MeasureNetwork(const std::string& name, const CodeFitOptions& options, int num_faces_of_row) {
  DAUMIER_CHECK(num_faces_of_row > 0 && num_faces_of_row <= num_faces(), "{} of {} faces cannot be measured",
                num_faces_of_row, num_faces());
  log::Info("Fitting codes of {} faces: {}", num_faces_of_row, name);
  std::vector<torch::Tensor> codes;
  torch::Tensor map = torch::zeros({network_.num_vertices()});
  const bool by_steps = options.solve.method == "adam";  // A face may take a minute.
  const int64_t steps = by_steps ? options.solve.adam_steps : 1;
  Progress progress(task_.Stage(name), num_faces_of_row * steps, by_steps ? "steps" : "faces");
  const auto step = [&] { progress.Step(); };
  const Task of_fit(task_.stop, [&](const TaskProgress& report) {
    if (report.done > 0) step();
  });
  const auto predict = [&](int i) -> Prediction {
    const CodeFit fit = FitCode(network_, faces_.vertices[i], options, of_fit);
    const at::NoGradGuard no_gradient;
    const torch::Tensor code = fit.code.unsqueeze(0);
    codes.push_back(fit.code);
    const torch::Tensor vertices = network_.DeformVertices(code).squeeze(0);
    map += Distances(vertices, faces_.vertices[i]) / num_faces_of_row;
    return {vertices, network_.Deform(code, samples_[size_t(i)]).squeeze(0), fit.seconds};
  };
  AddRow(name, Errors(num_faces_of_row, predict, [&] {
           if (!by_steps) step();
         }));
  if (has_result_ || num_faces_of_row < num_faces()) return;
  has_result_ = true;
  table_.result = table_.rows.size() - 1;
  codes_ = torch::stack(codes);
  mean_error_map_ = map;
}

void DeformMeasurement::MeasureTemplate() {
  AddBaseline(kTemplate, [&](int) { return network_.template_vertices(); });
}

void DeformMeasurement::MeasureBaselines(const DeformBaselines& baselines) {
  const at::NoGradGuard no_gradient;
  const torch::Tensor mean = baselines.Mean(), nearest = baselines.Nearest(faces_.vertices),
                      linear = baselines.Linear(faces_.vertices);
  AddBaseline(kMeanFace, [&](int) { return mean; });
  AddBaseline(kNearestFace, [&](int i) { return nearest[i]; });
  AddBaseline(kLinearModel, [&](int i) { return linear[i]; });
}

void DeformMeasurement::AddBaseline(const std::string& name, const std::function<torch::Tensor(int i)>& vertices) {
  const at::NoGradGuard no_gradient;
  Progress progress(task_.Stage(name), num_faces(), "faces");
  const auto predict = [&](int i) -> Prediction {
    const torch::Tensor predicted = vertices(i);
    return {predicted, OnMesh(samples_[size_t(i)], predicted), std::nullopt};
  };
  AddRow(name, Errors(num_faces(), predict, [&] { progress.Step(); }));
  table_.rows.back().baseline = true;
}

void DeformMeasurement::AddRow(const std::string& name, const std::vector<SurfaceErrors>& errors) {
  reports::FaceValues values;
  for (const SurfaceErrors& one : errors) {
    values["error"].push_back(one.mean_vertex_error);
    values["num_faces"].push_back(double(errors.size()));
    values["p95"].push_back(one.p95_vertex_error);
    values["surface_sample_error"].push_back(one.surface_sample_error);
    values["error_mm"].push_back(unit_.mm * one.mean_vertex_error);
    values["percent_of_head_height"].push_back(100 * one.mean_vertex_error / unit_.head_height);
    values["normal_error_degrees"].push_back(one.normal_error_degrees);
    values["flipped_triangles"].push_back(one.flipped_triangles);
    if (one.self_intersections) values["self_intersections"].push_back(*one.self_intersections);
    if (one.seconds) values["seconds"].push_back(*one.seconds);
  }
  table_.rows.push_back(reports::MakeRow(table_, name, values, seed_));
}

std::vector<SurfaceErrors> DeformMeasurement::Errors(int num_faces_of_row, const Predictor& predict,
                                                     const std::function<void()>& done) const {
  std::vector<SurfaceErrors> errors;
  for (int i = 0; i < num_faces_of_row; ++i) {
    task_.ThrowIfCancelled("the evaluation was stopped; nothing was written");
    const Prediction prediction = predict(i);
    const geometry::TriangleMesh truth = TrueMesh(i), predicted{PointsOf(prediction.vertices), faces_.triangles};
    const torch::Tensor distances = Distances(prediction.vertices, faces_.vertices[i]).to(torch::kFloat64).contiguous();
    const eval::SurfaceMetrics surface = eval::CompareSurfaces(truth, predicted.vertices);
    SurfaceErrors one;
    one.mean_vertex_error = MeanOf(distances);
    one.p95_vertex_error = Percentile({distances.data_ptr<double>(), size_t(distances.numel())}, 95);
    one.surface_sample_error = MeanOf(Distances(prediction.samples, OnMesh(samples_[size_t(i)], faces_.vertices[i])));
    one.normal_error_degrees = surface.normal_error_degrees;
    one.flipped_triangles = surface.flipped_triangles;
    if (i < kIntersectionFaces) one.self_intersections = CountSelfIntersections(predicted);
    one.seconds = prediction.seconds;
    errors.push_back(one);
    done();
  }
  return errors;
}

const reports::MetricRow& DeformMeasurement::result() const {
  DAUMIER_CHECK(has_result_, "the network was not measured on all {} faces", num_faces());
  return table_.rows[table_.result];
}

torch::Tensor DeformMeasurement::Predicted(int i) const {
  result();
  const at::NoGradGuard no_gradient;
  return network_.DeformVertices(codes_[i].unsqueeze(0)).squeeze(0);
}

double DeformMeasurement::true_self_intersections() const {
  const int count = std::min(num_faces(), kIntersectionFaces);
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += CountSelfIntersections(TrueMesh(i));
  return sum / count;
}

geometry::TriangleMesh DeformMeasurement::TrueMesh(int i) const {
  return {PointsOf(faces_.vertices[i]), faces_.triangles};
}

}  // namespace daumier::deform
