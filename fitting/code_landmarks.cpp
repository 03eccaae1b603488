#include "fitting/code_landmarks.h"

#include "core/error.h"
#include "core/statistics.h"
#include "fitting/gauss_newton.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace daumier::fitting {
namespace {

using Eigen::Index;

constexpr int kFewestPoints = 6;
/// Steps of code and view together in a round.
constexpr int kStepsOfRound = 2;
constexpr double kLeastRoundFall = 1e-3;
/// A vertex' derivative serves codes that are nearer than this, as long as steps with it are good.
constexpr double kSameRows = 1;
/// Unknowns of a view: a rotation vector, the logarithm of the scale, the shift.
constexpr Index kViewNumbers = 6;

geometry::Points AsPoints(const Eigen::VectorXd& numbers) {
  return Eigen::Map<const geometry::Points>(numbers.data(), numbers.size() / 3, 3);
}

Eigen::Matrix3d RotationBy(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

/// A view moved by the six numbers; shifts count in units of `eye_px`.
ScaledView Moved(const ScaledView& view, const Eigen::VectorXd& move, double eye_px) {
  return {view.scale * std::exp(move[3]), RotationBy(move.head<3>()) * view.rotation,
          view.shift + eye_px * move.segment<2>(4)};
}

/// The rows of a derivative of positions as those of pixels.
Eigen::MatrixXd PixelRows(const ScaledView& view, const Eigen::MatrixXd& by_code) {
  Eigen::MatrixXd rows(by_code.rows() / 3 * 2, by_code.cols());
  Eigen::Matrix<double, 2, 3> map = view.scale * view.rotation.topRows<2>();
  map.row(1) *= -1;
  for (Index i = 0; i < by_code.rows() / 3; ++i)
    rows.middleRows<2>(2 * i).noalias() = map * by_code.middleRows<3>(3 * i);
  return rows;
}

Eigen::VectorXd AsNumbers(const PicturePoints& pixels) {
  return Eigen::Map<const Eigen::VectorXd>(pixels.data(), pixels.size());
}

/// The vertex of each point, on the silhouette where it slides.
std::vector<int> OnSilhouette(const CodeModel& model, const ContourPaths& contour,
                              const std::vector<PicturedPoint>& points, const Eigen::VectorXd& code,
                              const ScaledView& view) {
  std::vector<int> vertices, candidates;
  for (const PicturedPoint& point : points) {
    vertices.push_back(point.vertex);
    if (point.jaw_landmark < 0) continue;
    const std::vector<int>& path = contour.vertices(point.jaw_landmark);
    candidates.insert(candidates.end(), path.begin(), path.end());
  }
  if (candidates.empty()) return vertices;
  const PicturePoints pixels = view.Project(AsPoints(model.Positions(code, candidates)));
  const double roll = std::atan2(view.rotation(1, 0), view.rotation(0, 0));
  Index begin = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const int jaw = points[i].jaw_landmark;
    if (jaw < 0) continue;
    const std::vector<int>& path = contour.vertices(jaw);
    const Index count = std::ssize(path);
    vertices[i] = path[size_t(contour.Outermost(jaw, pixels.middleRows(begin, count), roll))];
    begin += count;
  }
  return vertices;
}

/// The fit of one set of points, round by round.
class LandmarkRounds {
 public:
  LandmarkRounds(const CodeModel& model, const ContourPaths& contour, const std::vector<PicturedPoint>& points,
                 const CodeLandmarkOptions& options)
      : model_(model), contour_(contour), points_(points), options_(options) {
    pixels_.resize(std::ssize(points), 2);
    for (size_t i = 0; i < points.size(); ++i) {
      pixels_.row(Index(i)) = points[i].pixel.transpose();
      fit_.vertices.push_back(points[i].vertex);
    }
    fit_.code = Eigen::VectorXd::Zero(model.num_numbers());
    fit_.weights = Eigen::VectorXd::Ones(std::ssize(points));
    const auto& landmarks = model.face_template().annotation.landmarks;
    const geometry::Points& neutral = model.face_template().neutral;
    eye_span_cm_ = (neutral.row(landmarks[36]) - neutral.row(landmarks[45])).norm();
  }

  CodeLandmarkFit Run() {
    fit_.view = FindScaledView(Positions(), pixels_, fit_.weights);
    double last = 0;
    for (fit_.rounds = 1; fit_.rounds <= options_.rounds; ++fit_.rounds) {
      fit_.vertices = OnSilhouette(model_, contour_, points_, fit_.code, fit_.view);
      fit_.view = FindScaledView(Positions(), pixels_, fit_.weights);
      UpdateWeights();
      const double energy = options_.adjusts_code ? AdjustAll() : Misses().cwiseAbs2().dot(fit_.weights);
      if (fit_.rounds > 1 && std::abs(last - energy) < kLeastRoundFall * last) break;
      last = energy;
    }
    fit_.rounds = std::min(fit_.rounds, options_.rounds);
    fit_.pixels = fit_.view.Project(Positions());
    fit_.distances_px = (fit_.pixels - pixels_).rowwise().norm();
    fit_.eye_distance_px = EyePixels();
    fit_.is_usual = fit_.code.norm() <= model_.usual_radius();
    return fit_;
  }

