#pragma once
#include "faces/face_model.h"
#include "fitting/surface_point_model.h"

#include <string>
#include <vector>

namespace daumier::deform {

/// Points that an edit moves, and their displacements.
struct EditHandles {
  std::vector<int> points;                              ///< Vertices, and V + k: the k-th of `on_surface`.
  geometry::Points displacements;                       ///< A row a point, cm.
  std::vector<fitting::TrianglePoint> on_surface = {};  ///< On triangles of the template.
};

/// "nose", "chin", "cheeks", "ears": the handles of [Jung et al. 2022, figure 11].
const std::vector<std::string>& PresetNames();

/// A preset by `amount_cm`: the tip of the nose (landmark 30) to the front, the chin (8) down, both cheeks (between jaw
/// and nose wing) or the outermost vertices of both ears outwards. A negative amount moves them the other way.
/// @throws UsageError with the names if there is no such preset; Error if the annotation has no ears.
EditHandles PresetHandles(const faces::FaceTemplate& face_template, const std::string& name, double amount_cm);

/// A handle "POINT=dx,dy,dz" in cm: POINT is a landmark (0 .. 67); vNUMBER, a vertex; tNUMBER:b,c, the point
/// (1 - b - c) p0 + b p1 + c p2 of a triangle, or tNUMBER, its middle. "NAME=amount": a preset.
/// @throws UsageError saying what is wrong with the word, and an example.
EditHandles ParseHandle(const faces::FaceTemplate& face_template, const std::string& word);

/// All of them together, of faces of num_vertices. @throws UsageError if a point comes twice.
EditHandles JoinHandles(const std::vector<EditHandles>& handles, int num_vertices);

/// The vertices of each point: itself, or the corners of its triangle, the nearest first.
std::vector<std::vector<int>> VerticesOfHandles(const faces::FaceTemplate& face_template, const EditHandles& handles);

/// An edit by a label.
struct LabelEdit {
  std::string name;
  double amount = 1;  ///< Deviations of the label.
};

/// "NAME=AMOUNT", or "NAME" for an amount of 1. @throws UsageError if the amount is no finite number.
LabelEdit ParseLabel(const std::string& word);

/// What a local edit of these handles leaves: the vertices outside of the face parts (faces::FaceParts) that have a
/// tenth of their weight or more at a vertex of a handle. Parts fade out over some rings;
/// vertices with a share of the part are neither inside nor outside.
/// @throws Error as MakeFaceParts, or if the handles belong to no part.
std::vector<int> OutsideOfPart(const faces::FaceTemplate& face_template, const EditHandles& handles);

}  // namespace daumier::deform
