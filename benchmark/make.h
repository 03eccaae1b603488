#pragma once
#include "benchmark/definition.h"
#include "core/task.h"
#include "faces/face_model.h"

#include <filesystem>

namespace daumier::benchmark {

/// Writes a kit (benchmark/kit.h), whole or not at all; it replaces an earlier one. Persons 0 .. train - 1 are the split train, then
/// validation, then test. Truth is rounded to 0.0001 cm. Same options, model, program and processor: same bytes, by any
/// number of threads. `faces.source` is recorded without its path.
/// @throws UsageError as CheckReplacedFolder, or if there is one level alone; Error as the builders of datasets/.
void MakeBenchmark(const faces::FaceModel& model, BenchmarkOptions options, const std::filesystem::path& out,
                   const Task& task = {});

/// The persons of a split by these counts: first, and one behind the last.
struct PersonRange {
  int begin, end;
};
PersonRange PersonsOf(const PersonCounts& counts, int split);

}  // namespace daumier::benchmark
