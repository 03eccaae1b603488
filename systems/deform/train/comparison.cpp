#include "systems/deform/train/comparison.h"

#include "core/error.h"
#include "reports/comparison_sheet.h"
#include "eval/metrics.h"
#include "datasets/read/run_data.h"
#include "systems/deform/train/code_fit.h"
#include "systems/deform/train/run.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"

namespace daumier::deform {
namespace {

reports::ComparedPrediction Predict(const DeformRun& run, const geometry::Points& truth) {
  const faces::ModelFrame frame = run.network->frame();
  const torch::Tensor vertices = tensor::CopyToTensor(frame.FromCm(truth)).to(torch::kFloat32);
  const CodeFit fit =
      FitCode(*run.network, vertices, {.data_weight = run.data_weight, .code_weight = run.code_weight});
  const at::NoGradGuard no_grad;
  const torch::Tensor predicted = run.network->DeformVertices(fit.code.unsqueeze(0))[0];
  reports::ComparedPrediction prediction;
  prediction.face = frame.ToCm(tensor::CopyToMatrix<double>(predicted));
  prediction.error_mm = (prediction.face - truth).rowwise().norm() * faces::MillimetresPerCm(run.face_template);
  prediction.mean_error_mm = prediction.error_mm.mean();
  return prediction;
}

}  // namespace

render::Image DeformComparison(const std::vector<ComparedDeformRun>& runs, const std::vector<reports::ChosenFace>& faces) {
  DAUMIER_CHECK(!runs.empty(), "there is no run to compare");
  std::vector<DeformRun> loaded;
  std::vector<std::string> names;
  for (const ComparedDeformRun& run : runs) {
    loaded.push_back(LoadDeformRun(run.run));
    names.push_back(run.name);
    const Json &data = loaded.back().manifest.details.at("data"), &first = loaded.front().manifest.details.at("data");
    DAUMIER_CHECK(data.at("faces") == first.at("faces"), "{} was trained on other faces than {}", run.run.string(),
                  runs.front().run.string());
  }
  const DeformRun& first = loaded.front();
  datasets::CheckSameData(first.directory, first.manifest, first.config, "faces");
  const std::string own = first.config.at("data").at("faces").get<std::string>();
  const std::string& other = runs.front().options.faces;
  const faces::FaceDatabase database(other.empty() ? own : other);
  std::vector<reports::ComparedFace> rows;
  for (const reports::ChosenFace& face : faces) {
    reports::ComparedFace row{face.title, {}, database.points(face.face), {}};
    for (const DeformRun& run : loaded) row.predictions.push_back(Predict(run, row.truth));
    rows.push_back(std::move(row));
  }
  return reports::ComparisonSheet(first.face_template, names, rows);
}

}  // namespace daumier::deform
