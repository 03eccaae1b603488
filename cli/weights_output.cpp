#include "cli/weights_output.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/output_place.h"
#include "rig/expression_map_file.h"
#include "rig/weights_csv.h"

#include <functional>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

void CheckOwnFile(const MapOutput& output, const char* extension, const std::vector<fs::path>& inputs,
                  const std::function<bool(const std::string& text)>& is_own) {
  if (output.out.extension() != extension)
    throw UsageError(fmt::format("--out {}: expected a name that ends in {}", output.out.string(), extension));
  const bool may_replace = output.force || (fs::is_regular_file(output.out) && is_own(ReadFile(output.out)));
  CheckOutputFile(output.out, may_replace ? ExistingFile::kReplaced : ExistingFile::kKept, inputs);
}

}  // namespace

void CheckWeightsFile(const MapOutput& output, const std::vector<fs::path>& inputs) {
  CheckOwnFile(output, ".csv", inputs, [](const std::string& text) { return text.starts_with(rig::kWeightsCsvMark); });
}

void CheckMapFile(const MapOutput& output, const std::vector<fs::path>& inputs) {
  CheckOwnFile(output, ".json", inputs, [](const std::string& text) {
    const auto json = TryParseJson(text);
    return json && json->is_object() && json->value("kind", Json()) == rig::kExpressionMapKind;
  });
}

void WriteWeights(const fs::path& out, const WeightsTable& table) {
  WriteFileAtomically(out, rig::WeightsCsv(table.weights, table.seconds, table.remarks));
}

std::vector<double> EvenSeconds(Eigen::Index num_frames, double frames_per_second) {
  std::vector<double> seconds;
  for (Eigen::Index frame = 0; frame < num_frames; ++frame) seconds.push_back(double(frame) / frames_per_second);
  return seconds;
}

}  // namespace daumier::cli
