#include "fitting/labelled_fit.h"

#include "core/error.h"
#include "fitting/smooth_modes.h"
#include "geometry/coordinates.h"
#include "geometry/flips.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace daumier::fitting {
namespace {

constexpr double kCrossedCm = -0.01;
/// Of a contour every so-manieth vertex is a centre of smooth displacements.
constexpr size_t kContourStep = 5;

template <class Index>
void Renumber(const std::map<int, int>& index, Index& vertex) {
  vertex = index.at(vertex);
}
void RenumberAll(const std::map<int, int>& index, std::vector<int>& vertices) {
  for (int& vertex : vertices) Renumber(index, vertex);
}

/// The vertices that points, curves and openings use, ascending, and these by their positions among them.
std::vector<int> RenumberSeen(SeenFace& seen) {
  std::set<int> used;
  const auto use = [&](const std::vector<int>& vertices) { used.insert(vertices.begin(), vertices.end()); };
  for (const auto& vertices : seen.points.of_points) use(vertices);
  for (const auto& vertices : seen.points.contours) use(vertices);
  for (const LabelCurve& curve : seen.curves) use(curve.vertices);
  for (const OpeningPairs& opening : seen.openings) use(opening.upper), use(opening.lower);
  std::vector<int> list(used.begin(), used.end());
  std::map<int, int> index;
  for (size_t i = 0; i < list.size(); ++i) index[list[i]] = int(i);
  for (auto& vertices : seen.points.of_points) RenumberAll(index, vertices);
  for (auto& vertices : seen.points.contours) RenumberAll(index, vertices);
  for (LabelCurve& curve : seen.curves) RenumberAll(index, curve.vertices);
  for (OpeningPairs& opening : seen.openings) {
    RenumberAll(index, opening.upper);
    RenumberAll(index, opening.lower);
    for (GapPair& pair : opening.pairs) {
      Renumber(index, pair.upper);
      Renumber(index, pair.lower.from);
      Renumber(index, pair.lower.to);
    }
  }
  return list;
}

/// Right and middle points of the face and some places of the right contour.
geometry::Points CentresOf(const faces::FacePointVertices& points, const geometry::Points& mean) {
  std::vector<geometry::Vector3> centres;
  for (int i = 0; i < faces::kNumLandmarkPoints; ++i) {
    const auto point = faces::FacePoint(i);
    if (int(faces::MirroredPoint(point)) < i || faces::ContourOf(point)) continue;
    const std::vector<int>& vertices = points.of_points[size_t(i)];
    centres.push_back(mean(vertices, Eigen::all).colwise().mean().transpose());
  }
  for (size_t i = 0; i + 1 < points.contours[0].size(); i += kContourStep)
    centres.push_back(mean.row(points.contours[0][i]).transpose());
  geometry::Points result(Eigen::Index(centres.size()), 3);
  for (size_t i = 0; i < centres.size(); ++i) result.row(Eigen::Index(i)) = centres[i].transpose();
  return result;
}

std::vector<float> FloatsOf(const geometry::Points& points) {
  std::vector<float> result(size_t(points.size()));
  std::transform(points.data(), points.data() + points.size(), result.begin(), [](double x) { return float(x); });
  return result;
}

Eigen::Matrix3d TurnOfHead(const LabelledFit& fit) {
  constexpr double kDegree = std::numbers::pi / 180;
  return TurnOf(fit.yaw_degrees * kDegree, fit.pitch_degrees * kDegree);
}

}  // namespace

std::vector<float> TurnedAs(const LabelledFit& fit, const Eigen::VectorXf& face) {
  geometry::Points points = geometry::PointsFrom({face.data(), size_t(face.size())});
  const Eigen::Matrix3d turn = TurnOfHead(fit);
  points = ((points.rowwise() - fit.pivot.transpose()) * turn.transpose()).rowwise() + fit.pivot.transpose();
  return FloatsOf(points);
}

std::vector<float> Upright(const LabelledFit& fit) {
  geometry::Points points = geometry::PointsFrom(fit.vertices);
  const Eigen::Matrix3d turn = TurnOfHead(fit);
  points = ((points.rowwise() - fit.pivot.transpose()) * turn).rowwise() + fit.pivot.transpose();
  return FloatsOf(points);
}

