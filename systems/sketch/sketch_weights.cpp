#include "systems/sketch/sketch_weights.h"

#include "core/error.h"
#include "core/half.h"
#include "core/safetensors.h"
#include "faces/face_model_file.h"
#include "render/camera_json.h"

#include <algorithm>
#include <vector>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

constexpr double kTemplateToleranceCm = 0.01;

std::vector<float> Numbers(const Eigen::VectorXf& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

Eigen::VectorXf Vector(const Json& json) {
  const auto numbers = json.get<std::vector<float>>();
  return Eigen::Map<const Eigen::VectorXf>(numbers.data(), Eigen::Index(numbers.size()));
}

Json GaussianToJson(const faces::GaussianOfBasis& gaussian) {
  return {{"mean", Numbers(gaussian.mean)},
          {"deviation", Numbers(gaussian.deviation)},
          {"num_symmetric", gaussian.num_symmetric}};
}

/// The face model of the run's source next to its weights. @throws Error with the command that makes it.
fs::path FaceModelOf(const SketchRunFolder& run, const fs::path& neighbours) {
  const faces::FaceTemplate& own = run.face_template;
  const fs::path folder = (neighbours / ("face-" + own.source)).lexically_normal();
  const std::string repair =
      fmt::format("Make it: daumier dataset model --out {} source.name={} source.path=FOLDER_OR_ARCHIVE",
                  folder.string(), own.source);
  DAUMIER_CHECK(IsWeightsFolder(folder), "{} is missing, the face model to which weights of sketches refer. {}",
                folder.string(), repair);
  const faces::FaceTemplate other = faces::ReadFaceModelWeights(folder, own.source).face_template;
  const bool is_same = own.triangles.rows() == other.triangles.rows() && own.triangles == other.triangles &&
                       (own.neutral - other.neutral).cwiseAbs().maxCoeff() < kTemplateToleranceCm;
  DAUMIER_CHECK(is_same, "{} has another template than {}. {}", folder.string(), run.directory.string(), repair);
  return folder;
}

faces::FaceBasis ReadBasis(const fs::path& file, const SketchNetworkOfWeights& network) {
  const SafetensorsFile arrays(file);
  const ArrayView& basis = arrays.at("basis");
  const std::vector<int64_t> expected = {network.options.residual, 3 * int64_t(network.sizes.num_vertices)};
  DAUMIER_CHECK(basis.shape == expected, "{}: 'basis' has another shape, expected ({}, {})", file.string(), expected[0],
                expected[1]);
  faces::FaceBasis result;
  result.rows.resize(expected[0], expected[1]);
  std::ranges::transform(basis.As<Half>(), result.rows.data(), FloatFromHalf);
  return result;
}

}  // namespace

Json NetworkToJson(const SketchNetworkOfWeights& network) {
  return {{"options", ToJson(network.options)}, {"sizes", ToJson(network.sizes)}};
}

SketchNetworkOfWeights SketchNetworkFromJson(const Json& json) {
  const std::string where = "the network of shipped weights";
  DAUMIER_CHECK(json.is_object() && json.contains("options") && json.contains("sizes"),
                "{} has no tables 'options' and 'sizes'", where);
  return {ParseOptions<SketchNetworkOptions>(json.at("options"), where),
          ParseOptions<SketchNetworkSizes>(json.at("sizes"), where)};
}

WeightsParts WriteSketchWeights(const SketchRunFolder& run, const fs::path& neighbours) {
  const SketchNetworkOptions& network = run.network_options;
  DAUMIER_CHECK(!network.reads_shape() && network.residual > 0 && network.basis == "gaussian",
                "{}: weights are made of networks that read no curve coefficients and have network.basis=\"gaussian\" "
                "and network.residual > 0 (configs/sketch/drawings.toml)",
                run.directory.string());
  const fs::path face_model = FaceModelOf(run, neighbours);
  WeightsParts parts;
  parts.details = {{"face_model", face_model.filename().string()},
                   {"needs", {{face_model.filename().string(), DataHash(face_model)}}},
                   {"sketches", {{"camera", render::CameraToJson(run.camera)}, {"feature_curves", run.feature_curves}}},
                   {"gaussian", GaussianToJson(faces::InBasis(run.models.gaussian, run.models.basis))}};
  return parts;
}

SketchRunFolder ReadSketchWeights(const fs::path& directory) {
  SketchRunFolder run;
  run.directory = directory;
  run.manifest = ReadWeights(directory, kSystem, {kWeightsNetwork});
  run.config = run.manifest.config;
  const std::string file = (directory / "manifest.json").string();
  const Json& details = run.manifest.details;
  for (const char* key : {"network", "sketches", "gaussian", "face_model"})
    DAUMIER_CHECK(details.contains(key), "{}: details.{} is missing", file, key);
  const SketchNetworkOfWeights network = SketchNetworkFromJson(details.at("network"));
  run.network_options = network.options;
  try {
    run.camera = render::CameraFromJson(details.at("sketches").at("camera"));
    run.feature_curves = details.at("sketches").at("feature_curves").get<std::vector<std::string>>();
    const Json& gaussian = details.at("gaussian");
    run.models.basis = ReadBasis(directory / kWeightsNetwork, network);
    run.models.gaussian =
        faces::FromBasis({Vector(gaussian.at("mean")), Vector(gaussian.at("deviation")), gaussian.at("num_symmetric")},
                         run.models.basis);
    const fs::path face_model = NeededWeights(directory, run.manifest, details.at("face_model").get<std::string>());
    run.face_template = faces::ReadFaceModelWeights(face_model).face_template;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: details are malformed: {}", file, TextOf(error)));
  }
  DAUMIER_CHECK(run.face_template.num_vertices() == network.sizes.num_vertices,
                "{}: the network has {} vertices, but the template {}", file, network.sizes.num_vertices,
                run.face_template.num_vertices());
  return run;
}

SketchRunFolder ReadSketchFolder(const fs::path& run_or_weights) {
  return IsWeightsFolder(run_or_weights) ? ReadSketchWeights(run_or_weights) : ReadSketchRunFolder(run_or_weights);
}

}  // namespace daumier::sketch
