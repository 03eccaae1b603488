#pragma once
#include "fitting/code_model.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>

namespace daumier::deform {

/// A direction of the numbers of a model itself, as a change of standardised codes.
struct LatentDirection {
  Eigen::VectorXd step;  ///< M: moves the numbers by one deviation of the training codes along the direction.
  double deviation = 0;  ///< That deviation, in the model's own numbers.
};

/// z + a n of latents z = m + F c [Shen et al. 2020], with a the deviation |F^T n| of c ~ N(0, I) along the unit
/// direction n: the step is |F^T n| F^-1 n. @throws Error if it has another number of numbers or none but 0.
LatentDirection LatentDirectionOf(const fitting::CodeModel& model, const Eigen::VectorXd& direction);

/// The direction in a .npy file of M numbers, or 1 x M, as the authors' boundary.npy. @throws Error as ParseNpy and
/// LatentDirectionOf, naming the file.
LatentDirection ReadLatentDirection(const fitting::CodeModel& model, const std::filesystem::path& path);

/// Whether the name of a label is that of such a file.
bool IsDirectionFile(const std::string& label);

}  // namespace daumier::deform
