#include "export/weights.h"

#include "core/error.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "core/safetensors.h"
#include "core/staged_directory.h"
#include "export/onnx_export.h"
#include "export/weights_card.h"
#include "tensor/half_module.h"
#include "tensor/torch_version.h"

#include <cmath>

namespace daumier::exporting {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kNumSamples = 8;

std::vector<torch::Tensor> OutputsOf(const ExportedFunction& function, const std::vector<torch::Tensor>& inputs) {
  std::vector<torch::Tensor> outputs;
  for (const torch::Tensor& output : function.forward(inputs)) outputs.push_back(output.to(torch::kFloat64));
  return outputs;
}

/// By output: the largest difference as a share of the run's largest value.
Json CompareOutputs(const ExportedFunction& run, const ExportedFunction& written, uint64_t seed) {
  const at::NoGradGuard no_grad;
  Rng rng = Stream(seed, "weights");
  std::vector<torch::Tensor> inputs;
  for (const ExportedInput& input : run.inputs) inputs.push_back(input.sample(kNumSamples, rng));
  const std::vector<torch::Tensor> own = OutputsOf(run, inputs), other = OutputsOf(written, inputs);
  DAUMIER_CHECK(own.size() == other.size() && run.output_names == written.output_names,
                "the written network has {} outputs, expected {}", other.size(), own.size());
  Json shares = Json::object();
  for (size_t i = 0; i < own.size(); ++i) {
    const std::string& name = run.output_names[i];
    DAUMIER_CHECK(own[i].sizes() == other[i].sizes(), "the output '{}' of the written network has another shape", name);
    const double largest = own[i].abs().max().item<double>();
    const double difference = (own[i] - other[i]).abs().max().item<double>();
    const double share = largest > 0 ? difference / largest : difference;
    DAUMIER_CHECK(share <= kHalfTolerance,
                  "float16 moves the output '{}' by {:.3g} of its largest value (at most {:g} is allowed): the network "
                  "is too sensitive to be shipped. Train again with optimiser.weight_decay",
                  name, share, kHalfTolerance);
    shares[name] = share;
  }
  return shares;
}

Json RecipeToJson(const std::vector<RecipeStep>& recipe) {
  Json steps = Json::array();
  for (const RecipeStep& step : recipe)
    steps.push_back({{"command", step.command}, {"seconds", std::lround(step.seconds)}});
  return steps;
}

std::string SampleTexts(const ExportedFunction& function) {
  std::string text;
  for (const ExportedInput& input : function.inputs)
    text += fmt::format("{}`{}`: {}", text.empty() ? "" : "; ", input.name, input.sample_text);
  return text;
}

}  // namespace

std::vector<RecipeStep> ReadRecipe(const fs::path& file) {
  const Json steps = ReadJson(file);
  std::vector<RecipeStep> recipe;
  DAUMIER_CHECK(steps.is_array(), "{}: this is no list (expected a list of {{\"command\": TEXT, \"seconds\": NUMBER}})",
                file.string());
  for (const Json& step : steps) {
    DAUMIER_CHECK(step.is_object() && step.size() == 2 && step.contains("command") && step.contains("seconds") &&
                      step.at("command").is_string() && step.at("seconds").is_number() && step.at("seconds") >= 0,
                  "{}: step {} is {} (expected {{\"command\": TEXT, \"seconds\": NUMBER}})", file.string(),
                  recipe.size() + 1, step.dump());
    recipe.push_back({step.at("command"), step.at("seconds")});
  }
  return recipe;
}

NetworkFunction ReadWeightsNetwork(const fs::path& directory, const Json& details, MakeNetwork make_network) {
  const std::string file = (directory / "manifest.json").string();
  DAUMIER_CHECK(details.contains("network"), "{}: details.network is missing", file);
  NetworkFunction network = make_network(details.at("network"));
  tensor::LoadHalfModule(directory / kWeightsNetwork, *network.module);
  network.module->eval();
  for (torch::Tensor& parameter : network.module->parameters()) parameter.requires_grad_(false);
  return network;
}

std::string WriteWeightsGraph(const fs::path& directory, const NetworkFunction& network) {
  onnx::ModelProto model = ExportToOnnx(*network.module, network.function);
  const SafetensorsFile stored(directory / kWeightsNetwork);
  for (onnx::TensorProto& tensor : *model.mutable_graph()->mutable_initializer()) {
    if (!stored.contains(tensor.name())) continue;
    tensor.clear_raw_data();
    tensor.set_data_location(onnx::TensorProto::EXTERNAL);
    onnx::StringStringEntryProto& location = *tensor.add_external_data();
    location.set_key("location");
    location.set_value(kWeightsNetwork);
  }
  const std::string bytes = model.SerializeAsString();
  WriteFileAtomically(directory / kWeightsGraph, bytes);
  return Sha256(bytes);
}

Json WriteWeights(const RunExport& run, MakeNetwork make_network, const WeightsRequest& request) {
  const std::string system = SystemOf(run.run_manifest);
  DAUMIER_CHECK(run.for_weights.has_value() && make_network != nullptr,
                "{}: runs of the task '{}' are not shipped as weights. Export it without --weights",
                run.run_directory.string(), system);
  const std::optional<Json> metrics = ReadRunMetrics(run.run_directory);
  DAUMIER_CHECK(metrics.has_value(),
                "{} has no report, whose errors the card of weights shows. Run `daumier eval {}` first",
                run.run_directory.string(), run.run_directory.string());
  StagedDirectory staged(request.out, kWeightsKind);

  Manifest manifest{.kind = kWeightsKind, .verb = "export --weights"};
  manifest.config = run.run_manifest.config;
  manifest.seed = run.run_manifest.seed;
  manifest.sources = run.run_manifest.sources;
  manifest.counts = run.run_manifest.counts;
  manifest.counts.update(run.counts);
  manifest.details = {{"weights_version", kWeightsVersion},
                      {"system", system},
                      {"network", run.for_weights->network},
                      {"run_data_hash", DataHash(run.run_directory)},
                      {"training_seconds", std::lround(request.training_seconds)},
                      {"recipe", RecipeToJson(request.recipe)}};
  if (run.for_weights->write_rest) {
    WeightsParts parts = run.for_weights->write_rest(staged.path(), WeightsNextTo(request.out, "."));
    manifest.checksums.merge(parts.checksums);
    manifest.details.update(parts.details);
  }
  manifest.checksums[kWeightsNetwork] = tensor::SaveHalfModule(staged.path() / kWeightsNetwork, *run.module);
  const NetworkFunction written = ReadWeightsNetwork(staged.path(), manifest.details, make_network);
  manifest.checksums[kWeightsGraph] = WriteWeightsGraph(staged.path(), written);
  const ExportedFunction function = FunctionWithSamples(run);
  manifest.details["float16"] = {{"samples", SampleTexts(function)},
                                 {"num_samples", kNumSamples},
                                 {"largest_difference", CompareOutputs(function, written.function, manifest.seed)},
                                 {"tolerance", kHalfTolerance}};
  const std::string card = WeightsCard(run.card, manifest, *metrics, request.notes);
  WriteFileAtomically(staged.path() / kWeightsCard, card);
  manifest.checksums[kWeightsCard] = Sha256(card);
  WriteManifest(staged.path(), manifest);
  staged.Commit();
  return manifest.details;
}

}  // namespace daumier::exporting
