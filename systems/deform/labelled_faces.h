#pragma once
#include "core/task.h"
#include "faces/face_database.h"
#include "fitting/code_directions.h"
#include "fitting/code_model.h"

#include <filesystem>
#include <string>

namespace daumier::deform {

/// The label of faces of a level above the first.
inline constexpr const char* kCaricatureLabel = "caricature";

/// Faces of a database as codes with labels:
/// - each of its controls, as stored with the face (a level without controls has values of 0; of faces of an expression too),
/// - each expression by its name, of 1, and 0 of neutral faces; other expressions are not labelled,
/// - kCaricatureLabel, 1 of levels above the first.
/// At most `most` faces, evenly spaced. @throws Error if the topology is another one than the model's; Cancelled.
fitting::LabelledCodes LabelledFaces(const fitting::CodeModel& model, const faces::FaceDatabase& database, int most,
                                     const Task& task = {});

/// Labels of a CSV file on faces of a database (WebCariA's attributes in columns): a header `name,LABEL,...`, a row a
/// face: its name (face-00012, person-00003-level-1-smile, or a person's), then 0 or 1, -1 or 1, or any numbers; an empty
/// cell: not labelled.
/// @throws Error naming file and line: no header, a row of another length, no number, a face that is not there.
fitting::LabelledCodes LabelledByFile(const fitting::CodeModel& model, const faces::FaceDatabase& database,
                                      const std::filesystem::path& file, const Task& task = {});

}  // namespace daumier::deform
