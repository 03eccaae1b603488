#pragma once
#include "faces/face_model.h"
#include "faces/hole_closure.h"
#include "rig/texture_space.h"

#include <vector>

namespace daumier::rig {

/// Triangles with UV of their own, that will be a part of the atlas.
struct ChartPiece {
  TextureChart chart;
  geometry::Triangles triangles;
  geometry::TextureCoordinates uv;
  geometry::Triangles uv_triangles;
  double size;  ///< AtlasPiece::size; that of the face is 1.
};

/// AtlasPiece::size of an eyeball.
inline constexpr double kEyeChartSize = 0.24;

/// A patch within a hole as a disc, its loop the rim.
ChartPiece ClosureChart(const faces::HoleClosure& closure, TextureChart chart, double size);

/// An eyeball as a disc: its front within five sixths of the radius, and of that the iris within the inner half; the
/// rear pole is all of the rim. Vertices are numbered from `first_vertex`.
ChartPiece EyeChart(TextureChart chart, int first_vertex);

/// The skin of a head (without the caps) laid flat as one (UnwrapHead), the face larger than the rest. The sources' own
/// UV is no atlas: that of ICT-FaceKit takes two tiles, in that of MakeHuman the eyes are 0.1 of its side apart.
/// @throws Error as UnwrapHead.
ChartPiece SkinChart(const geometry::TriangleMesh& skin, const faces::Annotation& annotation);

/// The pieces side by side (LayOut), their triangles one after the other in the order of the pieces.
TextureSpace AssembleCharts(const std::vector<ChartPiece>& pieces);

}  // namespace daumier::rig
