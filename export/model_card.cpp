#include "export/model_card.h"

#include "export/onnx_graph.h"

namespace daumier::exporting {
namespace {

std::string Text(const Json& json) {
  return json.is_string() ? json.get<std::string>() : json.dump();
}

/// A field of a source's entry; "unknown" where the entry does not tell it.
std::string Field(const Json& entry, const char* name) {
  return entry.contains(name) ? Text(entry[name]) : "unknown";
}

std::string InputsAndOutputs(const sketch::SketchRun& run) {
  const auto& network = *run.network;
  const auto& options = network.options();
  std::string text = "## Input and outputs\n\n| name | shape | meaning |\n|---|---|---|\n";
  if (options.reads_image()) {
    text += fmt::format(
        "| `sketch` | ({0}, 1, {1}, {1}) float32 | frontal line drawing; ink 1, paper 0; row 0 on top; the face "
        "upright "
        "and centred as in the training sketches |\n",
        kBatchDimension, options.resolution);
  }
  if (options.reads_points()) {
    text += fmt::format(
        "| `points` | ({}, 4, {}) float32 | points at equal distances along all strokes: x to the right and y down "
        "from "
        "-1 to 1 over the canvas, cosine and sine of twice the stroke's angle |\n",
        kBatchDimension, options.num_points);
  }
  if (options.reads_shape()) {
    text += fmt::format(
        "| `shape` | ({}, {}) float32 | u and v of the 2-D model of feature curves (`curves.safetensors` of the run) "
        "that "
        "explain the drawing |\n",
        kBatchDimension, network.num_shape());
  }
  text += fmt::format(
      "| `u` | ({0}, {1}) float32 | identity weights of the bilinear face model |\n"
      "| `v` | ({0}, {2}) float32 | expression weights of the bilinear face model |\n",
      kBatchDimension, network.num_identity(), network.num_expression());
  if (options.residual > 0) {
    text += fmt::format("| `residual` | ({}, {}) float32 | what is added to the bilinear face, in the linear basis |\n",
                        kBatchDimension, options.residual);
  }
  return text + fmt::format(
                    "| `vertices` | ({0}, {1}, 3) float32 | the face in centimetres: x to its own left, y up, z to the "
                    "front; order and triangles in `template.safetensors` |\n\n"
                    "{0} is any batch size. `vertices` is the bilinear face of `u` and `v`{2}.\n\n",
                    kBatchDimension, network.num_vertices(), options.residual > 0 ? ", plus the residual" : "");
}

std::string InputsAndOutputs(const deform::DeformRun& run) {
  const deform::DeformNetwork& network = *run.network;
  const faces::ModelFrame frame = network.frame();
  std::string text = "## Input and outputs\n\n| name | shape | meaning |\n|---|---|---|\n";
  const int latent = network.options().latent;
  if (network.options().is_array()) {
    text += fmt::format(
        "| `latent` | ({0}, {1}) float32 | codes |\n"
        "| `vertices` | ({0}, {2}, 3) float32 | where the vertices go, in model units |\n\n{0} is any batch size. ",
        kBatchDimension, latent, network.num_vertices());
  } else {
    text += fmt::format(
        "| `latent` | (1, {1}) float32 | a code |\n"
        "| `points` | ({0}, 3) float32 | points on the template, in model units: its vertices stand in "
        "`points_template.safetensors`, and any point between them may be asked for |\n"
        "| `positions` | ({0}, 3) float32 | where they go, in model units |\n\n{0} is any number of points. ",
        kBatchDimension, latent);
  }
  return text + fmt::format(
                    "A point of the faces in centimetres is p_model = {:.9g} p_cm + ({:.9g}, {:.9g}, {:.9g}); the "
                    "model's metadata `model_from_cm` holds the same. The code of zeros is about the mean face; codes "
                    "of training faces have numbers of about {:.2g}.\n\n",
                    frame.scale, frame.offset.x(), frame.offset.y(), frame.offset.z(),
                    run.codes.square().mean().sqrt().item<double>());
}

std::string TrainingData(const Manifest& manifest) {
  std::string text = "## Training data and licences\n\n| source | version | licence | checksum |\n|---|---|---|---|\n";
  for (const Json& source : manifest.sources) {
    text += fmt::format("| {} | {} | {} | {} |\n", Field(source, "name"), Field(source, "version"),
                        Field(source, "licence"), Field(source, "checksum"));
  }
  text += "\nThe weights are made from these sources alone. Whoever passes the model on keeps to their licences.\n\n";
  for (const auto& [name, count] : manifest.counts.items()) text += fmt::format("- {}: {}\n", name, Text(count));
  return text + fmt::format("- seed: {}\n\n", manifest.seed);
}

std::string Errors(const std::optional<Json>& metrics) {
  if (!metrics.has_value()) {
    return "## Errors\n\nNot measured: `daumier eval` has not been run on this run before its export.\n\n";
  }
  std::string text = "## Errors\n\nFrom the run's `report/metrics.json`.\n\n| metric | value |\n|---|---|\n";
  for (const auto& [name, value] : metrics->items()) {
    if (value.is_primitive()) text += fmt::format("| {} | {} |\n", name, Text(value));
  }
  return text + "\n";
}

std::string Exactness(const ParityReport& parity) {
  if (!parity.runtime.has_value()) {
    return "## Exactness of the export\n\nThe graph passed ONNX's checker and strict shape inference. It was not run "
           "in ONNX Runtime, "
           "which was not installed.\n\n";
  }
  return fmt::format(
      "## Exactness of the export\n\nOpset {}. The answers of {} and of LibTorch differ by at most {:.2g} "
      "(`parity.json`).\n\n",
      kOpset, *parity.runtime, parity.max_abs_diff());
}

}  // namespace

std::string ModelCard(const sketch::SketchRun& run, const ParityReport& parity, const std::optional<Json>& metrics) {
  return fmt::format(
             "# Sketch to 3D face\n\n"
             "A network with {} trained parameters that turns a line drawing of a face into a 3D face of "
             "the '{}' topology, "
             "after DeepSketch2Face (Han et al., SIGGRAPH 2017), trained and exported by Daumier.\n\n",
             run.network->num_parameters(), run.face_template.source) +
         InputsAndOutputs(run) + TrainingData(run.manifest) + Errors(metrics) + Exactness(parity) +
         "## Limits\n\n"
         "- It was trained on drawings made by rendering feature curves of synthetic faces, not on drawings by people; "
         "lines that "
         "those drawings lack (hair, shading, glasses) mislead it.\n"
         "- It always answers a face of its bilinear model, whatever it is shown, and gives no confidence.\n"
         "- Depth is guessed from a frontal drawing by what is usual in the training faces.\n"
         "- It is a tool for drawing. It must not be used to identify or to judge people.\n";
}

std::string ModelCard(const deform::DeformRun& run, const ParityReport& parity, const std::optional<Json>& metrics) {
  return fmt::format(
             "# Deformable 3D caricatures\n\n"
             "A model with {} parameters of kind '{}' that turns a code into a head of the '{}' topology, after Deep "
             "Deformable 3D Caricatures (Jung et al., SIGGRAPH 2022), trained and exported by Daumier.\n\n",
             run.network->num_parameters(), run.network->options().kind, run.face_template.source) +
         InputsAndOutputs(run) + TrainingData(run.manifest) + Errors(metrics) + Exactness(parity) +
         "## Limits\n\n"
         "- It was trained on caricatures that a program made, not on artists' ones, unless a source above is such a "
         "set.\n"
         "- Nothing keeps a surface from piercing itself; strong codes do it around lips and chin.\n"
         "- It must not be used to identify or to judge people.\n";
}

}  // namespace daumier::exporting
