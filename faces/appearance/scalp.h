#pragma once
#include "faces/face_model.h"

#include <Eigen/SparseCore>

#include <vector>

namespace daumier::faces {

/// Mean radius of the skull of a usual head, cm.
inline constexpr double kUsualSkullRadius = 9.6;

/// Where things lie on a head, as directions from a centre in the middle of the skull at the height of the eyes: azimuth
/// 0 in front, 90 at the own left, 180 behind; elevation 90 at the crown. Degrees; ears by their absolute azimuth.
struct ScalpLines {
  double hairline, brow, ear_front, ear_back, ear_top, ear_bottom, chin;  ///< All but ear_front, ear_back: elevations.
};

/// The skull of one face without its ears, smooth, on a grid of directions: column c at the azimuth -180 + c * 360 /
/// kColumns, row r at the elevation 90 - r * kStep.
class SkullGrid {
 public:
  static constexpr int kColumns = 96, kRows = 28;
  static constexpr double kStep = 5.0;  ///< Degrees.
  static double Azimuth(int column) { return -180 + 360.0 * column / kColumns; }

  explicit SkullGrid(geometry::Points points);

  /// The point of a column at an elevation (linear between rows, clamped), and the direction outwards there.
  geometry::Vector3 At(int column, double elevation) const;
  geometry::Vector3 Outwards(int column, double elevation) const;
  const geometry::Vector3& centre() const { return centre_; }  ///< Mean of the rows at and above elevation 0.
  double radius() const { return radius_; }                    ///< Their mean distance from it, cm.

 private:
  geometry::Vector3 Mixed(const geometry::Points& of, int column, double elevation) const;
  geometry::Points points_, normals_;  ///< kRows kColumns x 3, row-major.
  geometry::Vector3 centre_;
  double radius_ = 0;
};

/// Finds the skull on faces of a topology: each grid point is a fixed mean of the face's vertices, so it follows them.
class Scalp {
 public:
  /// @throws Error if a row of directions meets the template nowhere.
  explicit Scalp(const FaceTemplate& face_template);

  SkullGrid GridOf(const geometry::Points& face) const;
  const ScalpLines& lines() const { return lines_; }
  /// V: 1 on hair-bearing skin of the template, 0 elsewhere, soft between.
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> grid_from_face_;
  ScalpLines lines_{};
  Eigen::VectorXd weights_;
};

/// The elevation, degrees, at which hair of a usual cut ends at an azimuth: hairline, temples, sideburns, around the
/// ears, nape. `receding` in [0, 1] raises it above the forehead, most at the temples.
double HairlineAt(const ScalpLines& lines, double azimuth, double receding);

/// Smooth step from 0 at a to 1 at b.
double SmoothBetween(double a, double b, double x);

}  // namespace daumier::faces
