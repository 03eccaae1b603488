#include "export/weights_card.h"

#include "core/licence_text.h"
#include "core/weights_folder.h"

namespace daumier::exporting {
namespace {

std::string HowItWasMade(const Manifest& manifest) {
  std::string text = "## How it was made\n\n";
  const Json& recipe = manifest.details.at("recipe");
  if (!recipe.empty()) {
    text += "| command | seconds |\n|---|---:|\n";
    for (const Json& step : recipe)
      text += fmt::format("| `{}` | {} |\n", step.at("command").get<std::string>(), step.at("seconds").dump());
    text += "\n";
  }
  return text + fmt::format(
                    "The training took {} s on a CPU, across resumes. All its options are `config` in `manifest.json`; "
                    "the seed is {}.\n\n",
                    manifest.details.at("training_seconds").dump(), manifest.seed);
}

std::string EffectOfHalf(const Manifest& manifest) {
  const Json& half = manifest.details.at("float16");
  std::string text = fmt::format(
      "## Numbers in float16\n\nLargest difference from the network of the run, in float32, as a share of each "
      "output's "
      "largest value. Input: {} samples, {}. At most {:g} is allowed.\n\n| output | difference |\n|---|---|\n",
      half.at("num_samples").dump(), half.at("samples").get<std::string>(), half.at("tolerance").get<double>());
  for (const auto& [name, share] : half.at("largest_difference").items())
    text += fmt::format("| `{}` | {:.2g} |\n", name, share.get<double>());
  return text + "\n";
}

std::string Needs(const Manifest& manifest) {
  std::string text;
  const Json needs = manifest.details.value("needs", Json::object());
  for (const auto& [name, hash] : needs.items())
    text += fmt::format("It needs the weights `{}` in the folder next to it.\n\n", name);
  return text;
}

}  // namespace

std::string WeightsCard(const CardText& text, const Manifest& manifest, const Json& metrics, const std::string& notes) {
  return fmt::format("# {}\n\n{}\n\n{}## Input and outputs\n\n{}", text.title, text.summary, Needs(manifest),
                     text.inputs_and_outputs) +
         CardTrainingData(manifest) + LicenceNotices(manifest.sources) + HowItWasMade(manifest) + CardErrors(metrics) +
         (notes.empty() ? "" : notes + "\n\n") + EffectOfHalf(manifest) + CardLimits(text);
}

}  // namespace daumier::exporting