LabelledFitter::LabelledFitter(const faces::FaceTemplate& face_template, const render::Camera& camera,
                               faces::FaceGaussian gaussian, const LabelledFitOptions& options)
    : template_(face_template),
      gaussian_(std::move(gaussian)),
      options_(options),
      mover_(face_template, FindOpeningPairs(face_template)) {
  DAUMIER_CHECK(!camera.perspective, "labelled drawings are fitted under an orthographic camera alone");
  DAUMIER_CHECK(gaussian_.num_coordinates() == 3 * face_template.num_vertices(),
                "a distribution of faces of {} coordinates for a template of {} vertices", gaussian_.num_coordinates(),
                face_template.num_vertices());
  seen_.camera = camera;
  seen_.points = faces::FindFacePoints(face_template);
  seen_.curves = FindLabelCurves(face_template, seen_.points);
  seen_.openings = mover_.openings();

  const geometry::Points mean = geometry::PointsFrom({gaussian_.mean.data(), size_t(gaussian_.mean.size())});
  const Eigen::MatrixX2d in_plane = mean.leftCols<2>();
  const double eyes = EyeDistance(seen_.points, in_plane);
  smooth_rows_ = MakeSmoothModes(mean, CentresOf(seen_.points, mean),
                                 {.length_cm = options.smooth_length * eyes,
                                  .deviation_cm = options.smooth_deviation * eyes,
                                  .asymmetry = options.asymmetry})
                     .rows;
  seen_.pivot = (mean(seen_.points.contours[0], Eigen::all).colwise().mean() +
                 mean(seen_.points.contours[1], Eigen::all).colwise().mean())
                    .transpose() /
                2;
  const std::vector<int> list = RenumberSeen(seen_);
  const Eigen::Index num_seen(list.size()), num_rows = gaussian_.rows.rows();
  rescale_ = Eigen::VectorXd::Ones(num_rows);
  rescale_.tail(num_rows - gaussian_.num_symmetric).setConstant(options.asymmetry);
  seen_.mean.resize(3 * num_seen);
  seen_.modes.setZero(num_rows + smooth_rows_.rows(), 3 * num_seen);
  for (Eigen::Index i = 0; i < num_seen; ++i) {
    const Eigen::Index vertex = list[size_t(i)];
    seen_.mean.segment<3>(3 * i) = mean.row(vertex).transpose();
    seen_.modes.block(0, 3 * i, num_rows, 3) =
        rescale_.asDiagonal() * gaussian_.rows.middleCols<3>(3 * vertex).cast<double>();
    seen_.modes.block(num_rows, 3 * i, smooth_rows_.rows(), 2) = smooth_rows_.middleCols<2>(2 * vertex).cast<double>();
  }
}

std::optional<LabelledFit> LabelledFitter::Fit(const LabelledDrawing& drawing, const FacePrior& prior) const {
  const Eigen::Index num_rows = gaussian_.rows.rows(), num_smooth = smooth_rows_.rows();
  DAUMIER_CHECK(prior.mean.size() == 0 || prior.mean.size() == num_rows,
                "a prior mean of {} coefficients for {} components", prior.mean.size(), num_rows);
  DAUMIER_CHECK(prior.share > 0, "a prior of deviation {}", prior.share);
  ModePrior modes{Eigen::VectorXd::Zero(num_rows + num_smooth), Eigen::VectorXd::Ones(num_rows + num_smooth)};
  if (prior.mean.size() > 0) modes.mean.head(num_rows) = prior.mean.cast<double>().cwiseQuotient(rescale_);
  modes.deviation.head(num_rows).setConstant(prior.share);
  const std::optional<SolvedFace> solved = SolveFace(seen_, drawing, modes, options_);
  if (!solved) return std::nullopt;

  LabelledFit fit;
  fit.coefficients = rescale_.cwiseProduct(solved->weights.head(num_rows)).cast<float>();
  fit.frame = solved->frame;
  fit.yaw_degrees = solved->yaw * 180 / std::numbers::pi;
  fit.pitch_degrees = solved->pitch * 180 / std::numbers::pi;
  fit.pivot = seen_.pivot;
  fit.residual_scale = solved->residual_scale;
  fit.rms = solved->rms;
  fit.num_matched = solved->num_matched;

  const Eigen::VectorXf of_gaussian = faces::Reconstruct(gaussian_, fit.coefficients);
  const geometry::Points linear = geometry::PointsFrom({of_gaussian.data(), size_t(of_gaussian.size())});
  const Eigen::VectorXf smooth = smooth_rows_.transpose() * solved->weights.tail(num_smooth).cast<float>();
  const auto face_region = template_.annotation.regions.find("face");
  const std::vector<int> region =
      face_region == template_.annotation.regions.end() ? std::vector<int>{} : face_region->second;
  const auto num_flipped = [&](const geometry::Points& points) {
    return geometry::CountFlippedTriangles(linear, points, template_.triangles, region);
  };
  geometry::Points points;
  for (fit.smooth_share = 1;; fit.smooth_share = fit.smooth_share > 0.1 ? fit.smooth_share / 2 : 0) {
    points = linear;
    for (Eigen::Index v = 0; v < points.rows(); ++v)
      points.row(v).head<2>() += fit.smooth_share * smooth.segment<2>(2 * v).cast<double>().transpose();
    if (fit.smooth_share == 0 || num_flipped(points) == 0) break;
  }
  for (size_t i = 0; i < mover_.openings().size(); ++i) {
    const OpeningPairs& opening = mover_.openings()[i];
    mover_.Reach(GoalOf(opening.opening, drawing), i, points);
    const int num_crossed = int((GapsOf(opening, points).array() < kCrossedCm).count());
    (opening.opening == Opening::kMouth ? fit.num_crossed_lips : fit.num_crossed_lids) += num_crossed;
  }
  fit.num_flipped = num_flipped(points);
  const Eigen::Matrix3d turn = TurnOf(solved->yaw, solved->pitch);
  points = ((points.rowwise() - seen_.pivot.transpose()) * turn.transpose()).rowwise() + seen_.pivot.transpose();
  fit.vertices = FloatsOf(points);
  return fit;
}

}  // namespace daumier::fitting
