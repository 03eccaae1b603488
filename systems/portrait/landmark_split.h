#pragma once
#include "core/json.h"
#include "datasets/read/splits.h"
#include "systems/portrait/landmark_sample.h"

#include <string>

namespace daumier::portrait {

/// Samples of a source, split as `options` specify; all samples of a person are on one side. Deterministic in seed; every
/// share above zero gets at least one person (or sample).
/// @throws Error if there are too few persons for the shares.
datasets::Split SplitSamples(const LandmarkSource& source, const datasets::SplitOptions& options, uint64_t seed);

/// For manifests: of each of train, validation and test {num_portraits, num_persons, portraits_checksum}.
Json SampleSplitToJson(const LandmarkSource& source, const datasets::Split& split);

}  // namespace daumier::portrait
