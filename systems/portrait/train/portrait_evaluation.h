#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "reports/evaluation.h"
#include "systems/portrait/portrait_evaluation_options.h"

#include <filesystem>

namespace daumier::portrait {

/// `daumier eval` of a portrait run on portraits of unseen persons. Rows: the network, with crops by the true landmarks;
/// the network refined through the renderer to the true landmarks, on the first refined_images; the mean face with its
/// pose fitted to the true landmarks, and the landmark fit of the 3DMM; with `detected` the same with those landmarks.
/// metrics: docs/formats.md. @throws Error as LoadPortraitRun and PortraitDatabase, or if the data differ from those of
/// the run; UsageError if the subset is empty; Cancelled.
reports::Evaluation EvaluatePortraitRun(const std::filesystem::path& run_directory, const PortraitEvalOptions& options,
                                        FolderCache& databases, const Task& task = {});

}  // namespace daumier::portrait
