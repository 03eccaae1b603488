#pragma once
#include "core/folder_cache.h"
#include "systems/system.h"

namespace daumier::deform {

/// `daumier train` of a deformable model: opens the databases, splits, trains and leaves a run folder that
/// LoadDeformRun reads. The manifest holds the product, the split, the hashes of the data and their licences,
/// and holds no path. A linear model is not trained by steps: its rows are the principal components of the training
/// faces' vertices in the order of their strength, times their deviation / 0.01 and a factor that validation faces
/// choose, since the larger the rows, the less a code's weight holds it back; its codes are found as those of unseen
/// faces. device: "cpu" or "cuda".
/// @throws UsageError as ParseOptions and train::OpenRunFolder, Error as Train and the databases.
TrainingSummary TrainDeform(const Json& config, const systems::RunPlace& place, FolderCache& databases,
                            const Task& task);

}  // namespace daumier::deform
