#pragma once
#include "faces/bilinear_model.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace daumier::faces {

/// A linear model of faces without a mean: face = rows^T c, with c = rows * face the nearest one.
struct FaceBasis {
  BilinearModel::Core rows;   ///< R x 3V, orthonormal; the first is about the mean face.
  Eigen::VectorXf deviation;  ///< R, cm: how far c is from that of the face's bilinear model, root mean square.

  int size() const { return static_cast<int>(rows.rows()); }
};

/// The `size` directions that explain most of some faces, by the eigenvectors of their Gram matrix (n x n for n faces);
/// deviation is left empty. face(i), i = 0 .. num_faces - 1: 3V coordinates. Signs are fixed: the entry of largest
/// magnitude of a row is positive.
/// @throws Error if there are fewer faces, or fewer independent ones, than directions; Cancelled if the task is.
FaceBasis FitFaceBasis(int num_faces, int num_coordinates, const std::function<std::span<const float>(int)>& face,
                       int size, const Task& task = {});

/// One safetensors file (docs/formats.md); atomic. Returns its checksum.
std::string WriteFaceBasis(const std::filesystem::path& file, const FaceBasis& basis);
/// @throws Error naming file and cause: missing, truncated, of a newer version, or shapes that do not belong together.
FaceBasis ReadFaceBasis(const std::filesystem::path& file);

}  // namespace daumier::faces
