#include "benchmark/baselines.h"

#include "benchmark/regression.h"
#include "benchmark/score.h"
#include "benchmark/shape_model.h"
#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/staged_directory.h"
#include "eval/drawing_score.h"
#include "eval/mesh_score.h"
#include "eval/nearest_neighbour.h"
#include "faces/marked_points.h"
#include "geometry/ply.h"
#include "render/draw.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace daumier::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr int kCells = 40, kPaper = 250;
constexpr const char* kPredictionsKind = "predictions";

/// The part of a drawing with ink, in a square; the whole if there is none.
render::Image InkSquare(const render::Image& picture) {
  int top = picture.height, left = picture.width, bottom = -1, right = -1;
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      if (picture.at(row, column) >= kPaper) continue;
      top = std::min(top, row), bottom = std::max(bottom, row);
      left = std::min(left, column), right = std::max(right, column);
    }
  }
  if (bottom < 0) return picture;
  const int side = std::max(bottom - top, right - left) + 1;
  render::Image square(side, side, 1, 255);
  const int y = (top + bottom + 1 - side) / 2, x = (left + right + 1 - side) / 2;
  for (int row = std::max(0, -y); row < std::min(side, picture.height - y); ++row)
    for (int column = std::max(0, -x); column < std::min(side, picture.width - x); ++column)
      square.at(row, column) = picture.at(row + y, column + x);
  return square;
}

std::vector<float> CellsOfPicture(const render::Image& picture) {
  const render::Image cells = render::Resize(picture, kCells, kCells);
  std::vector<float> features;
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      float sum = 0;
      for (int c = 0; c < cells.channels; ++c) sum += float(cells.at(row, column, c)) / float(cells.channels);
      features.push_back(1 - sum / 255);
    }
  }
  return features;
}

Eigen::MatrixX2d AsPlanePoints(const eval::LandmarkRow& row) {
  return Eigen::Map<const Eigen::Matrix<double, 68, 2, Eigen::RowMajor>>(row.data());
}

std::vector<float> LandmarkFeatures(const eval::LandmarkRow& row, const faces::FaceTemplate& face_template) {
  Eigen::MatrixX2d reference(68, 2);
  for (int i = 0; i < 68; ++i) {
    const auto vertex = face_template.neutral.row(face_template.annotation.landmarks[size_t(i)]);
    reference.row(i) << vertex.x(), -vertex.y();
  }
  const Eigen::MatrixX2d points = AsPlanePoints(row);
  const eval::PlaneSimilarity similarity = eval::AlignInPlane(points, reference);
  const Eigen::Matrix<double, 68, 2, Eigen::RowMajor> aligned =
      (points * similarity.matrix.transpose()).rowwise() + similarity.shift.transpose();
  return {aligned.data(), aligned.data() + aligned.size()};
}

/// The truth of each item, a row each: 3V coordinates, or 136.
eval::FaceRows TargetsOf(const Kit& kit, KitTask task, KitSplit split) {
  const std::vector<KitItem>& items = kit.items(task, split);
  const Eigen::Index size = task == KitTask::kLandmarks ? 136 : 3 * kit.face_template().num_vertices();
  return eval::RowsOnAllCores(items.size(), size, [&](int i) -> Eigen::RowVectorXf {
    const KitItem& item = items[size_t(i)];
    if (task == KitTask::kLandmarks) {
      const eval::LandmarkRow row = kit.TrueLandmarks(split, item);
      return Eigen::Map<const Eigen::RowVectorXd>(row.data(), 136).cast<float>();
    }
    const geometry::Points face = kit.TrueFace(task, split, item);
    return Eigen::Map<const Eigen::RowVectorXd>(face.data(), face.size()).cast<float>();
  });
}

geometry::Points AsFace(const eval::FaceRows& rows, Eigen::Index row) {
  const Eigen::RowVectorXd numbers = rows.row(row).cast<double>();
  return Eigen::Map<const geometry::Points>(numbers.data(), numbers.size() / 3, 3);
}

