#pragma once
#include "faces/face_model.h"
#include "studio/hand_drawing.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace daumier::studio {

/// A drawing by hand and the face that it shows.
struct DrawnFace {
  std::string name;      ///< Of its record: "00012".
  std::string checksum;  ///< Of its record.
  std::string face;      ///< What the face is called.
  std::string group;     ///< Drawings of one group show one person.
};

/// What a database of drawings is made of.
struct DrawnFaces {
  const faces::FaceTemplate& face_template;
  Json sources;  ///< Of the faces, for manifests.
  std::vector<DrawnFace> drawings;
  std::function<geometry::Points(int drawing)> vertices;  ///< V x 3, cm.
  std::function<HandDrawing(int drawing)> read;
};

/// Writes folder/faces, a faces::FaceDatabase in which each drawing is a person of one level and one expression, and folder/sketches, a
/// datasets::SketchDatabase of version 3 of it: view 0 is the drawing (OnCanvas), view 1 the exact sketch of the face, by the options of
/// `daumier dataset sketches`. Shards of earlier calls that are of the same drawings are kept, so that one more drawing writes one shard
/// of each. Each file is written atomically, the manifest of sketches last: a folder that a killed program left is repaired by the next
/// call. Without a drawing it writes nothing. @throws Error as datasets::SketchLines and WriteFileAtomically.
void WriteDrawnDatabase(const std::filesystem::path& folder, const DrawnFaces& drawn);

}  // namespace daumier::studio
