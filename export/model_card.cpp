#include "export/model_card.h"

#include "export/onnx_graph.h"

namespace daumier::exporting {
namespace {

std::string Text(const Json& json) {
  return json.is_string() ? json.get<std::string>() : json.dump();
}

/// A field of a source's entry; "unknown" where the entry lacks it.
std::string Field(const Json& entry, const char* name) {
  return entry.contains(name) ? Text(entry[name]) : "unknown";
}

std::string OtherRuntimes(const ParityReport& parity) {
  std::string text;
  for (const OtherRuntime& other : parity.others) {
    text += fmt::format("{}, batch sizes {}: ", other.runtime, fmt::join(other.batch_sizes, ", "));
    if (other.refusal.has_value()) {
      text += fmt::format("does not run it. {}\n\n", *other.refusal);
    } else {
      text += fmt::format("outputs differ from LibTorch's by at most {:.2g} of the largest value{}.\n\n",
                          *other.max_relative_diff, other.agrees() ? "" : ", which is too much: do not use it there");
    }
  }
  return text;
}

std::string Exactness(const ParityReport& parity) {
  if (!parity.runtime.has_value()) {
    return "## Exactness of the export\n\nThe graph passed ONNX's checker and strict shape inference. It was not run "
           "in ONNX Runtime, "
           "which was not installed.\n\n" +
           OtherRuntimes(parity);
  }
  return fmt::format(
      "## Exactness of the export\n\nOpset {}. The outputs of {} and of LibTorch differ by at most {:.2g} "
      "(`parity.json`).\n\n{}",
      kOpset, *parity.runtime, parity.max_abs_diff(), OtherRuntimes(parity));
}

}  // namespace

std::string CardTrainingData(const Manifest& manifest) {
  std::string text = "## Training data and licences\n\n| source | version | licence | checksum |\n|---|---|---|---|\n";
  for (const Json& source : manifest.sources) {
    text += fmt::format("| {} | {} | {} | {} |\n", Field(source, "name"), Field(source, "version"),
                        Field(source, "licence"), Field(source, "checksum"));
  }
  text += "\nThe weights are made from these sources alone. Whoever passes the model on keeps to their licences.\n\n";
  for (const auto& [name, count] : manifest.counts.items()) text += fmt::format("- {}: {}\n", name, Text(count));
  return text + fmt::format("- seed: {}\n\n", manifest.seed);
}

std::string CardErrors(const std::optional<Json>& metrics) {
  if (!metrics.has_value()) {
    return "## Errors\n\nNot measured: `daumier eval` has not been run on this run before its export.\n\n";
  }
  std::string text = "## Errors\n\nFrom the run's `report/metrics.json`.\n\n| metric | value |\n|---|---|\n";
  const auto add = [&](const std::string& name, const Json& value) {
    if (value.is_primitive() && !value.is_null()) text += fmt::format("| {} | {} |\n", name, Text(value));
  };
  for (const auto& [name, value] : metrics->items()) {
    add(name, value);
    if (!value.is_object()) continue;
    for (const auto& [part, of_part] : value.items()) add(name + "." + part, of_part);
  }
  return text + "\n";
}

std::string CardLimits(const CardText& text) {
  std::string limits = "## Limits\n\n";
  for (const std::string& limit : text.limits) limits += fmt::format("- {}\n", limit);
  return limits;
}

std::string ModelCard(const CardText& text, const Manifest& run, const ParityReport& parity,
                      const std::optional<Json>& metrics) {
  return fmt::format("# {}\n\n{}\n\n## Input and outputs\n\n{}", text.title, text.summary, text.inputs_and_outputs) +
         CardTrainingData(run) + CardErrors(metrics) + Exactness(parity) + CardLimits(text);
}

}  // namespace daumier::exporting
