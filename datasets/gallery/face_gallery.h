#pragma once
#include "core/task.h"
#include "datasets/read/sketch_database.h"
#include "faces/face_database.h"

#include <filesystem>
#include <vector>

namespace daumier::datasets {

/// @throws UsageError if `out` is neither empty nor an earlier gallery (CheckOutputFolder), or if a picture in it would
/// be lost that is not the gallery's: one that its manifest does not list, or that has changed.
void CheckGalleryFolder(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs);

/// Pictures that show what a database holds, each the first by index and never picked ones:
///   identities.jpg   the neutral face of the first persons
///   expressions.jpg  every expression of the first three persons, each at another level
///   levels.jpg       the levels of the first persons, front and side
///   caricatures.jpg  where there are levels: 48 exaggerated faces, from the front and from three quarters
///   curves.jpg       feature curves and landmarks on the mean face, front and side
/// into an existing folder, those of SketchPictures if `sketches` are given, and a manifest (kind "gallery"), which is
/// there, with the pictures as kUnfinishedFiles, before the first. @throws Error as SketchPictures, and if a picture
/// cannot be written; Cancelled, between pictures, if the task is.
void WriteGallery(const faces::FaceDatabase& database, const SketchDatabase* sketches,
                  const std::filesystem::path& folder, const Task& task = {});

}  // namespace daumier::datasets
