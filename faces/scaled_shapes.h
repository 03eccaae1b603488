#pragma once
#include "core/safetensors.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>

/// Shapes of a linear model in two bytes or one a number, for weights that are shipped.
namespace daumier::faces {

/// Adds the columns of a matrix (R x K) as integers: value = scale_k * integer. With `tolerance` e, the largest
/// difference allowed, a column has 8 bits if its largest value is at most 254 e, else 16 bits:
///   NAME/scales (K) F32; NAME/bits (K) U8, 8 or 16;
///   NAME/int8 (columns of 8 bits, R) I8 and NAME/int16 (the others, R) I16, in their order; absent where there are none.
/// @throws Error naming the column if it is not finite or larger than 65534 e.
void AddScaledShapes(SafetensorsWriter& writer, const std::string& name, const Eigen::MatrixXf& shapes,
                     double tolerance);

/// The matrix again, each number within the tolerance of what was added. `file` names the file in messages.
/// @throws Error naming file and array if one is missing, of another type, or if sizes do not belong together.
Eigen::MatrixXf ReadScaledShapes(const SafetensorsFile& arrays, const std::string& name,
                                 const std::filesystem::path& file);

}  // namespace daumier::faces
