#include "systems/portrait/mesh_landmarks.h"

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/alignment.h"
#include "geometry/normals.h"
#include "geometry/triangle_tree.h"
#include "render/camera.h"
#include "render/rasteriser.h"
#include "systems/portrait/landmark_overlay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::portrait {
namespace {

constexpr int kSearchPicture = 256, kViewPicture = 448;
constexpr double kHeadMargin = 1.05;
constexpr double kFrameOfLandmarks = 1.15;  // Half the height of a picture, in heights of the landmarks.
constexpr double kLeastSymmetry = 0.6, kLeastOfView = 0.5;
constexpr double kLargestTilt = 50;      // Degrees: of a face that is found upright.
constexpr double kTracedWithin = 0.035;  // Of the picture: how far from its pixel a landmark meets the surface.
constexpr double kInFront = 0.05;        // Of the frame's height: what is farther behind is seen through a hole.
constexpr int kMedianSteps = 30;
constexpr size_t kTipOfNose = 30;
struct ViewAngles {
  double yaw, pitch;
};
constexpr std::array<ViewAngles, 7> kViews = {{{0, 0}, {-20, 0}, {20, 0}, {-40, 0}, {40, 0}, {0, -15}, {0, 15}}};

/// Upright: up is y, and forward z.
HeadOrientation OrientationOf(int up_axis, int up_sign, int forward_axis, int forward_sign) {
  const Eigen::Vector3d up = up_sign * Eigen::Vector3d::Unit(up_axis),
                        forward = forward_sign * Eigen::Vector3d::Unit(forward_axis);
  HeadOrientation orientation;
  orientation.upright_from_mesh << up.cross(forward).transpose(), up.transpose(), forward.transpose();
  constexpr char kAxes[] = "xyz";
  orientation.name = fmt::format("{}{} up, the face to {}{}", up_sign < 0 ? "-" : "", kAxes[up_axis],
                                 forward_sign < 0 ? "-" : "+", kAxes[forward_axis]);
  return orientation;
}

std::array<HeadOrientation, 24> MakeOrientations() {
  struct Axis {
    int axis, sign;
  };
  constexpr std::array<Axis, 6> kUps = {{{1, 1}, {2, 1}, {1, -1}, {2, -1}, {0, 1}, {0, -1}}};
  std::array<HeadOrientation, 24> orientations;
  size_t count = 0;
  for (const Axis& up : kUps) {
    // With z up the usual front is -y, else +z; y last.
    const std::array<Axis, 6> fronts = up.axis == 2
                                           ? std::array<Axis, 6>{{{1, -1}, {1, 1}, {0, 1}, {0, -1}, {2, 1}, {2, -1}}}
                                           : std::array<Axis, 6>{{{2, 1}, {2, -1}, {0, 1}, {0, -1}, {1, 1}, {1, -1}}};
    for (const Axis& front : fronts)
      if (front.axis != up.axis) orientations[count++] = OrientationOf(up.axis, up.sign, front.axis, front.sign);
  }
  return orientations;
}

render::RenderInput Turned(const render::RenderInput& drawn, const Eigen::Matrix3d& rotation) {
  render::RenderInput turned = drawn;
  turned.surface.vertices = drawn.surface.vertices * rotation.transpose();
  return turned;
}

Eigen::Vector2d PointOf(const DetectedFace& face, int landmark) {
  return {face.landmarks[2 * size_t(landmark)], face.landmarks[2 * size_t(landmark) + 1]};
}

/// 1 for a face whose tip of the nose is in the middle of its contour, less for one from the side.
double SymmetryOf(const DetectedFace& face) {
  const double right = PointOf(face, 0).x(), left = PointOf(face, 16).x(), nose = PointOf(face, 30).x();
  return left <= right ? 0 : 1 - std::abs((nose - right) - (left - nose)) / (left - right);
}

double TiltOf(const DetectedFace& face) {
  const Eigen::Vector2d eyes = PointOf(face, 45) - PointOf(face, 36);
  return std::abs(std::atan2(eyes.y(), eyes.x())) * 180 / std::numbers::pi;
}

/// What is seen of a head in one orientation.
struct OrientationTrial {
  double score = 0;  ///< Confidence times symmetry of the best face.
  std::vector<DetectedFace> faces;
  double best_confidence = 0;  ///< Of any candidate.
};

OrientationTrial TryOrientation(const render::RenderInput& drawn, const Eigen::Matrix3d& rotation,
                                const LandmarkDetector& detector) {
  const render::RenderInput turned = Turned(drawn, rotation);
  const render::Frame frame = render::FrameOf(turned.surface.vertices, kHeadMargin);
  const render::Image picture =
      render::RenderMesh(turned, render::FrontalCamera(frame.centre, frame.half_height, kSearchPicture));
  OrientationTrial trial;
  std::optional<DetectedFace> candidate;
  trial.faces = detector.FindAll(picture, &candidate);
  std::erase_if(trial.faces, [](const DetectedFace& face) { return TiltOf(face) > kLargestTilt; });
  if (candidate) trial.best_confidence = candidate->confidence;
  if (trial.faces.empty()) return trial;
  const DetectedFace& best = LargestConfident(trial.faces);
  if (SymmetryOf(best) >= kLeastSymmetry) trial.score = best.confidence * SymmetryOf(best);
  return trial;
}

/// A head drawn by a camera, and what is in front at each pixel.
struct MeshView {
  render::Camera camera;
  render::Image picture;
  render::Raster raster;
};

MeshView Drawn(const render::RenderInput& turned, const render::Camera& camera) {
  return {camera, render::RenderMesh(turned, camera), render::Rasterise(camera, turned.surface)};
}

/// Where the line of sight through a point of the picture meets the surface: the pixel nearest to it of those that are not
/// seen through a hole.
std::optional<geometry::SurfacePoint> Traced(const MeshView& view, const geometry::TriangleMesh& surface,
                                             const Eigen::Vector2d& at, double frame_height) {
  const int reach = int(std::ceil(kTracedWithin * view.raster.width));
  const int row = int(std::floor(at.y())), column = int(std::floor(at.x()));
  const auto for_near = [&](const auto& visit) {
    for (int r = std::max(0, row - reach); r <= std::min(view.raster.height - 1, row + reach); ++r)
      for (int c = std::max(0, column - reach); c <= std::min(view.raster.width - 1, column + reach); ++c)
        if (view.raster.triangle[view.raster.index(r, c)] >= 0) visit(view.raster.index(r, c), r, c);
  };
  double front = std::numeric_limits<double>::infinity();
  for_near([&](size_t i, int, int) { front = std::min(front, view.raster.depth[i]); });
  std::optional<size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for_near([&](size_t i, int r, int c) {
    const double distance = (Eigen::Vector2d(c + 0.5, r + 0.5) - at).squaredNorm();
    if (view.raster.depth[i] > front + kInFront * frame_height || distance >= least) return;
    least = distance;
    best = i;
  });
  if (!best) return std::nullopt;
  geometry::SurfacePoint point{view.raster.triangle[*best], {}, geometry::Vector3::Zero(), 0};
  for (int k = 0; k < 3; ++k) {
    point.barycentric[k] = view.raster.barycentric[*best][size_t(k)];
    point.position += point.barycentric[k] * surface.vertices.row(surface.triangles(point.triangle, k)).transpose();
  }
  return point;
}

/// What one view says of a landmark.
struct LandmarkVote {
  geometry::Vector3 position;
  double weight;
};
using LandmarkVotes = std::array<std::vector<LandmarkVote>, faces::kNumLandmarks>;

geometry::Vector3 MedianOf(const std::vector<LandmarkVote>& votes) {
  geometry::Vector3 median = geometry::Vector3::Zero();
  double sum = 0;
  for (const LandmarkVote& vote : votes) median += vote.weight * vote.position, sum += vote.weight;
  median /= sum;
  for (int step = 0; step < kMedianSteps; ++step) {  // [Weiszfeld 1937]
    geometry::Vector3 next = geometry::Vector3::Zero();
    double weights = 0;
    for (const LandmarkVote& vote : votes) {
      const double weight = vote.weight / std::max((vote.position - median).norm(), 1e-9);
      next += weight * vote.position;
      weights += weight;
    }
    median = next / weights;
  }
  return median;
}

/// Adds what a view says. Returns whether it shows the face.
bool AddVotes(const MeshView& view, const DetectedFace& face, const geometry::TriangleMesh& surface,
              const geometry::Points& normals, bool is_front, double frame_height, LandmarkVotes& votes) {
  if (face.confidence < kLeastOfView) return false;
  const Eigen::RowVector3d towards = -view.camera.camera_from_world.row(2);
  for (int l = is_front ? 0 : faces::kNumContourLandmarks; l < faces::kNumLandmarks; ++l) {
    const auto point = Traced(view, surface, PointOf(face, l), frame_height);
    if (!point) continue;
    const double cosine = std::max(0.0, normals.row(point->triangle).dot(towards));
    const double weight = double(face.landmark_confidences[size_t(l)]) * cosine * cosine + 1e-6;
    votes[size_t(l)].push_back({point->position, weight});
  }
  return true;
}

/// The landmarks that have votes, and where they are.
struct MedianLandmarks {
  std::vector<int> landmarks;
  geometry::Points places;
};

MedianLandmarks MediansOf(const LandmarkVotes& votes) {
  MedianLandmarks medians;
  medians.places.resize(faces::kNumLandmarks, 3);
  for (int l = 0; l < faces::kNumLandmarks; ++l) {
    if (votes[size_t(l)].empty()) continue;
    medians.places.row(std::ssize(medians.landmarks)) = MedianOf(votes[size_t(l)]).transpose();
    medians.landmarks.push_back(l);
  }
  medians.places.conservativeResize(std::ssize(medians.landmarks), 3);
  return medians;
}

render::Frame FrameOfPlaces(const geometry::Points& places) {
  const Eigen::RowVector3d low = places.colwise().minCoeff(), high = places.colwise().maxCoeff();
  return {0.5 * (low + high).transpose(), kFrameOfLandmarks * (high - low).head<2>().maxCoeff()};
}

/// What a head turned in some way shows.
struct TurnedHead {
  render::RenderInput drawn;
  geometry::Points normals;  ///< Of the triangles.
  LandmarkVotes votes = {};
  int num_views = 0;
  double confidence = 0;
  render::Image front = {};
};

TurnedHead HeadTurnedBy(const render::RenderInput& drawn, const Eigen::Matrix3d& rotation) {
  TurnedHead head{Turned(drawn, rotation), {}};
  head.normals = geometry::TriangleNormals(head.drawn.surface);
  return head;
}

/// Finds the face in the first of kViews, near where its landmarks are.
void LookFrom(int num_views, const geometry::Points& places, const LandmarkDetector& detector, TurnedHead& head) {
  const render::Frame frame = FrameOfPlaces(places);
  ForEachInOrder(
      num_views,
      [&](int i) {
        const auto [yaw, pitch] = kViews[size_t(i)];
        const render::Camera camera = render::TurnedCamera(frame.centre, frame.half_height, kViewPicture, yaw, pitch);
        MeshView view = Drawn(head.drawn, camera);
        std::vector<float> points;
        const auto projected = render::Project(camera, places);
        for (Eigen::Index i = 0; i < projected.rows(); ++i)
          points.insert(points.end(), {float(projected(i, 0)), float(projected(i, 1))});
        DetectedFace face = detector.FindIn(view.picture, BoxOf(points));
        return std::pair(std::move(view), std::move(face));
      },
      [&](std::pair<MeshView, DetectedFace> seen) {
        const auto& [view, face] = seen;
        const bool is_front = head.front.pixels.empty();
        if (AddVotes(view, face, head.drawn.surface, head.normals, is_front, 2 * frame.half_height, head.votes))
          ++head.num_views;
        if (!is_front) return;
        head.confidence = face.confidence;
        head.front = view.picture;
        DrawLandmarks(head.front, face.landmarks, 1);
      });
  DAUMIER_CHECK(!head.votes[kTipOfNose].empty(),
                "the face was lost when the head was drawn upright. Give its landmarks with --landmarks");
}

/// An orientation in which there is one face.
struct ChosenOrientation {
  HeadOrientation orientation;
  DetectedFace face;  ///< In a picture of kSearchPicture.
};

ChosenOrientation ChooseOrientation(const render::RenderInput& drawn, const LandmarkDetector& detector) {
  constexpr size_t kSides = 4;
  const auto& orientations = HeadOrientations();
  std::optional<size_t> chosen;
  OrientationTrial best;
  double best_confidence = 0;
  for (size_t up = 0; up < orientations.size() && !chosen; up += kSides) {
    for (size_t i = up; i < up + kSides; ++i) {
      OrientationTrial trial = TryOrientation(drawn, orientations[i].upright_from_mesh, detector);
      best_confidence = std::max(best_confidence, trial.best_confidence);
      if (trial.score <= best.score) continue;
      best = std::move(trial);
      chosen = i;
    }
  }
  DAUMIER_CHECK(chosen,
                "no face was found in pictures of the mesh from 24 directions (the best candidate has a confidence of "
                "{:.2f}, a face needs {:.2f}). Is the head in the mesh large enough, and its face uncovered? Otherwise "
                "give its landmarks with --landmarks",
                best_confidence, detector.options().least_confidence);
  const DetectedFace& face = LargestConfident(best.faces);
  const auto num_faces = std::ranges::count_if(
      best.faces, [&](const DetectedFace& other) { return other.box.side() > 0.5 * face.box.side(); });
  DAUMIER_CHECK(num_faces < 2,
                "the mesh has {} faces (seen with {}), expected one. Save each head as a mesh of its own", num_faces,
                orientations[*chosen].name);
  return {orientations[*chosen], face};
}

}  // namespace

