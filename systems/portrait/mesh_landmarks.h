#pragma once
#include "faces/face_model.h"
#include "faces/landmark_order.h"
#include "geometry/nearest.h"
#include "render/shading.h"
#include "systems/portrait/landmark_detector.h"

#include <array>
#include <string>

namespace daumier::portrait {

/// One of the 24 ways in which the axes of a head may lie.
struct HeadOrientation {
  Eigen::Matrix3d upright_from_mesh;  ///< A rotation: the result has y up and the face to +z.
  std::string name;                   ///< "y up, the face to +z"
};

/// All of them, the usual ones first: y up, z up, then the rest; within each the face to the front, the back and the sides.
const std::array<HeadOrientation, 24>& HeadOrientations();

/// 68 landmarks on a head mesh.
struct MeshLandmarkSearch {
  std::array<geometry::SurfacePoint, faces::kNumLandmarks> points;  ///< In the mesh's frame.
  std::array<double, faces::kNumLandmarks> spreads;  ///< Mean distance of what single views found, unit of the mesh.
  HeadOrientation orientation;
  double confidence = 0;  ///< Of the face seen from the front.
  int num_views = 0;      ///< In which the face was found.
  render::Image front;    ///< The head from the front with its landmarks.
};

/// Finds the landmarks of a head mesh by those of pictures of it. The orientations are tried in their order, each in four
/// pictures around its upright axis, until one has a face whose halves are alike. Then the head is turned as its landmarks
/// lie to those of the template, and drawn from seven directions (yaw 0, +-20, +-40, pitch +-15 degrees); each landmark is
/// traced back along the line of sight to the surface in front. A landmark is the weighted geometric median over the views
/// (confidence times squared cosine between normal and line of sight), on the surface; the contour, which depends on the
/// view, is that of the front.
/// drawn: the mesh in any unit, with its texture or colours. Deterministic.
/// @throws Error if there is no face in any orientation, or if the picture from the front has two.
MeshLandmarkSearch FindMeshLandmarks(const render::RenderInput& drawn, const faces::FaceTemplate& face_template,
                                     const LandmarkDetector& detector);

}  // namespace daumier::portrait
