#pragma once
#include "faces/face_database.h"
#include "faces/finished_head.h"
#include "render/camera.h"
#include "render/image.h"

#include <vector>

/// Single pictures of the faces of a database, for its sheets.
namespace daumier::reports {

inline constexpr int kCell = 190;  ///< Pixels a side of a picture in a sheet.

/// One frame for all pictures of a sheet, so that sizes can be compared. @throws Error as render::FrameOf.
render::Frame FrameOfFaces(const std::vector<geometry::Points>& faces, double margin = 1.08);
render::Frame FrameOfFaces(const faces::FaceDatabase& database, const std::vector<int>& indices);

/// face: V x 3, cm, of the head's topology.
render::Image FrontView(const faces::FinishedHead& head, const geometry::Points& face, const render::Frame& frame);
/// The face's own right side.
render::Image SideView(const faces::FinishedHead& head, const geometry::Points& face, const render::Frame& frame);

}  // namespace daumier::reports
