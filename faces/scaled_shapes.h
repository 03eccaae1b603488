#pragma once
#include "core/safetensors.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>

/// Shapes of a linear model in two bytes or one a number, for weights that are shipped.
namespace daumier::faces {

/// Adds the columns of a matrix (R x K) as integers: value = scale_k * integer. A column whose largest value is at most
/// 254 e, of `tolerance` e, has 8 bits, else 16 bits. Numbers differ by at most e, or a 65534th of the largest value of
/// their column if that is more:
///   NAME/scales (K) F32; NAME/bits (K) U8, 8 or 16;
///   NAME/int8 (columns of 8 bits, R) I8 and NAME/int16 (the others, R) I16, in their order; absent where there are none.
/// @throws Error naming the column if it is not finite.
void AddScaledShapes(SafetensorsWriter& writer, const std::string& name, const Eigen::MatrixXf& shapes,
                     double tolerance);

/// The matrix again. `file` names the file in messages.
/// @throws Error naming file and array if one is missing, of another type, or if sizes do not belong together.
Eigen::MatrixXf ReadScaledShapes(const SafetensorsFile& arrays, const std::string& name,
                                 const std::filesystem::path& file);

}  // namespace daumier::faces
