#include "eval/drawing_score.h"

#include "core/error.h"
#include "render/read_drawing.h"

namespace daumier::eval {
namespace {

using Eigen::MatrixX2d;
using Eigen::Vector2d;

constexpr double kMmPerCm = 10;  ///< Gaps are measured in the mesh's own centimetres.
constexpr int kRounds = 30;

}  // namespace

const std::array<std::string_view, kNumDrawnParts> kDrawnPartNames = {"eyes", "brows", "nose", "mouth", "contour"};

int DrawnPartOf(faces::FacePoint point) {
  const std::string_view name = faces::kFacePointNames[size_t(point)];
  constexpr std::pair<std::string_view, int> kBegins[] = {{"eye", 0},   {"brow", 1}, {"nose", 2},
                                                          {"mouth", 3}, {"lip", 3},  {"inner", 3}};
  for (const auto& [begin, part] : kBegins)
    if (name.starts_with(begin)) return part;
  return 4;
}

std::optional<double> MeanOf(const PointErrors& errors, std::optional<int> part) {
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < errors.size(); ++i) {
    if (!errors[i] || (part && DrawnPartOf(static_cast<faces::FacePoint>(i)) != *part)) continue;
    sum += *errors[i];
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

PlaneSimilarity AlignInPlane(const MatrixX2d& points, const MatrixX2d& targets) {
  DAUMIER_CHECK(points.rows() == targets.rows() && points.rows() > 0, "{} points for {} targets", points.rows(),
                targets.rows());
  const Eigen::RowVector2d centre = points.colwise().mean(), target_centre = targets.colwise().mean();
  const MatrixX2d p = points.rowwise() - centre, q = targets.rowwise() - target_centre;
  const double size = p.squaredNorm();
  DAUMIER_CHECK(size > 0, "the {} points to align lie in one point", points.rows());
  const double c = p.cwiseProduct(q).sum() / size, s = (p.col(0).dot(q.col(1)) - p.col(1).dot(q.col(0))) / size;
  PlaneSimilarity similarity;
  similarity.matrix << c, -s, s, c;
  similarity.shift = target_centre.transpose() - similarity.matrix * centre.transpose();
  return similarity;
}

DrawingScorer::DrawingScorer(const faces::FaceTemplate& face_template, const render::Camera& camera)
    : points_(faces::FindFacePoints(face_template)),
      landmarks_(face_template.annotation.landmarks),
      neutral_(face_template.neutral),
      camera_(camera) {}

MatrixX2d DrawingScorer::OnCanvas(const geometry::Points& vertices) const {
  DAUMIER_CHECK(vertices.rows() >= neutral_.rows(), "a face has {} vertices, the template {}", vertices.rows(),
                neutral_.rows());
  return render::Project(camera_, vertices.topRows(neutral_.rows())).leftCols<2>();
}

MatrixX2d DrawingScorer::OnPicture(const DrawnPrediction& prediction) const {
  MatrixX2d projected = OnCanvas(prediction.vertices);
  for (Eigen::Index i = 0; i < projected.rows(); ++i)
    projected.row(i) = render::ToSheet(prediction.frame, projected.row(i).transpose()).transpose();
  if (prediction.picture_from_sheet)
    projected =
        (projected.rowwise().homogeneous() * prediction.picture_from_sheet->transpose()).rowwise().hnormalized().eval();
  return projected;
}

PointErrors DrawingScorer::Errors(const MatrixX2d& projected, const LabelledDrawing& drawing) const {
  PointErrors errors;
  for (size_t i = 0; i < errors.size(); ++i) {
    const std::optional<Vector2d>& label = drawing.points[i];
    if (!label) continue;
    const Vector2d point = faces::ProjectedFacePoint(points_, static_cast<faces::FacePoint>(i), projected, *label);
    errors[i] = (point - *label).norm() / drawing.interocular;
  }
  return errors;
}

MatrixX2d DrawingScorer::PlacedBest(MatrixX2d projected, const LabelledDrawing& drawing) const {
  for (int round = 0; round < kRounds; ++round) {
    MatrixX2d points(faces::kNumFacePoints, 2), labels(faces::kNumFacePoints, 2);
    Eigen::Index count = 0;
    for (size_t i = 0; i < drawing.points.size(); ++i) {
      const auto point = static_cast<faces::FacePoint>(i);
      if (!drawing.points[i] || (round == 0 && faces::ContourOf(point))) continue;
      points.row(count) = faces::ProjectedFacePoint(points_, point, projected, *drawing.points[i]);
      labels.row(count++) = *drawing.points[i];
    }
    const PlaneSimilarity similarity = AlignInPlane(points.topRows(count), labels.topRows(count));
    projected = ((projected * similarity.matrix.transpose()).rowwise() + similarity.shift.transpose()).eval();
  }
  return projected;
}

MeshStates DrawingScorer::StatesOf(const geometry::Points& vertices) const {
  const auto landmark = [&](size_t i) { return vertices.row(landmarks_[i]); };
  MeshStates states;
  states.lip_gap_mm = kMmPerCm * (landmark(62).y() - landmark(66).y());
  constexpr std::pair<size_t, size_t> kLids[] = {{37, 41}, {38, 40}, {43, 47}, {44, 46}};
  for (const auto& [upper, lower] : kLids)
    states.lid_gap_mm += kMmPerCm * (landmark(upper) - landmark(lower)).norm() / std::size(kLids);
  return states;
}

render::Placement FrameOfExtents(const LabelledDrawing& drawing) {
  DAUMIER_CHECK(
      std::filesystem::exists(drawing.file),
      "{}: this drawing has no prediction, and the file, by whose extents the mean face is placed, is missing. "
      "Put it next to the labels, or predict the drawing",
      drawing.file.string());
  const std::vector<render::Drawing> drawings = render::ReadDrawings(drawing.file);
  DAUMIER_CHECK(drawing.line >= 1 && size_t(drawing.line) <= drawings.size(),
                "{} has {} drawings, but the labels of {} name drawing {}", drawing.file.string(), drawings.size(),
                drawing.name, drawing.line);
  return render::FrameDrawing(drawings[size_t(drawing.line) - 1]).placement;
}

std::vector<DrawingScore> ScoreDrawings(const DrawingScorer& scorer, std::span<const LabelledDrawing> drawings,
                                        const std::map<std::string, DrawnPrediction>& predictions,
                                        const FrameOfDrawing& frame_of) {
  std::vector<DrawingScore> scores;
  std::vector<const LabelledDrawing*> scored;
  std::vector<MatrixX2d> on_canvas;
  const MatrixX2d mean_face = scorer.OnCanvas(scorer.neutral());
  for (const LabelledDrawing& drawing : drawings) {
    if (!drawing.is_scored()) continue;
    const auto found = predictions.find(drawing.name);
    DrawingScore score{.name = drawing.name, .group = drawing.group, .is_predicted = found != predictions.end()};
    const DrawnPrediction prediction =
        score.is_predicted ? found->second : DrawnPrediction{scorer.neutral(), frame_of(drawing)};
    score.errors = scorer.Errors(scorer.OnPicture(prediction), drawing);
    score.mean_face = scorer.Errors(scorer.PlacedBest(mean_face, drawing), drawing);
    score.states = scorer.StatesOf(prediction.vertices);
    if (drawing.mouth)
      score.mouth_is_right = score.states.mouth_is_open() == (*drawing.mouth != faces::MouthState::kClosed);
    if (drawing.eyes)
      score.eyes_are_right = score.states.eyes_are_closed() == (*drawing.eyes == faces::EyeState::kClosed);
    scores.push_back(std::move(score));
    scored.push_back(&drawing);
    on_canvas.push_back(scorer.OnCanvas(prediction.vertices));
  }
  for (size_t i = 0; i < scores.size(); ++i) {
    const auto distance = [&](size_t face) {
      return scorer.Errors(scorer.PlacedBest(on_canvas[face], *scored[i]), *scored[i]);
    };
    scores[i].aligned = distance(i);
    for (size_t other = 0; other < scores.size(); ++other) {
      if (other == i || scores[other].group != scores[i].group) continue;
      const bool is_nearer = scores[i].is_predicted && *MeanOf(scores[i].aligned) < *MeanOf(distance(other));
      scores[i].is_recognised = scores[i].is_recognised.value_or(true) && is_nearer;
    }
  }
  return scores;
}

}  // namespace daumier::eval
