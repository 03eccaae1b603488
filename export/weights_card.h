#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "export/model_card.h"

#include <string>

namespace daumier::exporting {

/// README.md of shipped weights: the text of the system, sources with the notices of their licences, commands with
/// seconds, seed, errors of the run's report, the effect of float16, limits. manifest: of the weights. notes: Markdown,
/// placed behind the errors; may be empty.
std::string WeightsCard(const CardText& text, const Manifest& manifest, const Json& metrics, const std::string& notes);

}  // namespace daumier::exporting