eval::LandmarkRow AsLandmarks(const eval::FaceRows& rows, Eigen::Index row) {
  eval::LandmarkRow landmarks;
  for (size_t i = 0; i < landmarks.size(); ++i) landmarks[i] = rows(row, Eigen::Index(i));
  return landmarks;
}

/// Mean of the scores' own error: of faces the vertices' after similarity, of landmarks the NME.
double MeanError(const Kit& kit, KitTask task, const eval::FaceRows& predicted, const eval::FaceRows& truth) {
  double sum = 0;
  ForEachInOrder(
      int(predicted.rows()),
      [&](int i) {
        if (task == KitTask::kLandmarks)
          return eval::NormalisedMeanError(AsLandmarks(predicted, i), AsLandmarks(truth, i));
        return eval::ScoreMesh("", AsFace(predicted, i), AsFace(truth, i), kit.face_template()).aligned;
      },
      [&](double error) { sum += error / double(predicted.rows()); });
  return sum;
}

/// Predictions of a split, and what was chosen.
struct BaselineResult {
  eval::FaceRows rows;
  Json chosen = Json::object();
};

BaselineResult MeanOfTraining(const Kit& kit, KitTask task, Eigen::Index num_items) {
  Eigen::RowVectorXf mean;
  if (task == KitTask::kLandmarks) {
    const eval::LandmarkRow row = MeanTrainingLandmarks(kit);
    mean = Eigen::Map<const Eigen::RowVectorXd>(row.data(), 136).cast<float>();
  } else {
    const geometry::Points face = MeanTrainingFace(kit, task);
    mean = Eigen::Map<const Eigen::RowVectorXd>(face.data(), face.size()).cast<float>();
  }
  return {mean.replicate(num_items, 1), Json::object()};
}

BaselineResult NearestOfTraining(const Kit& kit, KitTask task, KitSplit split) {
  const eval::NearestNeighbour nearest(FeaturesOf(kit, task, KitSplit::kTrain));
  const eval::FaceRows truth = TargetsOf(kit, task, KitSplit::kTrain);
  return {truth(nearest.Nearest(FeaturesOf(kit, task, split)), Eigen::all), Json::object()};
}

BaselineResult RegressionOfTraining(const Kit& kit, KitTask task, KitSplit split) {
  const DualRegression regression(FeaturesOf(kit, task, KitSplit::kTrain), TargetsOf(kit, task, KitSplit::kTrain));
  const eval::FaceRows features = FeaturesOf(kit, task, KitSplit::kValidation),
                       truth = TargetsOf(kit, task, KitSplit::kValidation);
  double least = std::numeric_limits<double>::infinity(), best = 1;
  for (const double lambda : RegressionLambdas()) {
    const double error = MeanError(kit, task, regression.Predict(features, lambda), truth);
    if (error < least) least = error, best = lambda;
  }
  return {regression.Predict(FeaturesOf(kit, task, split), best), {{"lambda", best}, {"validation_error", least}}};
}

eval::FaceRows FitAll(const Kit& kit, KitSplit split, const ShapeModel& model, const fitting::ContourPaths& contour,
                      double deviation) {
  const std::vector<KitItem>& items = kit.items(KitTask::kCaricatures, split);
  return eval::RowsOnAllCores(items.size(), 3 * kit.face_template().num_vertices(), [&](int i) -> Eigen::RowVectorXf {
    const eval::LandmarkRow row = ReadLandmarkRow(kit.InputFile(KitTask::kCaricatures, split, items[size_t(i)]));
    const fitting::PicturePoints points = AsPlanePoints(row);
    fitting::CodeLandmarkOptions options;
    options.deviation = deviation;
    const fitting::CodeLandmarkFit fit =
        fitting::FitCodeToLandmarks(model, contour, fitting::PicturedLandmarks(kit.face_template(), points), options);
    const geometry::Points face = model.Vertices(fit.code);
    return Eigen::Map<const Eigen::RowVectorXd>(face.data(), face.size()).cast<float>();
  });
}

