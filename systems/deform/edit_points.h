#pragma once
#include "faces/face_model.h"

#include <string>
#include <vector>

namespace daumier::deform {

/// Vertices that an edit moves, and their displacements.
struct EditHandles {
  std::vector<int> vertices;
  geometry::Points displacements;  ///< A row a vertex, cm.
};

/// "nose", "chin", "cheeks", "ears": the handles of [Jung et al. 2022, figure 11].
const std::vector<std::string>& PresetNames();

/// A preset by `amount_cm`: the tip of the nose (landmark 30) to the front, the chin (8) down, both cheeks (between jaw
/// and nose wing) or the outermost vertices of both ears outwards. A negative amount moves them the other way.
/// @throws UsageError with the names if there is no such preset; Error if the annotation has no ears.
EditHandles PresetHandles(const faces::FaceTemplate& face_template, const std::string& name, double amount_cm);

/// A handle "POINT=dx,dy,dz" in cm: POINT is a landmark (0 .. 67) or vNUMBER, a vertex; "NAME=amount": a preset.
/// @throws UsageError saying what is wrong with the word, and an example.
EditHandles ParseHandle(const faces::FaceTemplate& face_template, const std::string& word);

/// All of them together. @throws UsageError if a vertex comes twice.
EditHandles JoinHandles(const std::vector<EditHandles>& handles);

/// An edit by a label.
struct LabelEdit {
  std::string name;
  double amount = 1;  ///< Deviations of the label.
};

/// "NAME=AMOUNT", or "NAME" for an amount of 1. @throws UsageError if the amount is no finite number.
LabelEdit ParseLabel(const std::string& word);

/// What a local edit of these vertices leaves: the vertices outside of the face parts (faces::FaceParts) that have a
/// tenth of their weight or more at a handle. Parts fade out over some rings;
/// vertices with a share of the part are neither inside nor outside.
/// @throws Error as MakeFaceParts, or if the handles belong to no part.
std::vector<int> OutsideOfPart(const faces::FaceTemplate& face_template, const std::vector<int>& vertices);

}  // namespace daumier::deform
