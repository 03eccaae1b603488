#include "faces/controls/composition.h"

#include <algorithm>

namespace daumier::faces {

std::vector<PairComposition> MeasureComposition(const FaceControls& controls, const FaceTemplate& face_template,
                                                double value) {
  const std::vector<int>& region = RegionFor(face_template.annotation, "face", "a composition of controls");
  const double mm = MillimetresPerCm(face_template);
  const auto& entries = controls.entries();
  const auto displacement = [&](const std::vector<size_t>& chosen) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(controls.num_values());
    for (const size_t i : chosen) values.segment(entries[i].first_value, entries[i].num_values()).setConstant(value);
    return geometry::Points(
        (controls.Apply(face_template.neutral, values) - face_template.neutral)(region, Eigen::all));
  };
  std::vector<geometry::Points> alone;
  for (size_t i = 0; i < entries.size(); ++i) alone.push_back(displacement({i}));
  std::vector<PairComposition> pairs;
  for (size_t i = 0; i < entries.size(); ++i) {
    for (size_t j = i + 1; j < entries.size(); ++j) {
      const geometry::Points both = displacement({i, j});
      const Eigen::VectorXd difference = mm * (both - alone[i] - alone[j]).rowwise().norm();
      const double moved = mm * both.rowwise().norm().mean();
      pairs.push_back({entries[i].control.name, entries[j].control.name, difference.mean(), difference.maxCoeff(),
                       moved > 0 ? difference.mean() / moved : 0.0});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const PairComposition& a, const PairComposition& b) { return a.max_mm > b.max_mm; });
  return pairs;
}

}  // namespace daumier::faces
