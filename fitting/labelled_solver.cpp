#include "fitting/labelled_solver.h"

#include "core/error.h"
#include "fitting/stroke_matches.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace daumier::fitting {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector2d, Eigen::Vector3d, Eigen::VectorXd;
using faces::FacePoint;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSampleStep = 0.05;  ///< Shares of the eye distance.
constexpr size_t kMostSamples = 300;
/// Of a step of the shift, which nothing determines where a lone contour is drawn, eye distances.
constexpr double kShiftDeviation = 10;
constexpr int kPoseUnknowns = 6;  ///< a, b, shift, yaw, pitch
/// Gaps, cm: deviations of what a closed mouth, a gap as drawn and lines that must not cross allow.
constexpr double kClosedDeviation = 0.05, kDrawnGapDeviation = 0.3, kCrossedDeviation = 0.03;
/// No mouth opens farther, cm, whatever a drawing of uncertain scale shows.
constexpr double kWidestDrawnGap = 6;
/// An open mouth and an open eye are at least this open in the middle, cm: tools that score drawings count 0.15 and 0.1.
constexpr double kOpenLips = 0.22, kOpenLids = 0.22;
/// A line of pairs counts as this many independent ones.
constexpr double kIndependentPairs = 10;

/// A weighted sum of vertices, whose weights' sum is 1, and where it is drawn.
struct Match {
  std::vector<std::pair<int, double>> vertices;
  Vector2d target;
  std::optional<Vector2d> normal;  ///< If only the distance along it counts.
  double deviation;                ///< Pixels, at residual scale 1.
  double weight;

  int num_coordinates() const { return normal ? 1 : 2; }
};

/// Unknowns in the order weights, a, b, shift, yaw, pitch.
struct FitState {
  VectorXd weights;
  double a = 1, b = 0;
  Vector2d shift = Vector2d::Zero();
  double yaw = 0, pitch = 0;
  double residual_scale = 1;

  render::Placement frame() const { return render::PlacementFrom(a, b, shift); }
  void Step(const VectorXd& step) {
    weights += step.head(weights.size());
    const VectorXd pose = step.tail<kPoseUnknowns>();
    a += pose[0], b += pose[1], shift += pose.segment<2>(2), yaw += pose[4], pitch += pose[5];
  }
};

/// The seen vertices in a state.
struct SeenState {
  Eigen::Matrix3Xd points;  ///< Not turned, about the pivot.
  Eigen::MatrixX2d on_sheet, on_canvas;
};

Eigen::Matrix<double, 2, 3> SheetFromWorld(const render::Camera& camera) {
  return camera.scale * camera.camera_from_world.topRows<2>();
}

SeenState LookAt(const SeenFace& seen, const FitState& state) {
  SeenState result;
  const VectorXd points = seen.mean + seen.modes.transpose() * state.weights;
  result.points = Eigen::Map<const Eigen::Matrix3Xd>(points.data(), 3, points.size() / 3);
  result.points.colwise() -= seen.pivot;
  const Vector2d moved = SheetFromWorld(seen.camera) * seen.pivot +
                         seen.camera.scale * seen.camera.translation.head<2>() + seen.camera.principal_point;
  const Eigen::Matrix<double, 2, 3> from_points = SheetFromWorld(seen.camera) * TurnOf(state.yaw, state.pitch);
  result.on_sheet = ((from_points * result.points).colwise() + moved).transpose();
  Eigen::Matrix2d linear;
  linear << state.a, -state.b, state.b, state.a;
  result.on_canvas = (result.on_sheet * linear.transpose()).rowwise() + state.shift.transpose();
  return result;
}

bool Says(const std::array<double, faces::kNumEyeStates>& eye, faces::EyeState state) {
  return eye[size_t(state)] > 0.5 * (eye[0] + eye[1]);
}

