#include "systems/picture_content.h"

#include "render/line_art.h"

namespace daumier::systems {

PictureContent LineDrawings() {
  return {"line drawings",
          [](const render::Image& picture) { return render::LineArtScore(picture) - render::kLeastLineArt; }};
}

PictureContent Portraits() {
  return {"portraits",
          [](const render::Image& picture) { return render::kLeastLineArt - render::LineArtScore(picture); }};
}

}  // namespace daumier::systems
