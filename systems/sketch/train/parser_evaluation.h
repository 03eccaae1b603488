#pragma once
#include "core/folder_cache.h"
#include "core/task.h"
#include "reports/evaluation.h"
#include "systems/sketch/parser_evaluation_options.h"

#include <filesystem>

namespace daumier::sketch {

/// Measures a finished run on styled drawings of unseen persons, one a face, and never of those that it was trained on.
/// Rows: the whole parser; the network alone (one round, no mirror image) in the frame of the training drawings; and as
/// baseline the mean points of training drawings, placed by the extents of a drawing's lines. Drawings without a point
/// do not count. metrics.json also holds balanced accuracies of mouth, eyes and view (of the parser) and of labels (of
/// the network alone). @throws Error as LoadParserRun and FindRunData; UsageError if the side of the split is empty.
reports::Evaluation EvaluateParser(const std::filesystem::path& run_directory, const ParserEvalOptions& options,
                                   FolderCache& databases, const Task& task);

}  // namespace daumier::sketch
