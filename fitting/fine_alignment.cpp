#include "fitting/fine_alignment.h"

#include "core/error.h"
#include "faces/landmark_parts.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace daumier::fitting {
namespace {

using geometry::Vector3;

constexpr int kNumJaw = ContourPaths::kNumJaw;
/// Edges about a landmark over which its direction is averaged: lids and lips have rims that face anywhere.
constexpr int kSurroundingRings = 3;
/// Between these cosines of the angle to the viewer a landmark becomes hidden.
constexpr double kHiddenCosine = -0.05, kSeenCosine = 0.25;
/// Upper and lower landmarks of lids and lips.
constexpr std::array<std::pair<int, int>, 7> kLidAndLipPairs = {
    {{37, 41}, {38, 40}, {43, 47}, {44, 46}, {61, 67}, {62, 66}, {63, 65}}};

double WeightOfPart(const FineAlignmentOptions& options, int landmark) {
  const std::array<double, 5> weights = {options.jaw, options.brows, options.nose, options.eyes, options.mouth};
  for (size_t p = 0; p < weights.size(); ++p) {
    if (landmark < faces::kLandmarkParts[p].end) return weights[p];
  }
  return 0;
}

/// The point of a picture at the depth of a posed point, in the frame that is posed.
Vector3 Unprojected(const Eigen::Vector2d& pixel, double depth, const PortraitPose& pose, const PortraitView& view) {
  const double scale = (view.distance - depth) / view.focal;
  const Vector3 posed((pixel.x() - view.centre) * scale, (view.centre - pixel.y()) * scale, depth);
  return RotationOf(pose).transpose() * (posed - pose.tail<3>());
}

/// The place nearest to `point` on the line of the jaw's given landmarks, between the neighbours of landmark k.
Eigen::Vector2d OnJawLine(const PicturePoints& landmarks, const Eigen::VectorXd& weights, int k,
                          const Eigen::Vector2d& point) {
  const auto neighbour = [&](int step) {
    int n = k + step;
    while (n >= 0 && n < kNumJaw && weights[n] == 0) n += step;
    return n >= 0 && n < kNumJaw ? n : k;
  };
  Eigen::Vector2d best = landmarks.row(k);
  double least = (best - point).squaredNorm();
  for (const int other : {neighbour(-1), neighbour(1)}) {
    if (other == k) continue;
    const Eigen::Vector2d from = landmarks.row(k), along = landmarks.row(other).transpose() - from;
    const double length = along.squaredNorm();
    const double share = length > 0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0;
    const Eigen::Vector2d place = from + share * along;
    if ((place - point).squaredNorm() >= least) continue;
    least = (place - point).squaredNorm();
    best = place;
  }
  return best;
}

/// Targets of upper lids and lips that are below those of lower ones meet these half way.
void KeepTargetsInOrder(geometry::Points& targets, const Eigen::VectorXd& weights) {
  for (const auto& [upper, lower] : kLidAndLipPairs) {
    if (weights[upper] == 0 || weights[lower] == 0 || targets(upper, 1) >= targets(lower, 1)) continue;
    targets(upper, 1) = targets(lower, 1) = (targets(upper, 1) + targets(lower, 1)) / 2;
  }
}

/// Anchors as a list without repetitions: where several landmarks have one vertex, it gets their weighted mean.
struct MergedAnchors {
  std::vector<int> ids;    ///< Positions or vertices.
  geometry::Points moves;  ///< One an id.
  Eigen::VectorXd weights;
};

MergedAnchors Merge(const std::vector<int>& id_of_landmark, const geometry::Points& moves,
                    const Eigen::VectorXd& weights) {
  MergedAnchors merged;
  std::vector<std::pair<int, int>> order;  // Id, landmark.
  for (int k = 0; k < 68; ++k) {
    if (weights[k] > 0) order.emplace_back(id_of_landmark[size_t(k)], k);
  }
  std::sort(order.begin(), order.end());
  merged.moves = geometry::Points::Zero(Eigen::Index(order.size()), 3);
  merged.weights = Eigen::VectorXd::Zero(Eigen::Index(order.size()));
  for (const auto& [id, k] : order) {
    if (merged.ids.empty() || merged.ids.back() != id) merged.ids.push_back(id);
    const Eigen::Index at(merged.ids.size() - 1);
    merged.moves.row(at) += weights[k] * moves.row(k);
    merged.weights[at] += weights[k];
  }
  const Eigen::Index count(merged.ids.size());
  merged.moves.conservativeResize(count, 3);
  merged.weights.conservativeResize(count);
  for (Eigen::Index i = 0; i < count; ++i) merged.moves.row(i) /= merged.weights[i];
  return merged;
}

/// The anchors of a face among those of a solver.
class AnchoredFace {
 public:
  /// id_of_landmark: position of each landmark's vertex among the anchors of the solver.
  AnchoredFace(const geometry::LaplacianAnchors& solver, std::vector<int> id_of_landmark)
      : solver_(solver), id_of_landmark_(std::move(id_of_landmark)) {}

