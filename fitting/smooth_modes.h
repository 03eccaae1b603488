#pragma once
#include "faces/bilinear_model.h"
#include "geometry/mesh.h"

#include <Eigen/Core>

namespace daumier::fitting {

/// Displacements in x and y of a face that are smooth over distances of `length_cm`: a Gaussian process over positions p
/// of the template with the covariance
///   deviation^2 exp(-|p - p'|^2 / (2 length^2)),
/// of which a displacement and its mirror image (x -> -x) are independent up to `asymmetry`: symmetric displacements have
/// deviation * sqrt(2 / (1 + asymmetry^2)), others asymmetry times as much. Nystroem's approximation over `centres`.
struct SmoothModes {
  /// A row a mode, 2V columns x0 y0 x1 ..., cm a standard deviation; weights of modes are independent N(0, 1). Greatest
  /// first.
  faces::BilinearModel::Core rows;
  int size() const { return int(rows.rows()); }
};

struct SmoothModesOptions {
  double length_cm = 3, deviation_cm = 0.3, asymmetry = 0.5;
  double least_share = 0.02;  ///< Modes of a smaller share of the greatest one's variance at the centres are left out.
};

/// positions: V x 3; centres: Z x 3, each on its own side or in the middle; their mirror images count too. @throws Error
/// if there is no centre or a length is not positive.
SmoothModes MakeSmoothModes(const geometry::Points& positions, const geometry::Points& centres,
                            const SmoothModesOptions& options = {});

}  // namespace daumier::fitting