class MapProblem {
 public:
  MapProblem(const SeenFace& seen, const LabelledDrawing& drawing, const ModePrior& prior,
             const LabelledFitOptions& options)
      : seen_(seen), drawing_(drawing), prior_(prior), options_(options) {
    for (size_t side = 0; side < 2; ++side) closed_eyes_[side] = Says(drawing.eyes[side], faces::EyeState::kClosed);
    using enum faces::DrawnView;
    const auto likely = std::max_element(drawing.view.begin(), drawing.view.end());
    const auto view = faces::DrawnView(likely - drawing.view.begin());
    if (*likely > 0 && (view == kThreeQuarterLeft || view == kThreeQuarterRight)) {
      mean_yaw_ = (view == kThreeQuarterLeft ? 1 : -1) * options.three_quarter_yaw * kDegree;
      yaw_deviation_ = options.three_quarter_deviation * kDegree;
      far_contour_ = view == kThreeQuarterLeft ? 0 : 1;
    } else {
      yaw_deviation_ = options.turn_deviation * kDegree;
    }
  }

  std::optional<SolvedFace> Solve() {
    FitState state;
    state.weights = prior_.mean;
    state.yaw = mean_yaw_;
    SeenState look = LookAt(seen_, state);
    const std::optional<render::Placement> frame = FindFaceFrame(seen_.points, look.on_sheet, drawing_, options_.frame);
    if (!frame) return std::nullopt;
    const Eigen::Matrix2d linear = render::LinearPart(*frame);
    state.a = linear(0, 0), state.b = linear(1, 0), state.shift = frame->shift;
    eye_distance_ = frame->scale * EyeDistance(seen_.points, look.on_sheet);
    samples_ = SampleStrokes(drawing_, kSampleStep * eye_distance_, kMostSamples);

    look = LookAt(seen_, state);
    std::vector<Match> matches = PointMatches(look);
    state.residual_scale = FirstScale(matches, look);
    size_t num_points = matches.size();
    const int rounds = options_.point_rounds + options_.stroke_rounds;
    for (int round = 0; round < rounds; ++round) {
      if (round >= options_.point_rounds && !samples_.empty()) {
        const int left = rounds - 1 - round;
        AddStrokeMatches(look, options_.reach * (1 + double(left) / options_.stroke_rounds), matches);
      }
      GaussNewtonStep(matches, look, state);
      look = LookAt(seen_, state);
      num_matched_ = int(matches.size() - num_points);
      matches = PointMatches(look);
      num_points = matches.size();
    }
    return Result(state, look, matches);
  }

 private:
  SolvedFace Result(const FitState& state, const SeenState& look, const std::vector<Match>& points) const {
    SolvedFace result{state.weights, state.frame(), state.yaw, state.pitch, state.residual_scale, 0, num_matched_};
    double sum = 0, weights = 0;
    for (const Match& match : points) {
      sum += match.weight * Distance(match, look).squaredNorm();
      weights += match.weight;
    }
    result.rms = std::sqrt(sum / std::max(weights, 1e-9)) / eye_distance_;
    return result;
  }

  Vector2d Distance(const Match& match, const SeenState& look) const {
    Vector2d distance = -match.target;
    for (const auto& [vertex, weight] : match.vertices) distance += weight * look.on_canvas.row(vertex).transpose();
    return match.normal ? Vector2d(match.normal->dot(distance), 0) : distance;
  }

  /// Of a closed eye only the lower lid is where it is drawn.
  bool Counts(FacePoint point) const {
    using enum FacePoint;
    if (closed_eyes_[0] && (point == kEyeRightTop || point == kEyeRightCentre)) return false;
    return !(closed_eyes_[1] && (point == kEyeLeftTop || point == kEyeLeftCentre));
  }

  std::vector<Match> PointMatches(const SeenState& look) const {
    std::vector<Match> matches;
    const double deviation = options_.point_deviation * eye_distance_;
    for (int i = 0; i < faces::kNumFacePoints; ++i) {
      const auto point = FacePoint(i);
      const LabelledPoint& drawn = drawing_.points[size_t(i)];
      if (drawn.confidence <= 0 || !Counts(point)) continue;
      Match match{{}, drawn.position, std::nullopt, deviation, drawn.confidence};
      const std::optional<int> contour = faces::ContourOf(point);
      if (contour) {
        if (contour == far_contour_) continue;  // The border of a turned face is no fixed line.
        const auto place =
            faces::NearestOnPolyline(seen_.points.contours[size_t(*contour)], look.on_canvas, drawn.position);
        match.vertices = {{place.from, 1 - place.share}, {place.to, place.share}};
        const Vector2d along = (look.on_canvas.row(place.to) - look.on_canvas.row(place.from)).transpose();
        if (place.share > 0 && place.share < 1) match.normal = Vector2d(-along.y(), along.x()).normalized();
      } else {
        const std::vector<int>& vertices = seen_.points.of_points[size_t(i)];
        for (const int vertex : vertices) match.vertices.emplace_back(vertex, 1.0 / double(vertices.size()));
      }
      matches.push_back(std::move(match));
    }
    return matches;
  }