 private:
  geometry::Points Positions() const { return AsPoints(model_.Positions(fit_.code, fit_.vertices)); }
  double EyePixels() const { return eye_span_cm_ * fit_.view.scale; }
  Eigen::VectorXd Misses() const { return (fit_.view.Project(Positions()) - pixels_).rowwise().norm(); }

  void UpdateWeights() {
    const Eigen::VectorXd misses = Misses();
    const std::vector<double> all(misses.begin(), misses.end());
    const double spread = 3 * std::max(options_.deviation * EyePixels(), 1.48 * Median(all));
    fit_.weights = (1 + (misses / spread).array().square()).square().inverse();
  }

  /// Of the positions of fit_.vertices by the code. One of a near code serves as well, `reuses`: then only vertices that
  /// were not in use there cost time.
  Eigen::MatrixXd Derivative(const Eigen::VectorXd& code, bool reuses) {
    const bool serves = !rows_.empty() && (model_.is_linear() || (reuses && (code - rows_code_).norm() < kSameRows));
    if (!serves) {
      rows_.clear();
      rows_code_ = code;
    }
    std::vector<int> missing;
    for (const int vertex : fit_.vertices)
      if (!rows_.contains(vertex) && std::ranges::count(missing, vertex) == 0) missing.push_back(vertex);
    if (!missing.empty()) {
      const Eigen::MatrixXd made = model_.Derivative(code, missing);
      for (size_t i = 0; i < missing.size(); ++i) rows_[missing[i]] = made.middleRows<3>(3 * Index(i));
    }
    Eigen::MatrixXd result(3 * std::ssize(fit_.vertices), code.size());
    for (size_t i = 0; i < fit_.vertices.size(); ++i) result.middleRows<3>(3 * Index(i)) = rows_.at(fit_.vertices[i]);
    return result;
  }

  /// Returns E.
  double AdjustAll() {
    const Index num_numbers = fit_.code.size(), num_rows = 2 * pixels_.rows();
    const double eye_px = EyePixels();
    const Eigen::VectorXd root = fit_.weights.cwiseSqrt() / (options_.deviation * eye_px);
    Eigen::VectorXd row_weights(num_rows);
    for (Index i = 0; i < num_rows; ++i) row_weights[i] = root[i / 2];
    const ScaledView start = fit_.view;
    bool is_first = true;
    const auto pixels_at = [&](const Eigen::VectorXd& x) {
      return AsNumbers(Moved(start, x.tail(kViewNumbers), eye_px)
                           .Project(AsPoints(model_.Positions(x.head(num_numbers), fit_.vertices))));
    };
    Eigen::VectorXd prior_weights = Eigen::VectorXd::Ones(num_numbers + kViewNumbers);
    prior_weights.tail(kViewNumbers).setZero();
    const SquaredEnergy energy{
        .residuals = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
          return row_weights.cwiseProduct(pixels_at(x) - AsNumbers(pixels_));
        },
        .derivative = [&](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
          Eigen::MatrixXd j(num_rows, num_numbers + kViewNumbers);
          const ScaledView view = Moved(start, x.tail(kViewNumbers), eye_px);
          j.leftCols(num_numbers) =
              row_weights.asDiagonal() * PixelRows(view, Derivative(x.head(num_numbers), is_first));
          is_first = false;
          const geometry::Points positions = AsPoints(model_.Positions(x.head(num_numbers), fit_.vertices));
          constexpr double kDifference = 1e-5;
          for (Index n = 0; n < kViewNumbers; ++n) {
            Eigen::VectorXd ahead = x.tail(kViewNumbers), behind = ahead;
            ahead[n] += kDifference;
            behind[n] -= kDifference;
            j.col(num_numbers + n) =
                row_weights.cwiseProduct(AsNumbers(Moved(start, ahead, eye_px).Project(positions)) -
                                         AsNumbers(Moved(start, behind, eye_px).Project(positions))) /
                (2 * kDifference);
          }
          return j;
        },
        .prior_weights = prior_weights,
        .prior_mean = Eigen::VectorXd::Zero(num_numbers + kViewNumbers)};
    Eigen::VectorXd x = Eigen::VectorXd::Zero(num_numbers + kViewNumbers);
    x.head(num_numbers) = fit_.code;
    const Minimum minimum = Minimise(energy, x, kStepsOfRound);
    fit_.code = minimum.x.head(num_numbers);
    fit_.view = Moved(start, minimum.x.tail(kViewNumbers), eye_px);
    return minimum.energies.back();
  }

