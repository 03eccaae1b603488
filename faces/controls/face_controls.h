#pragma once
#include "faces/controls/face_control.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace daumier::faces {

/// A control that is a displacement of every vertex at value 1, V x 3 cm: a user's own, or a smooth warp.
struct GivenControl {
  std::string name;
  geometry::Points displacement;
  std::string group = "own";
  FaceControl::Sides sides = FaceControl::Sides::kMiddle;  ///< Not kPaired.
};

/// The controls of a template, ready to be applied. A vector of values has num_values() entries, named value_names(): a
/// paired control has two, NAME_left and NAME_right, any other one, NAME.
/// Promises: values of 0 return the face; each control moves its region the farther, the greater its value in [-3, 3];
/// a symmetric face stays symmetric if left and right values are equal and those of sideways controls 0; a face that is
/// moved or turned gives the moved face up to the axes of motions, which are the template's.
/// Thread-safe once made.
class FaceControls {
 public:
  /// AnatomicalControls, and behind them the given ones. Controls of regions that the annotation lacks (ears) are
  /// left out. @throws Error if a displacement has another number of vertices; UsageError if a name is taken.
  explicit FaceControls(const FaceTemplate& face_template, std::vector<GivenControl> given = {});

  int num_controls() const { return static_cast<int>(controls_.size()); }
  int num_values() const { return static_cast<int>(value_names_.size()); }
  const std::vector<std::string>& value_names() const { return value_names_; }
  /// num_values: the group of each value's control, as 0, 1, ... in the order of group_names().
  const std::vector<int>& value_groups() const { return value_groups_; }
  const std::vector<std::string>& group_names() const { return group_names_; }
  /// The rows of a control among the values: one, or left and right.
  struct Entry {
    FaceControl control;
    int first_value;
    int num_values() const { return control.sides == FaceControl::Sides::kPaired ? 2 : 1; }
  };
  const std::vector<Entry>& entries() const { return controls_; }
  /// The given controls, whose values are the last ones.
  const std::vector<GivenControl>& given() const { return given_; }
  int first_given_value() const { return num_values() - static_cast<int>(given_.size()); }

  /// The face (V x 3, cm) with the controls applied, one after the other in their order; each acts on what those before
  /// it made of the face, the two sides of a pair at once. @throws Error if a shape disagrees.
  geometry::Points Apply(const geometry::Points& face, const Eigen::VectorXd& values) const;

  /// 3V x num_values: the displacement of the neutral template by each value alone, a unit of it, to first order.
  const Eigen::MatrixXf& Jacobian() const { return jacobian_; }

 private:
  struct Side {
    std::vector<int> vertices;  ///< Those of a weight above 0.
    Eigen::VectorXd weights;
    Motion motion;
    Anchor pivot;
    int value;
  };
  struct Field {
    std::vector<Side> sides;
  };
  void AddSide(const Eigen::VectorXd& weights, const Motion& motion, const Anchor& pivot, int value, Field& field);

  FaceTemplate face_template_;
  std::vector<Entry> controls_;
  std::vector<std::string> value_names_, group_names_;
  std::vector<int> value_groups_;
  std::vector<Field> fields_;
  std::vector<GivenControl> given_;
  Eigen::MatrixXf jacobian_;
};

}  // namespace daumier::faces
