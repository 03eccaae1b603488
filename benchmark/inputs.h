#pragma once
#include "benchmark/definition.h"
#include "benchmark/kit.h"
#include "datasets/read/portrait_database.h"
#include "datasets/read/sketch_database.h"
#include "faces/face_database.h"
#include "render/image.h"

#include <optional>

namespace daumier::benchmark {

/// A drawing of the kit: a picture, and the points that it shows as a label of eval/drawing_labels.h.
struct KitDrawing {
  KitItem item;
  int face = 0;  ///< Of the database.
  render::Image picture;
  Json label;
};
/// The drawings of a person, three styles a face: of face k the level k mod levels and an expression from
/// Stream(seed, "benchmark drawing", ...). Each style draws from a stream of its own.
std::vector<KitDrawing> DrawingsOf(const faces::FaceDatabase& faces, const datasets::SketchDatabase& sketches,
                                   const DrawingsOptions& options, int person, uint64_t seed);

/// A caricature of the kit: its landmarks in a picture, those of the jaw on the silhouette, with noise; and in space.
struct KitCaricature {
  KitItem item;
  int face = 0;
  eval::LandmarkRow pixels;
  geometry::Points places;  ///< 68 x 3, cm, exact: those of the vertices.
};
std::vector<KitCaricature> CaricaturesOf(const faces::FaceDatabase& faces, const CaricaturesOptions& options,
                                         int person, uint64_t seed);

/// The name of a person's k-th face: person-007-b.
std::string FaceName(int person, int face);

}  // namespace daumier::benchmark
