#pragma once
#include "eval/drawing_score.h"
#include "faces/face_model.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

/// Folders of predicted meshes, by `daumier predict` or anybody else.
namespace daumier::eval {

/// Meshes of a folder, not of its subfolders: name (without extension) -> file, of .obj and .ply.
/// @throws Error if it is no folder, has no mesh, or two of the same name.
std::map<std::string, std::filesystem::path> MeshesIn(const std::filesystem::path& folder);

/// The first V vertices of a mesh: it has V vertices, or as many as the finished head of the template that `daumier
/// predict` writes. @throws Error naming the file if it has another number, or as faces::ReadMesh.
class TemplateMeshReader {
 public:
  explicit TemplateMeshReader(const faces::FaceTemplate& face_template);
  geometry::Points Read(const std::filesystem::path& file) const;

 private:
  Eigen::Index num_vertices_;
  Eigen::Index num_head_vertices_;  ///< V where the template has no finished head.
};

/// Predictions of labelled drawings: meshes, and details.drawings.NAME.frame of manifest.json, which maps the sheet to
/// the canvas (render::PlacementFromJson), and picture_from_sheet of a rectified one (render::HomographyFromJson).
struct DrawnPredictions {
  std::map<std::string, DrawnPrediction> of_labelled;
  std::vector<std::string> unlabelled;  ///< Names of meshes that have no label.
};

/// @throws Error naming file, cause and repair: no manifest, a mesh of a labelled drawing without a frame, a frame
/// without a mesh, no labelled drawing among the meshes, or as TemplateMeshReader.
DrawnPredictions ReadDrawnPredictions(const std::filesystem::path& folder, std::span<const LabelledDrawing> drawings,
                                      const faces::FaceTemplate& face_template);

}  // namespace daumier::eval
