#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "export/parity.h"

#include <optional>
#include <string>
#include <vector>

namespace daumier::exporting {

/// What a system writes of its model, in Markdown.
struct CardText {
  std::string title, summary;
  std::string inputs_and_outputs;   ///< A table of names, shapes, units and frames, and what follows it.
  std::vector<std::string> limits;  ///< One sentence or more an entry.
};

/// Parts of a card, in Markdown: sources with licences and checksums, counts and seed; errors, `PART.KEY` for those of a
/// part of the report; limits.
std::string CardTrainingData(const Manifest& manifest);
std::string CardErrors(const std::optional<Json>& metrics);
std::string CardLimits(const CardText& text);

/// The model card of an exported run: the text of its system, what it was trained on with the licence of every source
/// in the run's manifest, its errors if `metrics` (report/metrics.json) is given, how exact the export is, limits.
std::string ModelCard(const CardText& text, const Manifest& run, const ParityReport& parity,
                      const std::optional<Json>& metrics);

}  // namespace daumier::exporting
