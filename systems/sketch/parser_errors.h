#pragma once
#include "core/json.h"
#include "faces/drawing_terms.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Errors of a parsed drawing.
namespace daumier::sketch {

/// Points of a face in any unit; absent ones are not drawn, hidden or not known.
using DrawnPoints = std::array<std::optional<std::array<double, 2>>, faces::kNumFacePoints>;

/// Named groups of points.
struct PointPart {
  std::string_view name;
  std::vector<faces::FacePoint> points;
};
/// "eyes", "brows", "nose", "mouth", "contour": together all points.
const std::vector<PointPart>& PointParts();

/// The distance of the outer corners of the eyes; without both of them that of the eyes' centres times 1.369, their
/// ratio on the neutral ICT face; absent if neither is there.
std::optional<double> EyeDistance(const DrawnPoints& points);

/// Mean distance of found points from true ones over the eye distance of the true ones: of all that the drawing shows,
/// and of each part (absent where it shows none). The centre of an eye counts where its corners are not shown.
struct PointErrors {
  double all = 0;
  std::array<std::optional<double>, 5> parts = {};  ///< By PointParts.
};
/// Absent if nothing is shown, or there is no eye distance.
std::optional<PointErrors> ErrorsOfPoints(const DrawnPoints& found, const DrawnPoints& truth);

/// Counts of a state's classes.
class ClassCounts {
 public:
  explicit ClassCounts(int num_classes) : num_classes_(num_classes), counts_(size_t(num_classes * num_classes)) {}

  void Add(int64_t truth, int64_t found) { ++counts_[size_t(truth * num_classes_ + found)]; }
  /// The mean recall of the classes that occur; 0 if none does.
  double balanced_accuracy() const;
  int64_t num() const;
  /// {balanced_accuracy, of_classes: {name: {recall, num}}}
  Json ToJson(std::span<const std::string_view> names) const;

 private:
  /// Absent if the class does not occur.
  std::optional<double> Recall(int truth) const;
  int64_t NumOf(int truth) const;

  int num_classes_;
  std::vector<int64_t> counts_;  ///< Row-major, a row a true class.
};

}  // namespace daumier::sketch
