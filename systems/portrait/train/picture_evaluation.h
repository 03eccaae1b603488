#pragma once
#include "core/json.h"
#include "render/image.h"
#include "reports/report_table.h"
#include "systems/portrait/train/portrait_run.h"

#include <filesystem>

namespace daumier::portrait {

/// How well predicted faces meet the landmarks of pictures without a known face.
struct PictureEvaluation {
  reports::ReportTable table;
  Json metrics;  ///< {rows: [{name, mean, median, eyes, jaw, num_pictures}], pictures: {NAME: {row: error}}}
  /// Crop, landmarks (given green, predicted red) and overlay of a picture: of median, 95th percentile, largest and first
  /// error (reports::ChooseFaces), one a row; and of all, two a row.
  render::Image chosen, all;
};

/// Pictures of a folder that have a landmark file of the same name (LandmarksInFolder), in the order of PicturesIn. Rows: the network with
/// crops by the given landmarks; with `detected` (a folder, may be empty) by those; the landmark fit and the mean face,
/// which see the landmarks that they are measured by. Errors as NormalisedError. @throws Error if there is no picture.
PictureEvaluation EvaluatePictures(const std::filesystem::path& folder, const std::filesystem::path& detected,
                                   PortraitRun& run);

}  // namespace daumier::portrait
