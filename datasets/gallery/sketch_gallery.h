#pragma once
#include "datasets/read/sketch_database.h"
#include "faces/face_database.h"

#include <filesystem>

namespace daumier::datasets {

/// Pictures of the sketches of a database, into an existing folder:
///   sketches.jpg      faces next to their sketches
///   line_kinds.jpg    silhouette, features, wrinkles and all of them, and the other views where there are some
///   augmentation.jpg  the same sketches unchanged and augmented at strengths 1/2, 1 and 2
///   contours.jpg      faces next to all their occluding and suggestive contours, from the front and from the side
/// @throws Error if the sketches belong to another number of faces.
void WriteSketchGallery(const faces::FaceDatabase& database, const SketchDatabase& sketches,
                        const std::filesystem::path& folder);

}  // namespace daumier::datasets
