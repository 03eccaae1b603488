#pragma once
#include "fitting/code_landmarks.h"

#include <filesystem>
#include <vector>

namespace daumier::fitting {

/// The points of a file of landmarks of a picture (faces::ReadMarkedPoints; absent ones are left out) with the vertices
/// that they show. Without a file of vertices: the 68 as faces::OrderLandmarks finds them, or 81, the 68 and
/// ForeheadLandmarks. With one: a vertex a point, in their order; -1, or an absent one, leaves the point out. Of
/// every set points at vertices of the jaw's landmarks slide on the silhouette.
/// @throws Error naming the file: as ReadMarkedPoints and OrderLandmarks, points with one number, another number of
/// vertices than of points, or a vertex that does not exist.
std::vector<PicturedPoint> ReadPicturedPoints(const faces::FaceTemplate& face_template,
                                              const std::filesystem::path& landmarks,
                                              const std::filesystem::path& vertices = {});

}  // namespace daumier::fitting
