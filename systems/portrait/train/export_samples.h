#pragma once
#include "export/exported_function.h"
#include "systems/portrait/landmark_run_folder.h"
#include "systems/portrait/portrait_run_folder.h"

/// Crops of the portraits that a run was trained on, as its network reads them, on which an exported network is compared
/// with it. Where the portraits of the run are not there any more, or are others, the function keeps its own samples.
namespace daumier::portrait {

void SampleLandmarkCrops(const LandmarkRunFolder& run, exporting::ExportedFunction& function);
void SamplePortraitCrops(const PortraitRunFolder& run, exporting::ExportedFunction& function);

}  // namespace daumier::portrait
