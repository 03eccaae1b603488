#include "systems/expression/predictor.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "systems/expression/options.h"
#include "systems/open_network.h"
#include "systems/predict_each.h"

#include <algorithm>
#include <cmath>

namespace daumier::expression {

ExpressionPredictor::ExpressionPredictor(std::vector<std::string> expressions, int64_t num_vertices,
                                         std::unique_ptr<runtime::NetworkRunner> network)
    : expressions_(std::move(expressions)), num_vertices_(num_vertices), network_(std::move(network)) {}

std::vector<systems::FaceResult> ExpressionPredictor::Predict(std::span<const systems::Input> inputs,
                                                              const Task& task) const {
  return systems::PredictEach(inputs, task, "meshes", [&](const systems::Input& input) {
    const auto* const mesh = std::get_if<geometry::PolygonMesh>(&input);
    DAUMIER_CHECK(mesh != nullptr, "this is no mesh (expected an OBJ or PLY file of the run's topology)");
    DAUMIER_CHECK(mesh->vertices.rows() == num_vertices_, "the mesh has {} vertices (expected {}, the run's topology)",
                  mesh->vertices.rows(), num_vertices_);
    FloatArray vertices({1, 3 * num_vertices_});
    for (int64_t k = 0; k < 3 * num_vertices_; ++k) vertices.values[size_t(k)] = float(mesh->vertices(k / 3, k % 3));
    std::vector<float> scores = network_->Run({{"vertices", std::move(vertices)}}).at("scores").values;
    const float largest = *std::ranges::max_element(scores);
    double sum = 0;
    for (float& score : scores) sum += score = std::exp(score - largest);

    systems::FaceResult result;
    for (size_t e = 0; e < expressions_.size(); ++e) result.record["probabilities"][expressions_[e]] = scores[e] / sum;
    result.record["expression"] = expressions_[size_t(std::ranges::max_element(scores) - scores.begin())];
    result.files = {{".json", result.record.dump(1) + "\n"}};
    return result;
  });
}

std::unique_ptr<systems::Predictor> OpenPredictor(const std::filesystem::path& run, const Device& device,
                                                  const Json& options) {
  ParseOptions<PredictOptions>(options, "options of predict");
  const Manifest manifest = ReadFinishedRun(run, kSystem);
  return std::make_unique<ExpressionPredictor>(manifest.details.at("expressions").get<std::vector<std::string>>(),
                                               manifest.details.at("vertices").get<int64_t>(),
                                               systems::OpenNetwork(run, device));
}

}  // namespace daumier::expression
