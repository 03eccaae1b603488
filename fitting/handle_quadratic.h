#pragma once
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <optional>

namespace daumier::fitting {

/// The energy of handles where positions are linear in the move y of a code,
///   E(y) = |y|^2 + |H y - h|^2 / s^2 + |O y - o|^2 / s_o^2,
/// whose minimum it finds for any moves h and o and deviations s and s_o without another factorisation: with
/// O^T O = Q T Q^T, T tridiagonal [Golub and Van Loan 2013, section 8.3.1], I + T / s_o^2 is solved in linear time, and
/// the handles are few.
class HandleQuadratic {
 public:
  /// handle_rows: H, a row a coordinate; outside_rows: O, or no rows. @throws Error if their columns differ.
  HandleQuadratic(const Eigen::MatrixXd& handle_rows, const Eigen::MatrixXd& outside_rows);

  struct Deviations {
    double handle, outside;  ///< s and s_o, of a coordinate.
  };
  /// y; outside_moves may be empty: all 0. @throws Error if a size disagrees.
  Eigen::VectorXd Minimum(const Eigen::VectorXd& handle_moves, const Eigen::VectorXd& outside_moves,
                          const Deviations& deviations) const;

 private:
  Eigen::MatrixXd outside_rows_;
  std::optional<Eigen::Tridiagonalization<Eigen::MatrixXd>> tridiagonal_;  ///< Absent without outside rows.
  Eigen::MatrixXd handle_rows_;                                            ///< H Q
};

}  // namespace daumier::fitting