  /// Displacements of the landmarks' vertices, 68 x 3.
  geometry::Points Landmarks(const geometry::Points& moves, const Eigen::VectorXd& weights) const {
    const auto [all_moves, all_weights] = Spread(moves, weights);
    const geometry::Points anchors = solver_.SolveAnchors(all_moves, all_weights);
    geometry::Points landmarks(68, 3);
    for (int k = 0; k < 68; ++k) landmarks.row(k) = anchors.row(id_of_landmark_[size_t(k)]);
    return landmarks;
  }
  geometry::Points All(const geometry::Points& moves, const Eigen::VectorXd& weights) const {
    const auto [all_moves, all_weights] = Spread(moves, weights);
    return solver_.Solve(all_moves, all_weights);
  }

 private:
  struct Spreading {
    geometry::Points moves;
    Eigen::VectorXd weights;
  };
  Spreading Spread(const geometry::Points& moves, const Eigen::VectorXd& weights) const {
    const MergedAnchors merged = Merge(id_of_landmark_, moves, weights);
    Spreading spread{geometry::Points::Zero(solver_.num_anchors(), 3), Eigen::VectorXd::Zero(solver_.num_anchors())};
    for (size_t i = 0; i < merged.ids.size(); ++i) {
      spread.moves.row(merged.ids[i]) = merged.moves.row(Eigen::Index(i));
      spread.weights[merged.ids[i]] = merged.weights[Eigen::Index(i)];
    }
    return spread;
  }

  const geometry::LaplacianAnchors& solver_;
  const std::vector<int> id_of_landmark_;
};

double RmsOf(const PicturePoints& points, const PicturePoints& targets, const Eigen::VectorXd& weights) {
  double sum = 0;
  for (int k = 0; k < 68; ++k) {
    if (weights[k] > 0) sum += weights[k] * (points.row(k) - targets.row(k)).squaredNorm();
  }
  return std::sqrt(sum / weights.sum());
}

}  // namespace

