#pragma once
#include "render/image.h"

#include <string_view>

/// What pictures show, by which the weights that read them are chosen.
namespace daumier::systems {

struct PictureContent {
  std::string_view plural = "pictures";  ///< "line drawings": for messages.
  /// Above 0 if a picture shows that, by how much; null: any picture will do.
  double (*suits)(const render::Image&) = nullptr;
};

/// render::LineArtScore above render::kLeastLineArt.
PictureContent LineDrawings();
/// The opposite.
PictureContent Portraits();

}  // namespace daumier::systems
