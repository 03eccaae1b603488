#pragma once
#include "datasets/read/sketch_database.h"
#include "faces/face_database.h"

#include <filesystem>

namespace daumier::eval {

/// Pictures that show what a database holds, each the first by index and never picked ones:
///   identities.jpg   the neutral face of the first persons
///   expressions.jpg  every expression of the first three persons, each at another level
///   levels.jpg       the levels of the first persons, front and side
///   curves.jpg       feature curves and landmarks on the mean face, front and side
///   sketches.jpg     face beside sketch, persons downwards, levels and expressions in turn (only if `sketches` is
///   given)
/// into an existing folder. @throws Error if a picture cannot be written, or the sketches belong to other faces.
void WriteGallery(const faces::FaceDatabase& database, const datasets::SketchDatabase* sketches,
                  const std::filesystem::path& folder);

}  // namespace daumier::eval