  void AddStrokeMatches(const SeenState& look, double reach, std::vector<Match>& matches) const {
    const StrokeMatchOptions match_options{.reach = reach * eye_distance_, .closed_eyes = closed_eyes_};
    const double weight = kSampleStep / options_.correlation_length;
    for (const StrokeMatch& match : MatchStrokes(samples_, seen_.curves, look.on_canvas, match_options)) {
      matches.push_back({{{match.place.from, 1 - match.place.share}, {match.place.to, match.place.share}},
                         match.target,
                         match.normal,
                         options_.stroke_deviation * eye_distance_,
                         weight * match.trust});
    }
  }

  /// 1 or more: the median distance over that of deviation 1.
  double FirstScale(const std::vector<Match>& matches, const SeenState& look) const {
    std::vector<double> squares;
    for (const Match& match : matches)
      squares.push_back((Distance(match, look) / match.deviation).squaredNorm() / match.num_coordinates());
    if (squares.empty()) return 1;
    const auto middle = squares.begin() + ptrdiff_t(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    constexpr double kMedianOfSquares = 0.69;  // Of half a chi-square of two degrees of freedom.
    return std::sqrt(std::max(1.0, *middle / kMedianOfSquares));
  }

  struct NormalEquations {
    MatrixXd matrix;  ///< Lower triangle.
    VectorXd right;
    double squares = 0, count = 0;  ///< Of the drawing's matches, at residual scale 1.
  };

  void AddRow(const Match& match, const Vector2d& direction, double factor, const SeenState& look,
              const FitState& state, Eigen::Ref<VectorXd> row) const {
    const Matrix3d turn = TurnOf(state.yaw, state.pitch);
    const Eigen::Matrix<double, 2, 3> sheet = SheetFromWorld(seen_.camera);
    Eigen::Matrix2d linear;
    linear << state.a, -state.b, state.b, state.a;
    const Eigen::RowVector2d by_sheet = factor * direction.transpose() * linear;
    const Eigen::RowVector3d by_point = by_sheet * sheet * turn;
    constexpr double kStep = 1e-5;
    const Matrix3d by_yaw =
                       (TurnOf(state.yaw + kStep, state.pitch) - TurnOf(state.yaw - kStep, state.pitch)) / (2 * kStep),
                   by_pitch =
                       (TurnOf(state.yaw, state.pitch + kStep) - TurnOf(state.yaw, state.pitch - kStep)) / (2 * kStep);
    const Eigen::Index num_modes = seen_.modes.rows();
    row.setZero();
    Vector2d on_sheet = Vector2d::Zero();
    Vector3d point = Vector3d::Zero();
    for (const auto& [vertex, weight] : match.vertices) {
      row.head(num_modes).noalias() += seen_.modes.middleCols<3>(3 * vertex) * (weight * by_point.transpose());
      on_sheet += weight * look.on_sheet.row(vertex).transpose();
      point += weight * look.points.col(vertex);
    }
    row[num_modes] = factor * direction.dot(on_sheet);
    row[num_modes + 1] = factor * (direction.y() * on_sheet.x() - direction.x() * on_sheet.y());
    row.segment<2>(num_modes + 2) = factor * direction;
    row[num_modes + 4] = by_sheet * sheet * by_yaw * point;
    row[num_modes + 5] = by_sheet * sheet * by_pitch * point;
  }

  NormalEquations EquationsOf(const std::vector<Match>& matches, const SeenState& look, const FitState& state) const {
    const Eigen::Index size = seen_.modes.rows() + kPoseUnknowns;
    size_t num_rows = 0;
    for (const Match& match : matches) num_rows += size_t(match.num_coordinates());
    MatrixXd rows(size, Eigen::Index(num_rows));
    VectorXd values = VectorXd::Zero(Eigen::Index(num_rows));
    NormalEquations result{MatrixXd::Zero(size, size), VectorXd::Zero(size)};
    Eigen::Index at = 0;
    for (const Match& match : matches) {
      const Vector2d residual = Distance(match, look) / match.deviation;
      const double nu = options_.degrees_of_freedom,
                   scaled = residual.squaredNorm() / std::pow(state.residual_scale, 2);
      const double weight = match.weight * (nu + match.num_coordinates()) / (nu + scaled);
      const double root = std::sqrt(weight);
      result.squares += weight * residual.squaredNorm();
      result.count += match.weight * match.num_coordinates();
      for (int k = 0; k < match.num_coordinates(); ++k, ++at) {
        const Vector2d direction = match.normal ? *match.normal : Vector2d(Vector2d::Unit(k));
        AddRow(match, direction, root / match.deviation, look, state, rows.col(at));
        values[at] = root * residual[k];
      }
    }
    result.matrix.selfadjointView<Eigen::Lower>().rankUpdate(rows);
    result.right.noalias() = -rows * values;
    return result;
  }

  /// The row of y of the upper line minus that of the lower one.
  VectorXd GapRow(const GapPair& pair) const {
    return seen_.modes.col(3 * pair.upper + 1) - (1 - pair.lower.share) * seen_.modes.col(3 * pair.lower.from + 1) -
           pair.lower.share * seen_.modes.col(3 * pair.lower.to + 1);
  }

  /// Residuals gap - goal of mouth and eyes, of the modes alone.
  void AddGaps(const SeenState& look, const FitState& state, NormalEquations& equations) const {
    const Eigen::Index num_modes = seen_.modes.rows();
    const auto add = [&](const GapPair& pair, double residual, double deviation, double weight) {
      const VectorXd row = GapRow(pair) * (std::sqrt(weight) / deviation);
      equations.matrix.topLeftCorner(num_modes, num_modes).selfadjointView<Eigen::Lower>().rankUpdate(row);
      equations.right.head(num_modes) -= row * (std::sqrt(weight) / deviation * residual);
    };
    for (const OpeningPairs& opening : seen_.openings) {
      const bool is_mouth = opening.opening == Opening::kMouth;
      const GapGoal goal = GoalOf(opening.opening, drawing_);
      const double line_weight = kIndependentPairs / double(opening.pairs.size());
      for (const GapPair& pair : opening.pairs) {
        const double gap = GapOf(pair, look), least = goal.closed ? 0 : LeastGap(goal, pair.share);
        if (is_mouth && goal.closed) {
          add(pair, gap, kClosedDeviation, line_weight);
        } else if (gap < least) {
          add(pair, gap - least, kCrossedDeviation, line_weight);
        }
      }
      if (is_mouth && goal.least_middle_cm > 0 && !goal.closed) AddDrawnGap(opening, look, state, add);
    }
  }

  static double GapOf(const GapPair& pair, const SeenState& look) {
    return look.points(1, pair.upper) - (1 - pair.lower.share) * look.points(1, pair.lower.from) -
           pair.lower.share * look.points(1, pair.lower.to);
  }

  /// Lips that are drawn apart stay apart.
  template <class Add>
  void AddDrawnGap(const OpeningPairs& mouth, const SeenState& look, const FitState& state, const Add& add) const {
    const LabelledPoint &top = drawing_.point(FacePoint::kInnerTop), &bottom = drawing_.point(FacePoint::kInnerBottom);
    if (top.confidence <= 0 || bottom.confidence <= 0) return;
    const render::Placement frame = state.frame();
    const double drawn = std::min(
        (render::ToSheet(frame, bottom.position) - render::ToSheet(frame, top.position)).y() / seen_.camera.scale,
        kWidestDrawnGap);
    const auto middle = std::min_element(mouth.pairs.begin(), mouth.pairs.end(), [](const auto& a, const auto& b) {
      return std::abs(a.share - 0.5) < std::abs(b.share - 0.5);
    });
    const double gap = GapOf(*middle, look);
    if (gap < drawn) add(*middle, gap - drawn, kDrawnGapDeviation, std::min(top.confidence, bottom.confidence));
  }

  void GaussNewtonStep(const std::vector<Match>& matches, const SeenState& look, FitState& state) const {
    const Eigen::Index num_modes = seen_.modes.rows();
    NormalEquations equations = EquationsOf(matches, look, state);
    const double precision = std::pow(state.residual_scale, -2);
    equations.matrix *= precision;
    equations.right *= precision;
    const MatrixXd of_drawing = equations.matrix;
    AddGaps(look, state, equations);
    VectorXd priors(num_modes + kPoseUnknowns), offsets(num_modes + kPoseUnknowns);
    const double b_deviation = options_.frame.turn_deviation * kDegree;
    priors << prior_.deviation.array().square().inverse().matrix(), std::pow(options_.frame.scale_deviation, -2),
        std::pow(b_deviation, -2), Vector2d::Constant(std::pow(kShiftDeviation * eye_distance_, -2)),
        std::pow(yaw_deviation_, -2), std::pow(options_.turn_deviation * kDegree, -2);
    offsets << prior_.mean - state.weights, 1 - state.a, -state.b, 0, 0, mean_yaw_ - state.yaw, -state.pitch;
    equations.matrix.diagonal() += priors;
    equations.right += priors.cwiseProduct(offsets);
    const Eigen::LLT<MatrixXd> factor(equations.matrix);
    DAUMIER_CHECK(factor.info() == Eigen::Success, "a drawing of {} points gives no face", matches.size());
    state.Step(factor.solve(equations.right));

    // MacKay's effective number of parameters: tr(H^-1 H_drawing).
    MatrixXd inverse = MatrixXd::Identity(priors.size(), priors.size());
    factor.solveInPlace(inverse);
    const double determined = inverse.cwiseProduct(MatrixXd(of_drawing.selfadjointView<Eigen::Lower>())).sum();
    const double n0 = options_.scale_strength;
    const double left = std::max(equations.count - determined, 0.0);
    state.residual_scale = std::sqrt((n0 + equations.squares) / std::max(n0 + left, 1.0));
  }

  const SeenFace& seen_;
  const LabelledDrawing& drawing_;
  const ModePrior& prior_;
  const LabelledFitOptions& options_;
  std::array<bool, 2> closed_eyes_{};
  double mean_yaw_ = 0, yaw_deviation_ = 1;
  std::optional<int> far_contour_;
  double eye_distance_ = 1;  ///< On the canvas, of the first frame, pixels.
  std::vector<StrokeSample> samples_;
  int num_matched_ = 0;
};

}  // namespace

