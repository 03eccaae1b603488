#pragma once
#include "export/run_export.h"
#include "systems/deform/train/network.h"

#include <filesystem>
#include <memory>

namespace daumier::deform {

/// A SIREN as a function of latent (1, M) and points (N, 3) on the template to positions (N, 3); an array of vertices
/// as a function of latent (N, M) to vertices (N, V, 3). All in the model's frame, which the metadata store as
/// `model_from_cm` as {scale, offset}.
exporting::ExportedFunction DeformFunction(std::shared_ptr<DeformNetwork> network);

/// The export of a finished run of a deformable model, with points_template.safetensors (`vertices`, the template's
/// in the model's frame). @throws Error as LoadDeformRun.
exporting::RunExport DescribeDeformExport(const std::filesystem::path& run_directory);

}  // namespace daumier::deform
