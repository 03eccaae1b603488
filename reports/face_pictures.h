#pragma once
#include "faces/face_database.h"
#include "render/camera.h"
#include "render/image.h"

#include <vector>

/// Single pictures of the faces of a database, for its sheets.
namespace daumier::reports {

inline constexpr int kCell = 190;  ///< Pixels a side of a picture in a sheet.

/// One frame for all pictures of a sheet, so that sizes can be compared. @throws Error as render::FrameOf.
render::Frame FrameOfFaces(const std::vector<geometry::Points>& faces, double margin = 1.08);
render::Frame FrameOfFaces(const faces::FaceDatabase& database, const std::vector<int>& indices);

/// face: V x 3, cm.
render::Image FrontView(const faces::FaceTemplate& face_template, const geometry::Points& face,
                        const render::Frame& frame);
/// The face's own right side.
render::Image SideView(const faces::FaceTemplate& face_template, const geometry::Points& face,
                       const render::Frame& frame);

/// Of a face of a database.
render::Image FrontView(const faces::FaceDatabase& database, int face, const render::Frame& frame);
render::Image SideView(const faces::FaceDatabase& database, int face, const render::Frame& frame);

}  // namespace daumier::reports