FineAlignment::FineAlignment(const faces::FaceTemplate& face_template, const FineAlignmentOptions& options)
    : options_(options),
      triangles_(face_template.triangles),
      landmarks_(face_template.annotation.landmarks),
      contour_paths_(face_template),
      openings_(face_template, FindOpeningPairs(face_template)) {
  const int num_vertices = face_template.num_vertices();
  const geometry::Adjacency neighbours = geometry::VertexNeighbours(triangles_, num_vertices),
                            around = geometry::TrianglesAtVertices(triangles_, num_vertices);
  for (const int vertex : landmarks_) {
    std::vector<int> faces;
    for (const int v : geometry::VerticesWithin(neighbours, {vertex}, kSurroundingRings))
      faces.insert(faces.end(), around[v].begin(), around[v].end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    surroundings_.push_back(std::move(faces));
  }
  if (options_.laplacian != "uniform") return;
  std::vector<int> ids(landmarks_.begin(), landmarks_.end());
  if (options_.contour == "slide") {
    const std::vector<int> candidates = contour_paths_.AllVertices();
    ids.insert(ids.end(), candidates.begin(), candidates.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  column_of_.assign(size_t(num_vertices), -1);
  for (size_t i = 0; i < ids.size(); ++i) column_of_[size_t(ids[i])] = int(i);
  uniform_ = std::make_unique<geometry::LaplacianAnchors>(geometry::UniformLaplacian(triangles_, num_vertices),
                                                          std::move(ids));
}

std::array<int, 68> FineAlignment::Anchors(const geometry::Points& vertices, const PortraitPose& pose,
                                           const PortraitView& view) const {
  std::array<int, 68> anchors = landmarks_;
  if (options_.contour != "slide") return anchors;
  for (int k = 0; k < kNumJaw; ++k) {
    const std::vector<int>& path = contour_paths_.vertices(k);
    const PicturePoints pixels = Projected(Posed(vertices(path, Eigen::all), pose), view);
    anchors[size_t(k)] = path[size_t(contour_paths_.Outermost(k, pixels, pose[2]))];
  }
  return anchors;
}

Eigen::VectorXd FineAlignment::Weights(const geometry::Points& coarse, const PortraitPose& pose,
                                       const Eigen::VectorXd& confidences) const {
  const Vector3 view_axis = RotationOf(pose).row(2);  // Of the viewer, in the face's frame.
  Eigen::VectorXd weights(68);
  for (int k = 0; k < 68; ++k) {
    const double confidence = confidences.size() == 0 ? 1 : confidences[k];
    DAUMIER_CHECK(confidence >= 0, "landmark {} has the confidence {}", k, confidence);
    Vector3 direction = Vector3::Zero();
    for (const int f : surroundings_[size_t(k)]) {
      const Vector3 origin = coarse.row(triangles_(f, 0));
      direction +=
          (coarse.row(triangles_(f, 1)).transpose() - origin).cross(coarse.row(triangles_(f, 2)).transpose() - origin);
    }
    const double cosine = direction.norm() > 0 ? direction.normalized().dot(view_axis) : 1;
    const bool slides = k < kNumJaw && options_.contour == "slide";  // A silhouette is seen.
    const double seen = slides ? 1 : std::clamp((cosine - kHiddenCosine) / (kSeenCosine - kHiddenCosine), 0.0, 1.0);
    weights[k] = WeightOfPart(options_, k) * confidence * (options_.hidden + (1 - options_.hidden) * seen);
  }
  return weights;
}

AlignedFace FineAlignment::Align(const geometry::Points& coarse, const PortraitPose& pose,
                                 const PicturePoints& landmarks, const Eigen::VectorXd& confidences,
                                 const PortraitView& view) const {
  DAUMIER_CHECK(landmarks.rows() == 68 && (confidences.size() == 0 || confidences.size() == 68),
                "{} landmarks and {} confidences of a portrait, expected 68", landmarks.rows(), confidences.size());
  DAUMIER_CHECK(coarse.rows() > triangles_.maxCoeff(), "a face of {} vertices, expected {}", coarse.rows(),
                triangles_.maxCoeff() + 1);
  AlignedFace aligned;
  aligned.anchors = Anchors(coarse, pose, view);
  aligned.weights = Weights(coarse, pose, confidences);
  DAUMIER_CHECK((aligned.weights.array() > 0).any(), "no landmark has a weight");

  geometry::Points before(68, 3);
  for (int k = 0; k < 68; ++k) before.row(k) = coarse.row(aligned.anchors[size_t(k)]);
  const geometry::Points posed = Posed(before, pose);
  const PicturePoints pixels_before = Projected(posed, view);
  PicturePoints wanted = landmarks;
  const bool slides = options_.contour == "slide";
  const auto slide_to = [&](const PicturePoints& pixels) {
    for (int k = 0; slides && k < kNumJaw; ++k) {
      if (aligned.weights[k] > 0) wanted.row(k) = OnJawLine(landmarks, aligned.weights, k, pixels.row(k));
    }
  };
  const auto moves = [&] {
    geometry::Points targets = before;
    for (int k = 0; k < 68; ++k) {
      if (aligned.weights[k] > 0) targets.row(k) = Unprojected(wanted.row(k), posed(k, 2), pose, view);
    }
    if (options_.keep_order) KeepTargetsInOrder(targets, aligned.weights);
    return geometry::Points(targets - before);
  };

  std::vector<int> id_of_landmark(68);
  std::unique_ptr<const geometry::LaplacianAnchors> own;
  if (uniform_ != nullptr) {
    for (size_t k = 0; k < 68; ++k) id_of_landmark[k] = column_of_[size_t(aligned.anchors[k])];
  } else {
    std::vector<int> ids(aligned.anchors.begin(), aligned.anchors.end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    for (size_t k = 0; k < 68; ++k)
      id_of_landmark[k] = int(std::lower_bound(ids.begin(), ids.end(), aligned.anchors[k]) - ids.begin());
    own = std::make_unique<geometry::LaplacianAnchors>(geometry::CotangentLaplacian({coarse, triangles_}),
                                                       std::move(ids), geometry::AnchorUse::kOnce);
  }
  const AnchoredFace face(uniform_ != nullptr ? *uniform_ : *own, std::move(id_of_landmark));
  slide_to(pixels_before);
  for (int round = 0; slides && round < options_.slides; ++round) {
    const geometry::Points moved = before + face.Landmarks(moves(), aligned.weights);
    slide_to(Projected(Posed(moved, pose), view));
  }
  aligned.vertices = coarse + face.All(moves(), aligned.weights);
  if (options_.keep_order) {
    for (size_t i = 0; i < openings_.openings().size(); ++i) openings_.Reach({}, i, aligned.vertices);
  }
  geometry::Points after(68, 3);
  for (int k = 0; k < 68; ++k) after.row(k) = aligned.vertices.row(aligned.anchors[size_t(k)]);
  aligned.rms_before_px = RmsOf(pixels_before, landmarks, aligned.weights);
  aligned.rms_px = RmsOf(Projected(Posed(after, pose), view), landmarks, aligned.weights);
  return aligned;
}

}  // namespace daumier::fitting
