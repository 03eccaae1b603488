#pragma once
#include "core/json.h"
#include "systems/sketch/evaluation_options.h"

#include <filesystem>
#include <string>

namespace daumier::sketch {

/// `daumier eval RUN --faces DIR --sketches DIR`: a run on somebody else's faces, predicted as `daumier predict` does,
/// but in the frame of their sketches. Rows: the mean face of the bilinear model (of its mean u and v), the network,
/// the network with its contours matched, that and the mean face moved onto the strokes (fitting/stroke_deformation.h),
/// the limit of the model, and of faces of the run's own topology with exact sketches the ridge regression and the
/// nearest neighbour of eval/, which read labelled curve points and are fitted on the run's training data;
/// where that cannot be opened they are left out. Each has the two-way distance in pixels of the 256 canvas between the
/// drawn silhouette and feature lines, as augmented, and the face's projected curves; faces of the run's own topology
/// also the mean vertex error in mm over the region `face`, with the scale of their own template, and of registered
/// ones (`daumier register`) that over the vertices of the region with a match on the registered mesh: elsewhere the
/// "true" face is what the registration made up. Writes metrics.json (returned: num_faces, data_hash, run_data_hash,
/// same_topology, augmentation_strength, and table: a list of name, error, error_low, error_high, p90, the errors null
/// for another topology, of registered faces matched_error, matched_error_low, matched_error_high, and curve_error_px),
/// table.md, sheet.png (median, 95th percentile, worst, first by the network's error in mm or else in pixels: sketch
/// with the deformed face's curves, the true face, the network's face, and the deformed one from the front and the
/// side) and a manifest.
/// @throws Error as LoadSketchRun and the databases, or if the sketches are of other faces.
Json EvaluateOnOtherFaces(const std::filesystem::path& run_directory, const std::filesystem::path& out_directory,
                          const OtherFacesOptions& options);

}  // namespace daumier::sketch