GapGoal GoalOf(Opening opening, const LabelledDrawing& drawing) {
  if (opening == Opening::kMouth) {
    const double sum = drawing.mouth[0] + drawing.mouth[1] + drawing.mouth[2];
    if (sum <= 0) return {};
    const bool closed = drawing.mouth[size_t(faces::MouthState::kClosed)] > 0.5 * sum;
    return {.closed = closed, .least_middle_cm = kOpenLips};
  }
  const auto& eye = drawing.eyes[opening == Opening::kRightEye ? 0 : 1];
  if (eye[0] + eye[1] <= 0) return {};
  return {.closed = eye[size_t(faces::EyeState::kClosed)] > eye[size_t(faces::EyeState::kOpen)],
          .least_middle_cm = kOpenLids};
}

Matrix3d TurnOf(double yaw, double pitch) {
  Matrix3d about_y, about_x;
  about_y << std::cos(yaw), 0, -std::sin(yaw), 0, 1, 0, std::sin(yaw), 0, std::cos(yaw);
  about_x << 1, 0, 0, 0, std::cos(pitch), -std::sin(pitch), 0, std::sin(pitch), std::cos(pitch);
  return about_x * about_y;
}

std::optional<SolvedFace> SolveFace(const SeenFace& seen, const LabelledDrawing& drawing, const ModePrior& prior,
                                    const LabelledFitOptions& options) {
  DAUMIER_CHECK(prior.mean.size() == seen.num_modes() && prior.deviation.size() == seen.num_modes(),
                "a prior of {} and {} numbers for {} modes", prior.mean.size(), prior.deviation.size(),
                seen.num_modes());
  return MapProblem(seen, drawing, prior, options).Solve();
}

}  // namespace daumier::fitting