eval::FaceRows FitAllPlaces(const Kit& kit, KitSplit split, const ShapeModel& model, double deviation_cm) {
  const std::vector<KitItem>& items = kit.items(KitTask::kCaricatures, split);
  const auto& landmarks = kit.face_template().annotation.landmarks;
  const std::vector<int> vertices(landmarks.begin(), landmarks.end());
  return eval::RowsOnAllCores(items.size(), 3 * kit.face_template().num_vertices(), [&](int i) -> Eigen::RowVectorXf {
    const fs::path file = kit.InputFile(KitTask::kCaricatures, split, items[size_t(i)]).replace_extension(".xyz");
    const faces::MarkedPoints marked = faces::ReadMarkedPoints(file);
    geometry::Points places(std::ssize(marked.points), 3);
    for (Eigen::Index row = 0; row < places.rows(); ++row)
      places.row(row) = marked.points[size_t(row)].value().transpose();
    const geometry::Points face = model.Vertices(FitShapeToPlaces(model, vertices, places, deviation_cm));
    return Eigen::Map<const Eigen::RowVectorXd>(face.data(), face.size()).cast<float>();
  });
}

/// The shape model of training faces whose size and deviation of landmarks have the least error on validation. fit(model, split,
/// deviation): its faces of a split.
template <class Fit>
BaselineResult BestShapeModel(const Kit& kit, KitSplit split, const std::vector<int>& sizes,
                              const std::vector<double>& deviations, const Fit& fit) {
  const eval::FaceRows training = TargetsOf(kit, KitTask::kCaricatures, KitSplit::kTrain),
                       truth = TargetsOf(kit, KitTask::kCaricatures, KitSplit::kValidation);
  double least = std::numeric_limits<double>::infinity(), best_deviation = 0;
  int best_size = 0;
  for (const int size : sizes) {
    const ShapeModel model(kit.face_template(), training, size);
    for (const double deviation : deviations) {
      const double error = MeanError(kit, KitTask::kCaricatures, fit(model, KitSplit::kValidation, deviation), truth);
      if (error < least) least = error, best_size = size, best_deviation = deviation;
    }
  }
  const ShapeModel model(kit.face_template(), training, best_size);
  return {fit(model, split, best_deviation),
          {{"components", best_size}, {"deviation", best_deviation}, {"validation_error", least}}};
}

/// Fitted to landmarks in the picture; deviations are shares of the distance of the outer eye corners.
BaselineResult ShapeModelFits(const Kit& kit, KitSplit split) {
  const fitting::ContourPaths contour(kit.face_template());
  return BestShapeModel(kit, split, {10, 20, 40, 80}, {0.005, 0.015, 0.05, 0.15},
                        [&](const ShapeModel& model, KitSplit of, double deviation) {
                          return FitAll(kit, of, model, contour, deviation);
                        });
}

/// Fitted to landmarks in space; deviations are cm.
BaselineResult ShapeModelFitsInSpace(const Kit& kit, KitSplit split) {
  return BestShapeModel(
      kit, split, {10, 20, 40, 80, 160}, {0.01, 0.03, 0.1, 0.3},
      [&](const ShapeModel& model, KitSplit of, double deviation) { return FitAllPlaces(kit, of, model, deviation); });
}

BaselineResult MeanPlacedOnTruth(const Kit& kit, KitSplit split) {
  const eval::FaceRows truth = TargetsOf(kit, KitTask::kLandmarks, split);
  eval::FaceRows rows = truth;
  const Eigen::MatrixX2d mean = AsPlanePoints(MeanTrainingLandmarks(kit));
  for (Eigen::Index row = 0; row < truth.rows(); ++row) {
    const eval::PlaneSimilarity similarity = eval::AlignInPlane(mean, AsPlanePoints(AsLandmarks(truth, row)));
    const Eigen::Matrix<double, 68, 2, Eigen::RowMajor> placed =
        (mean * similarity.matrix.transpose()).rowwise() + similarity.shift.transpose();
    rows.row(row) = Eigen::Map<const Eigen::RowVectorXd>(placed.data(), placed.size()).cast<float>();
  }
  return {rows, {{"reads", "the truth"}}};
}

