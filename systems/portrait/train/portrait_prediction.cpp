#include "systems/portrait/train/portrait_prediction.h"

#include "core/error.h"
#include "core/log.h"
#include "faces/appearance/albedo_basis.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <set>

namespace daumier::portrait {

PredictedPortraits PredictPortraits(PortraitNetwork& network, const PortraitRenderer& renderer,
                                    const torch::Tensor& inputs) {
  constexpr int64_t kAtOnce = 32;
  const at::NoGradGuard no_grad;
  std::vector<torch::Tensor> coefficients;
  for (int64_t first = 0; first < inputs.size(0); first += kAtOnce)
    coefficients.push_back(
        models::ClampedExpressions(network->forward(inputs.slice(0, first, std::min(first + kAtOnce, inputs.size(0)))),
                                   network->expression_weights()));
  PredictedPortraits predicted{torch::cat(coefficients), {}};
  predicted.landmarks = renderer.Landmarks(predicted.coefficients);
  return predicted;
}

geometry::Points VerticesOf(const torch::Tensor& vertices, int64_t i) {
  const torch::Tensor row = vertices[i].to(torch::kFloat64).contiguous();
  return Eigen::Map<const geometry::Points>(row.data_ptr<double>(), row.size(0), 3);
}

std::vector<int> PersonsOf(const faces::FaceDatabase& faces, const std::vector<int>& subset) {
  std::set<int> persons;
  for (const int face : subset)
    for (const int person : faces.persons(face)) persons.insert(person);
  return {persons.begin(), persons.end()};
}

faces::MorphableModel ModelOfTraining(const faces::FaceDatabase& faces, const std::vector<int>& training_persons,
                                      const PortraitTrainingOptions& options) {
  const faces::FaceModel source = faces::LoadFaceModel(options.source);
  const geometry::Triangles &own = source.face_template.triangles, &other = faces.face_template().triangles;
  DAUMIER_CHECK(own.rows() == other.rows() && own == other,
                "the source '{}' has another topology than the faces of {}: set source.name and source.path",
                options.source.name, faces.directory().string());
  const faces::AlbedoBasis basis = faces::MakeAlbedoBasis(source.face_template);
  const faces::AlbedoModes albedo{basis.mean, basis.modes};
  if (options.model.identity == "shapes") return faces::ModelOfShapes(source, albedo);
  const std::vector<int> neutral = faces::NeutralFaces(faces, training_persons);
  log::Info("Fitting identity modes to {} neutral faces", neutral.size());
  return faces::ModelOfFaces(source, albedo, int(neutral.size()),
                             [&](int i) { return faces.vertices(neutral[size_t(i)]); });
}

}  // namespace daumier::portrait
