#include "datasets/read/training_fit.h"

#include "core/error.h"

#include <functional>

namespace daumier::datasets {
namespace {

/// `coordinates` gives those of a training face; it is called from several threads at once.
FittedBilinear Fit(const faces::FaceDatabase& database, const Split& split, const faces::BilinearOptions& options,
                   int num_coordinates, const std::function<std::span<const float>(int face)>& coordinates) {
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
    return is_training[face] ? coordinates(face) : std::span<const float>();
  };
  fitted.model =
      faces::FitBilinear(static_cast<int>(fitted.identities.size()), num_expressions, num_coordinates, reader, options);
  fitted.proof = SplitToJson(database, {.train = read, .validation = {}, .test = {}}).at("train");
  fitted.proof["num_identities"] = fitted.identities.size();
  return fitted;
}

}  // namespace

FittedBilinear FitOnTraining(const faces::FaceDatabase& database, const Split& split,
                             const faces::BilinearOptions& options) {
  return Fit(database, split, options, 3 * database.num_vertices(), [&](int face) { return database.vertices(face); });
}

FittedBilinear FitCurvesOnTraining(const faces::FaceDatabase& database, const SketchDatabase& sketches,
                                   const Split& split, const faces::BilinearOptions& options) {
  DAUMIER_CHECK(sketches.num_faces() == database.num_faces(),
                "there are {} sketches for {} faces: they belong to another database", sketches.num_faces(),
                database.num_faces());
  std::vector<std::vector<float>> points(database.num_faces());
  for (const int face : split.train) points.at(face) = PointsOf(sketches.strokes(face), sketches.feature_curves());
  DAUMIER_CHECK(!split.train.empty(), "no face to fit the curves on");
  return Fit(database, split, options, static_cast<int>(points[split.train.front()].size()),
             [&](int face) { return std::span<const float>(points[face]); });
}

}  // namespace daumier::datasets
