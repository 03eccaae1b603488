#include "datasets/read/training_fit.h"

namespace daumier::datasets {

FittedBilinear FitOnTraining(const faces::FaceDatabase& database, const Split& split,
                             const faces::BilinearOptions& options) {
  const int num_expressions = database.num_expressions();
  std::vector<bool> is_training(database.num_faces(), false);
  for (const int face : split.train) is_training.at(face) = true;

  FittedBilinear fitted;
  std::vector<int> read;
  for (int face = 0; face < database.num_grid_faces(); ++face) {
    if (!is_training[face]) continue;
    read.push_back(face);
    const int identity = face / num_expressions;
    if (fitted.identities.empty() || fitted.identities.back() != identity) fitted.identities.push_back(identity);
  }
  const auto reader = [&](int identity, int expression) -> std::span<const float> {
    const int face = fitted.identities[identity] * num_expressions + expression;
    return is_training[face] ? database.vertices(face) : std::span<const float>();
  };
  fitted.model = faces::FitBilinear(static_cast<int>(fitted.identities.size()), num_expressions,
                                    3 * database.num_vertices(), reader, options);
  fitted.proof = SplitToJson(database, {.train = read, .validation = {}, .test = {}}).at("train");
  fitted.proof["num_identities"] = fitted.identities.size();
  return fitted;
}

}  // namespace daumier::datasets