  const CodeModel& model_;
  const ContourPaths& contour_;
  const std::vector<PicturedPoint>& points_;
  const CodeLandmarkOptions& options_;
  PicturePoints pixels_;
  double eye_span_cm_ = 0;
  CodeLandmarkFit fit_;
  std::map<int, Eigen::Matrix<double, 3, Eigen::Dynamic>> rows_;  ///< Derivatives of vertices,
  Eigen::VectorXd rows_code_;                                     ///< and the code where they were computed.
};

}  // namespace

std::vector<PicturedPoint> PicturedLandmarks(const faces::FaceTemplate& face_template, const PicturePoints& landmarks) {
  DAUMIER_CHECK(landmarks.rows() == 68, "{} landmarks of a picture, expected 68", landmarks.rows());
  std::vector<PicturedPoint> points;
  for (int k = 0; k < 68; ++k) {
    if (!landmarks.row(k).allFinite()) continue;
    points.push_back({face_template.annotation.landmarks[size_t(k)], landmarks.row(k).transpose(),
                      k < ContourPaths::kNumJaw ? k : -1});
  }
  return points;
}

PicturePoints ScaledView::Project(const geometry::Points& points) const {
  PicturePoints pixels = scale * points * rotation.topRows<2>().transpose();
  pixels.col(1) *= -1;
  return pixels.rowwise() + shift.transpose();
}

ScaledView FindScaledView(const geometry::Points& points, const PicturePoints& pixels, const Eigen::VectorXd& weights) {
  DAUMIER_CHECK(points.rows() == pixels.rows() && weights.size() == pixels.rows(),
                "{} points, {} pixels and {} weights of a view", points.rows(), pixels.rows(), weights.size());
  DAUMIER_CHECK((weights.array() > 0).count() >= 4, "{} points count for a view, expected four or more",
                (weights.array() > 0).count());
  const double sum = weights.sum();
  const Eigen::RowVector3d middle = weights.transpose() * points / sum;
  const Eigen::RowVector2d pixel_middle = weights.transpose() * pixels / sum;
  const Eigen::MatrixX3d p = points.rowwise() - middle;
  Eigen::MatrixX2d q = pixels.rowwise() - pixel_middle;
  q.col(1) *= -1;
  Eigen::Matrix3d moments = p.transpose() * weights.asDiagonal() * p;
  const double spread = moments.trace();
  DAUMIER_CHECK(spread > 0 && (q.transpose() * weights.asDiagonal() * q).trace() > 0,
                "the points of a view lie in one place");
  moments.diagonal().array() += 1e-9 * spread;  // Points in a plane.
  const Eigen::Matrix<double, 2, 3> affine =
      (moments.ldlt().solve(p.transpose() * weights.asDiagonal() * q)).transpose();
  Eigen::Matrix3d rows;
  rows.row(0) = affine.row(0).normalized();
  rows.row(1) = affine.row(1).normalized();
  rows.row(2) = rows.row(0).cross(rows.row(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rows, Eigen::ComputeFullU | Eigen::ComputeFullV);
  ScaledView view;
  view.rotation = svd.matrixU() * svd.matrixV().transpose();
  if (view.rotation.determinant() < 0)
    view.rotation = svd.matrixU() * Eigen::Vector3d(1, 1, -1).asDiagonal() * svd.matrixV().transpose();
  view.scale = (affine.row(0).norm() + affine.row(1).norm()) / 2;
  const PicturePoints projected = view.Project(middle);
  view.shift = (pixel_middle - projected.row(0)).transpose();
  return view;
}

CodeLandmarkFit FitCodeToLandmarks(const CodeModel& model, const ContourPaths& contour,
                                   const std::vector<PicturedPoint>& points, const CodeLandmarkOptions& options) {
  DAUMIER_CHECK(std::ssize(points) >= kFewestPoints, "{} landmarks of a picture, expected {} or more", points.size(),
                kFewestPoints);
  for (const PicturedPoint& point : points) {
    DAUMIER_CHECK(point.vertex >= 0 && point.vertex < model.face_template().num_vertices(),
                  "vertex {} does not exist (the face has {})", point.vertex, model.face_template().num_vertices());
    DAUMIER_CHECK(point.pixel.allFinite(), "a landmark of a picture is not finite");
  }
  return LandmarkRounds(model, contour, points, options).Run();
}

PicturePoints ShownLandmarks(const CodeModel& model, const ContourPaths& contour, const Eigen::VectorXd& code,
                             const ScaledView& view) {
  const std::vector<PicturedPoint> points = PicturedLandmarks(model.face_template(), PicturePoints::Zero(68, 2));
  return view.Project(AsPoints(model.Positions(code, OnSilhouette(model, contour, points, code, view))));
}

}  // namespace daumier::fitting