const std::array<HeadOrientation, 24>& HeadOrientations() {
  static const std::array<HeadOrientation, 24> orientations = MakeOrientations();
  return orientations;
}

MeshLandmarkSearch FindMeshLandmarks(const render::RenderInput& drawn, const faces::FaceTemplate& face_template,
                                     const LandmarkDetector& detector) {
  const ChosenOrientation chosen = ChooseOrientation(drawn, detector);
  Eigen::Matrix3d rotation = chosen.orientation.upright_from_mesh;
  TurnedHead head = HeadTurnedBy(drawn, rotation);
  const render::Frame frame = render::FrameOf(head.drawn.surface.vertices, kHeadMargin);
  const render::Camera camera = render::FrontalCamera(frame.centre, frame.half_height, kSearchPicture);
  AddVotes(Drawn(head.drawn, camera), chosen.face, head.drawn.surface, head.normals, true, 2 * frame.half_height,
           head.votes);
  for (const int num_views : {1, int(kViews.size())}) {  // Turned as the template, first by what one view shows.
    const MedianLandmarks found = MediansOf(head.votes);
    std::vector<int> of_template;
    for (const int l : found.landmarks) of_template.push_back(face_template.annotation.landmarks[size_t(l)]);
    const Eigen::Matrix3d turn =
        geometry::AlignRobustly(found.places, face_template.neutral(of_template, Eigen::all)).rotation;
    rotation = turn * rotation;
    head = HeadTurnedBy(drawn, rotation);
    LookFrom(num_views, found.places * turn.transpose(), detector, head);
  }

  MeshLandmarkSearch search;
  search.orientation = chosen.orientation;
  search.confidence = head.confidence;
  search.num_views = head.num_views;
  search.front = std::move(head.front);
  const geometry::TriangleTree tree(drawn.surface);
  for (size_t l = 0; l < head.votes.size(); ++l) {
    const std::vector<LandmarkVote>& votes = head.votes[l];
    DAUMIER_CHECK(!votes.empty(), "landmark {} was found on no surface. Give the landmarks with --landmarks", l);
    const geometry::Vector3 median = MedianOf(votes);
    search.points[l] = tree.Closest(rotation.transpose() * median);
    double sum = 0, weights = 0;
    for (const LandmarkVote& vote : votes) {
      sum += vote.weight * (vote.position - median).norm();
      weights += vote.weight;
    }
    search.spreads[l] = sum / weights;
  }
  return search;
}

}  // namespace daumier::portrait
