#pragma once
#include "fitting/code_landmarks.h"
#include "fitting/texture_head.h"

namespace daumier::fitting {

/// The pose and the camera of PortraitView that see a face as a scaled orthographic view does: from 100 m, where a
/// point's distance from the plane of the middle changes its place by 1e-4 of itself a cm.
struct FarCamera {
  PortraitPose pose;
  PictureCamera camera;
};
FarCamera FarCameraOf(const ScaledView& view);

/// A face that was found from landmarks of a picture (FitCodeToLandmarks) as HeadPainter needs it: aligned to them by soft
/// Laplacian deformation within the picture's plane (FineAlignment) [Jung et al. 2022, section 5.4], in even light.
/// face: V x 3, cm; landmarks: 68 x 2, pixels; rows that are not finite are absent, and without any the face is as it is.
/// @throws Error as FineAlignment and ShownHeadOf.
ShownHead ShownHeadOf(const rig::HeadRig& rig, const faces::FaceTemplate& face_template, const geometry::Points& face,
                      const ScaledView& view, const PicturePoints& landmarks);

/// The landmarks of a template among pictured points: 68 x 2, NaN where none of these is a landmark's vertex.
PicturePoints LandmarksAmong(const faces::FaceTemplate& face_template, const std::vector<PicturedPoint>& points);

}  // namespace daumier::fitting
