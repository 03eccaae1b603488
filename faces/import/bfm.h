#pragma once
#include "faces/annotation_file.h"
#include "faces/face_model.h"

#include <filesystem>

namespace daumier::faces {

/// The Basel Face Model, the whole head in cm. 2009 [Paysan et al. 2009], 01_MorphableModel.mat: shapeMU, shapePC,
/// shapeEV (standard deviations) in micrometres, tl counted from 1 and wound clockwise; no expressions. 2017 and 2019
/// [Gerig et al. 2018], .h5: shape/model and expression/model {mean, pcaBasis, pcaVariance} in millimetres,
/// shape/representer/cells; an expression is the mean expression plus a mode.
/// @throws Error naming file and array: as ReadMatFile and ReadHdf5, missing, or of a size that does not fit the
/// others.
FaceModel LoadBfm(const std::filesystem::path& file, const AnnotationFile& annotation);

}  // namespace daumier::faces
