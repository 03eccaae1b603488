#pragma once
#include "faces/bilinear_model.h"
#include "faces/face_model.h"
#include "render/camera.h"
#include "render/strokes.h"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace daumier::fitting {

/// A template's curves as a list of points: curve c has the points offsets[c] .. offsets[c + 1] - 1.
using CurveOffsets = std::vector<int>;

/// Curves of a template as a camera projects them. A closed curve returns to its first vertex.
struct ProjectedCurves {
  std::vector<int> vertices;  ///< Of each curve point, K.
  CurveOffsets offsets;
  render::Camera camera;
  std::vector<int> kinds = {};  ///< One a curve: its place in faces::CurveKinds(). Of SeeCurves; else it may be empty.

  int num_points() const { return static_cast<int>(vertices.size()); }
};

/// The named curves, in the order of their names. @throws Error if the template has no curve of a name.
ProjectedCurves SeeCurves(const faces::FaceTemplate& face_template, const std::vector<std::string>& names,
                          const render::Camera& camera);

/// face: 3V, cm. 2K coordinates in pixels (x0 y0 x1 ...). @throws Error if the face ends before a curve's vertex.
std::vector<float> Project(const ProjectedCurves& curves, std::span<const float> face);

/// One stroke a curve. points: 2K. @throws Error if there are more or fewer.
std::vector<render::Stroke> CurveStrokes(const CurveOffsets& offsets, std::span<const float> points);
/// The curves of a face (3V, cm) in the camera, with their kinds. @throws Error as Project.
std::vector<render::Stroke> SeenStrokes(const ProjectedCurves& curves, std::span<const float> face);

/// What an orthographic camera makes of a bilinear face. It is affine in a vertex, and a vertex is linear in u (x) v,
/// so that the projected curve points are those of a bilinear model of the same factors, moved by a constant:
///   Project(curves, Reconstruct(face model, u, v)) = Reconstruct(model, u, v) + constant.
struct ProjectedModel {
  faces::BilinearModel model;  ///< (Ku * Kv) x 2K, pixels.
  Eigen::VectorXf constant;    ///< 2K, pixels.
};
/// @throws Error if the camera is in perspective or the model ends before a curve's vertex.
ProjectedModel ProjectModel(const ProjectedCurves& curves, const faces::BilinearModel& faces);

}  // namespace daumier::fitting
