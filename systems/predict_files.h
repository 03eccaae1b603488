#pragma once
#include "core/json.h"
#include "systems/predictor.h"
#include "systems/system.h"

#include <filesystem>
#include <vector>

namespace daumier::systems {

/// `daumier predict`: for every input of the files a mesh NAME.obj, a sheet NAME.png of input, front and side, of
/// drawings also the strokes on the canvas NAME.svg, and a manifest (kind "predictions"). NAME is the file's; inputs of
/// the same name are numbered -2, -3, ..., and those that the predictor separates (Predictor::Separate) _1, _2, .... details.drawings.NAME holds the record of each result. `options`: of the
/// predictor, every one present, for the manifest.
/// Nothing is written unless every file can be read and every input predicted.
/// @throws Error naming the file and the cause, or `out_directory` if it is a file or a folder of another kind; Cancelled if
/// the task is.
void PredictFiles(const System& system, const Predictor& predictor, const std::filesystem::path& run,
                  const std::vector<std::filesystem::path>& files, const std::filesystem::path& out_directory,
                  const Json& options, const Task& task = {});

}  // namespace daumier::systems