BaselineResult ResultOf(const Kit& kit, KitTask task, KitSplit split, Baseline baseline) {
  switch (baseline) {
    case Baseline::kNearest:
      return NearestOfTraining(kit, task, split);
    case Baseline::kRegression:
      return RegressionOfTraining(kit, task, split);
    case Baseline::kShapeModel:
      return ShapeModelFits(kit, split);
    case Baseline::kShapeModel3d:
      return ShapeModelFitsInSpace(kit, split);
    case Baseline::kMeanPlaced:
      return MeanPlacedOnTruth(kit, split);
    case Baseline::kMean:
      break;
  }
  return MeanOfTraining(kit, task, std::ssize(kit.items(task, split)));
}

}  // namespace

Baseline BaselineNamed(const std::string& name) {
  const auto found = std::ranges::find(kBaselineNames, name);
  if (found == kBaselineNames.end())
    throw UsageError(fmt::format("there is no baseline '{}' (expected {})", name, fmt::join(kBaselineNames, ", ")));
  return static_cast<Baseline>(found - kBaselineNames.begin());
}

eval::FaceRows FeaturesOf(const Kit& kit, KitTask task, KitSplit split) {
  const std::vector<KitItem>& items = kit.items(task, split);
  const Eigen::Index size = task == KitTask::kCaricatures ? 136 : kCells * kCells;
  return eval::RowsOnAllCores(items.size(), size, [&](int i) {
    const fs::path file = kit.InputFile(task, split, items[size_t(i)]);
    if (task == KitTask::kCaricatures) return LandmarkFeatures(ReadLandmarkRow(file), kit.face_template());
    const render::Image picture = render::ReadImage(file);
    return CellsOfPicture(task == KitTask::kDrawings ? InkSquare(picture) : picture);
  });
}

void WriteBaseline(const Kit& kit, KitTask task, KitSplit split, Baseline baseline, const fs::path& out,
                   const Task& progress) {
  const bool is_shape_model = baseline == Baseline::kShapeModel || baseline == Baseline::kShapeModel3d;
  if (is_shape_model && task != KitTask::kCaricatures)
    throw UsageError("a shape model is fitted to landmarks: --task caricatures");
  if (baseline == Baseline::kMeanPlaced && task != KitTask::kLandmarks)
    throw UsageError(
        "the baseline mean_placed is one of landmarks: faces are scored after a similarity, where it is mean");
  StagedDirectory staged(out, kPredictionsKind);
  const BaselineResult result = ResultOf(kit, task, split, baseline);
  const std::vector<KitItem>& items = kit.items(task, split);
  Manifest manifest;
  manifest.kind = kPredictionsKind;
  manifest.verb = "benchmark baseline";
  for (size_t i = 0; i < items.size(); ++i) {
    progress.ThrowIfCancelled("{}: stopped, nothing is written", out.string());
    const bool is_face = task != KitTask::kLandmarks;
    const std::string name = items[i].name + (is_face ? ".ply" : ".pts");
    if (is_face) {
      geometry::WritePly(staged.path() / name,
                         geometry::TriangleMesh{AsFace(result.rows, Eigen::Index(i)), kit.face_template().triangles});
    } else {
      WriteFileAtomically(staged.path() / name, PtsText(AsLandmarks(result.rows, Eigen::Index(i))));
    }
    manifest.checksums[name] = Sha256OfFile(staged.path() / name);
    progress.Report(int64_t(i) + 1, std::ssize(items), "predictions");
  }
  const std::string name(kBaselineNames[size_t(baseline)]);
  const std::string method = Json{{"name", name},
                                  {"command", "daumier benchmark baseline"},
                                  {"training_data", "split train"},
                                  {"chosen", result.chosen}}
                                 .dump(1) +
                             "\n";
  WriteFileAtomically(staged.path() / "method.json", method);
  manifest.checksums["method.json"] = Sha256(method);
  manifest.details = {{"benchmark", kit.name()}, {"baseline", name}};
  WriteManifest(staged.path(), manifest);
  staged.Commit();
}

}  // namespace daumier::benchmark
