#pragma once
#include "core/json.h"
#include "export/parity.h"
#include "systems/deform/train/run.h"
#include "systems/sketch/train/run.h"

#include <optional>
#include <string>

namespace daumier::exporting {

/// The model card of an exported sketch run, in Markdown: what it is, inputs and outputs with units and frames, what it
/// was trained on with the licence of every source in the run's manifest, its errors where `metrics`
/// (report/metrics.json) is there, how exact the export is, and its limits.
std::string ModelCard(const sketch::SketchRun& run, const ParityReport& parity, const std::optional<Json>& metrics);
/// The same of an exported deformable model.
std::string ModelCard(const deform::DeformRun& run, const ParityReport& parity, const std::optional<Json>& metrics);

}  // namespace daumier::exporting
