#pragma once
#include "eval/drawing_labels.h"
#include "faces/face_model.h"
#include "faces/face_points.h"
#include "render/camera.h"
#include "render/framing.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Errors of faces that were predicted from hand-labelled drawings.
namespace daumier::eval {

/// Distance of each point of a face to its label / distance of the outer corners of the eyes; absent without a label.
using PointErrors = std::array<std::optional<double>, faces::kNumFacePoints>;

/// Parts of a face over which errors of points are averaged: eyes, brows, nose, mouth, contour (with the chin).
inline constexpr int kNumDrawnParts = 5;
extern const std::array<std::string_view, kNumDrawnParts> kDrawnPartNames;
int DrawnPartOf(faces::FacePoint point);

/// Mean of the errors that are there, or of those of a part; absent if there is none.
std::optional<double> MeanOf(const PointErrors& errors, std::optional<int> part = {});

/// The similarity p -> matrix p + shift of the plane that minimises sum |matrix p_i + shift - q_i|^2; no reflection.
struct PlaneSimilarity {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
};
/// points, targets: P x 2. @throws Error if the numbers of points differ or all points are one.
PlaneSimilarity AlignInPlane(const Eigen::MatrixX2d& points, const Eigen::MatrixX2d& targets);

/// A face as a prediction of a drawing.
struct DrawnPrediction {
  geometry::Points vertices;  ///< V x 3, cm.
  render::Placement frame;    ///< Of the drawing's sheet on the canvas.
  /// Of a sheet that was photographed and rectified (render::Drawing): labels are in pixels of the photograph.
  std::optional<Eigen::Matrix3d> picture_from_sheet = {};
};

/// Opening of mouth and eyes in the mesh, mm.
struct MeshStates {
  double lip_gap_mm = 0;  ///< Height of landmark 62 above landmark 66: below 0 the lips cross.
  double lid_gap_mm = 0;  ///< Mean distance of landmarks 37-41, 38-40, 43-47, 44-46.

  bool mouth_is_open() const { return lip_gap_mm > 1.5; }
  bool eyes_are_closed() const { return lid_gap_mm < 1; }
  bool lips_cross() const { return lip_gap_mm < -1; }
};

/// Points of faces of one topology on the sheet of a drawing.
class DrawingScorer {
 public:
  /// camera: projects onto the canvas. @throws Error as faces::FindFacePoints.
  DrawingScorer(const faces::FaceTemplate& face_template, const render::Camera& camera);

  /// V x 2 on the canvas, and on the picture of a drawing, whose pixels the labels count.
  Eigen::MatrixX2d OnCanvas(const geometry::Points& vertices) const;
  Eigen::MatrixX2d OnPicture(const DrawnPrediction& prediction) const;

  PointErrors Errors(const Eigen::MatrixX2d& projected, const LabelledDrawing& drawing) const;
  /// The face moved by the similarity that brings its points nearest to the labels: a bound that uses them. The points
  /// of contours follow, in 30 rounds.
  Eigen::MatrixX2d PlacedBest(Eigen::MatrixX2d projected, const LabelledDrawing& drawing) const;
  MeshStates StatesOf(const geometry::Points& vertices) const;

  const geometry::Points& neutral() const { return neutral_; }

 private:
  faces::FacePointVertices points_;
  std::array<int, 68> landmarks_;
  geometry::Points neutral_;
  render::Camera camera_;
};

struct DrawingScore {
  std::string name, group;
  bool is_predicted = true;    ///< Otherwise the mean face counts, in the frame of the drawing's extents.
  PointErrors errors = {};     ///< Of the prediction in its frame.
  PointErrors aligned = {};    ///< Of the prediction placed best.
  PointErrors mean_face = {};  ///< Of the mean face placed best.
  std::optional<bool> mouth_is_right = {}, eyes_are_right = {};  ///< Absent where the label has no state.
  MeshStates states = {};
  /// Whether the labels are nearer to this face than to the face of any other drawing of the group, each placed best.
  /// Absent if there is no other; false without a prediction, whose mean face counts as one of the others.
  std::optional<bool> is_recognised = {};
};

/// The frame of a drawing without a prediction.
using FrameOfDrawing = std::function<render::Placement(const LabelledDrawing&)>;
/// render::FrameDrawing of the drawing's file: the frame of its extents. @throws Error naming a file that is absent or
/// has no such line.
render::Placement FrameOfExtents(const LabelledDrawing& drawing);

/// Of every scored drawing, in order. Where `predictions` lacks it, the mean face counts.
std::vector<DrawingScore> ScoreDrawings(const DrawingScorer& scorer, std::span<const LabelledDrawing> drawings,
                                        const std::map<std::string, DrawnPrediction>& predictions,
                                        const FrameOfDrawing& frame_of = FrameOfExtents);

}  // namespace daumier::eval
