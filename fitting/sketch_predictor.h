#pragma once
#include "models/sketch_run.h"
#include "render/image.h"

#include <filesystem>
#include <vector>

namespace daumier::fitting {

/// What the network sees of a drawing: ink (1 where the darkest, 0 on paper), R x R row by row. A picture with more
/// dark than light is taken for a negative; one that is not square is padded with paper, so that its middle stays the
/// middle; then it is scaled (area). Position and size of the face in the square are not changed: draw as the sketches
/// of the training data are drawn.
/// @throws Error if the image is empty or its paper and ink do not differ.
std::vector<float> InkOfDrawing(const render::Image& drawing, int resolution);

/// A run plus a picture -> a face: V x 3, cm.
geometry::Points PredictFace(models::SketchRun& run, const render::Image& drawing);

/// Predicts each drawing into `out_directory`: NAME.obj, and NAME.png with drawing | front | side.
/// @throws Error naming the first input that cannot be read, before anything is written; two inputs of one name; or as
/// LoadSketchRun.
void PredictSketches(const std::filesystem::path& run_directory, const std::vector<std::filesystem::path>& inputs,
                     const std::filesystem::path& out_directory);

}  // namespace daumier::fitting
