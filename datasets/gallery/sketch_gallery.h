#pragma once
#include "datasets/read/sketch_database.h"
#include "faces/face_database.h"
#include "render/image.h"

#include <functional>
#include <string>
#include <vector>

namespace daumier::datasets {

/// A picture of a gallery, made when it is drawn.
struct GalleryPicture {
  std::string name;  ///< Of its file.
  std::function<render::Image()> draw;
};

/// Pictures of the sketches of a database, both of which have to outlive them:
///   sketches.jpg      faces next to their sketches
///   line_kinds.jpg    silhouette, features, wrinkles and all of them, and the other views where there are some
///   augmentation.jpg  the same sketches unchanged and augmented at strengths 1/2, 1 and 2
///   contours.jpg      faces next to all their occluding and suggestive contours, from the front and from the side
///   styled.jpg        64 drawings of the faces in styles of people (DrawInStyle), if the sketches have facts
///   styled_labels.jpg the same in the colours of their labels, with points and states
/// @throws Error if the sketches belong to another number of faces.
std::vector<GalleryPicture> SketchPictures(const faces::FaceDatabase& database, const SketchDatabase& sketches);

}  // namespace daumier::datasets
