#pragma once
#include "faces/face_database.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace daumier::datasets {

/// What is measured on the mesh of a face, by landmarks and free of its size: a length is a share of e, the distance
/// between the outer corners of the eyes (36 and 45), or of h, the height from the chin (8) to the hairline vertex.
/// Heights are along y; m is the middle between 62 and 66.
/// - smile: how far out and up the corners of the mouth are, (|48 54| / 2 + mean height of 48 and 54 over m) / e.
/// - mouth_open: height of 62 over 66, / e; below 0 where exaggeration pushed the lips through each other.
/// - nose_size: the mean of length |27 33|, width |31 35| and depth of 30 before the middle of 31 and 35, / e.
/// - forehead: height of the hairline over the mean of the brows (17..26), / h.
/// - chin: height of the lower lip (57) over the chin, / h.
/// - face_width: |0 16| / h.
std::vector<std::string> MeasuredAttributeNames();
/// In that order. face: V x 3, cm. @throws Error unless e and h are positive.
Eigen::RowVectorXf MeasureAttributes(const faces::FaceTemplate& face_template, const geometry::Points& face);

struct AttributeTable {
  std::vector<std::string> names;                                                ///< A, unique.
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;  ///< Faces of the database x A.
};

/// The measured attributes of each face of a database, and
/// - exaggeration: the mean distance over the region `face` from the same person's regular face with the same expression,
///   as a share of h; 0 for regular faces.
/// - caricature: 1 where the face's level is exaggerated (its gamma is above 0), else 0.
/// - the person's sliders (identity_sliders.h), of MakeHuman its own: "age", "nose/nose-hump-morehump" ...
/// An interpolated face is compared to one that is interpolated like it between the regular faces of both persons; its
/// sliders are mixed by its share of identity, and it is a caricature if its parents are by at least half of that
/// mixture.
/// @throws Error as MeasureAttributes and SlidersOf.
AttributeTable FaceAttributes(const faces::FaceDatabase& database);
/// Their names alone.
std::vector<std::string> FaceAttributeNames(const faces::FaceDatabase& database);

}  // namespace daumier::datasets
