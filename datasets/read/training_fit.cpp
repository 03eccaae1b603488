#include "datasets/read/training_fit.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/random.h"

#include <algorithm>
#include <functional>

namespace daumier::datasets {
namespace {

/// `coordinates` gives those of a training face; it is called from several threads at once.
FittedBilinear Fit(const faces::FaceDatabase& database, const Split& split, const faces::BilinearOptions& options,
                   int num_coordinates, const std::function<std::span<const float>(int face)>& coordinates,
                   const Task& task) {
  const int num_expressions = database.num_expressions();
  std::vector<bool> is_training(database.num_faces(), false);
  for (const int face : split.train) is_training.at(face) = true;

  FittedBilinear fitted;
  fitted.identities = TrainingIdentities(database, split);
  std::vector<int> read;
  for (const int face : split.train) {
    if (face < database.num_grid_faces()) read.push_back(face);
  }
  const auto reader = [&](int identity, int expression) -> std::span<const float> {
    const int face = fitted.identities[identity] * num_expressions + expression;
    return is_training[face] ? coordinates(face) : std::span<const float>();
  };
  fitted.model = faces::FitBilinear(static_cast<int>(fitted.identities.size()), num_expressions, num_coordinates,
                                    reader, options, task);
  fitted.proof = SplitToJson(database, {.train = read, .validation = {}, .test = {}}).at("train");
  fitted.proof["num_identities"] = fitted.identities.size();
  return fitted;
}

}  // namespace

std::vector<int> TrainingIdentities(const faces::FaceDatabase& database, const Split& split) {
  std::vector<int> identities;
  for (const int face : split.train) {
    const int identity = face / database.num_expressions();
    if (face < database.num_grid_faces() && (identities.empty() || identities.back() != identity))
      identities.push_back(identity);
  }
  return identities;
}

FittedBilinear FitOnTraining(const faces::FaceDatabase& database, const Split& split,
                             const faces::BilinearOptions& options, const Task& task) {
  return Fit(
      database, split, options, 3 * database.num_vertices(), [&](int face) { return database.vertices(face); }, task);
}

FittedBilinear FitCurvesOnTraining(const faces::FaceDatabase& database, const SketchDatabase& sketches,
                                   const Split& split, const faces::BilinearOptions& options, const Task& task) {
  DAUMIER_CHECK(sketches.num_faces() == database.num_faces(),
                "there are {} sketches for {} faces: they belong to another database", sketches.num_faces(),
                database.num_faces());
  std::vector<std::vector<float>> points(database.num_faces());
  for (const int face : split.train) {
    task.ThrowIfCancelled("stopped while the curves of sketches were read; nothing was written");
    points.at(face) = PointsOf(sketches.strokes(face, sketches.labelled_view(0)), sketches.feature_curves());
  }
  DAUMIER_CHECK(!split.train.empty(), "no face to fit the curves on");
  return Fit(
      database, split, options, static_cast<int>(points[split.train.front()].size()),
      [&](int face) { return std::span<const float>(points[face]); }, task);
}

namespace {

/// At most 600 training faces of the grid, ascending.
std::vector<int> FacesOfBasis(const faces::FaceDatabase& database, const Split& split, uint64_t seed) {
  constexpr int kMostFaces = 600;
  std::vector<int> grid;
  for (const int face : split.train) {
    if (face < database.num_grid_faces()) grid.push_back(face);
  }
  std::vector<int> chosen;
  for (const int index : Stream(seed, "faces of a basis").Permutation(static_cast<int>(grid.size()))) {
    if (chosen.size() < kMostFaces) chosen.push_back(grid[size_t(index)]);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// How far the coordinates of these faces are from those of their bilinear faces, root mean square.
Eigen::VectorXf DeviationFrom(const faces::BilinearModel& bilinear, const faces::FaceDatabase& database,
                              const std::vector<int>& identities, const std::vector<int>& chosen,
                              const faces::FaceBasis& basis, const Task& task) {
  const Eigen::MatrixXf products = basis.rows * bilinear.core.transpose();  // size x Ku Kv.
  Eigen::VectorXf squares = Eigen::VectorXf::Zero(basis.size());
  for (const int face : chosen) {
    task.ThrowIfCancelled("stopped while a basis of faces was fitted; nothing was written");
    const int identity = face / database.num_expressions(), expression = face % database.num_expressions();
    const auto row = std::lower_bound(identities.begin(), identities.end(), identity);
    const Eigen::VectorXf u = bilinear.identity_factors.row(row - identities.begin()),
                          v = bilinear.expression_factors.row(expression);
    const Eigen::VectorXf uv = (v * u.transpose()).reshaped();  // v fastest.
    const auto coordinates = database.vertices(face);
    const Eigen::Map<const Eigen::VectorXf> truth(coordinates.data(), Eigen::Index(coordinates.size()));
    squares += (basis.rows * truth - products * uv).cwiseAbs2();
  }
  return (squares / float(chosen.size())).cwiseSqrt();
}

}  // namespace

faces::FaceBasis FitBasisOnTraining(const faces::FaceDatabase& database, const Split& split,
                                    const faces::BilinearModel& bilinear, int size, uint64_t seed, const Task& task) {
  const std::vector<int> chosen = FacesOfBasis(database, split, seed);
  faces::FaceBasis basis = faces::FitFaceBasis(
      static_cast<int>(chosen.size()), 3 * database.num_vertices(),
      [&](int i) { return database.vertices(chosen[size_t(i)]); }, size, task);
  basis.deviation = DeviationFrom(bilinear, database, TrainingIdentities(database, split), chosen, basis, task);
  return basis;
}

faces::FaceBasis GaussianBasisOnTraining(const faces::FaceDatabase& database, const Split& split,
                                         const faces::BilinearModel& bilinear, const faces::FaceGaussian& gaussian,
                                         uint64_t seed, const Task& task) {
  faces::FaceBasis basis = faces::BasisOf(gaussian);
  basis.deviation = DeviationFrom(bilinear, database, TrainingIdentities(database, split),
                                  FacesOfBasis(database, split, seed), basis, task);
  return basis;
}

faces::FaceGaussian FitGaussianOnTraining(const faces::FaceDatabase& database, const Split& split,
                                          const faces::FaceGaussianOptions& options, const Task& task) {
  constexpr int kMostFaces = 1200;
  const std::vector<int> chosen = EvenlySpaced(split.train, kMostFaces);
  return faces::FitFaceGaussian(
      int(chosen.size()), 3 * database.num_vertices(),
      [&](int i) { return std::span<const float>(database.vertices(chosen[size_t(i)])); },
      database.face_template().annotation.mirror, options, task);
}

}  // namespace daumier::datasets
