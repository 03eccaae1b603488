#pragma once
#include "core/json.h"
#include "faces/face_database.h"
#include "faces/face_model.h"
#include "reports/report_table.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Errors of predicted meshes against true ones of the same vertex order.
namespace daumier::eval {

/// Mean distances of vertices, mm.
struct MeshScore {
  std::string name;
  double all = 0;      ///< Of all vertices.
  double face = 0;     ///< Of the region `face`.
  double p90 = 0;      ///< 90th percentile of the region `face`.
  double aligned = 0;  ///< Of the region after the similarity that brings it nearest to the truth.
};

/// predicted, truth: V x 3, cm. @throws Error if their numbers of vertices differ, or as RegionFor.
MeshScore ScoreMesh(const std::string& name, const geometry::Points& predicted, const geometry::Points& truth,
                    const faces::FaceTemplate& face_template);

/// The face of a database that NAME.obj shows: "face-00012" is face 12; "person-00003-level-1-smile" the face that
/// faces::FaceDatabase::Describe calls "person 3, level 1, smile"; or a person's name of an imported database, `/` as
/// `-`, which is the neutral face of level 1. Absent if there is none.
std::optional<int> FaceNamed(const faces::FaceDatabase& database, const std::string& name);

/// Scores of NAME.obj (or .ply) in `predictions` against the faces of a database. @throws Error naming file, cause and
/// repair: a name that is no face of it, a wrong number of vertices, no mesh.
std::vector<MeshScore> ScoreMeshes(const std::filesystem::path& predictions, const faces::FaceDatabase& truth);
/// Against the mesh of the same name in a folder; the template has the region and the scale.
std::vector<MeshScore> ScoreMeshes(const std::filesystem::path& predictions, const std::filesystem::path& truth,
                                   const faces::FaceTemplate& face_template);

/// Mean, median and 90th percentile over faces of each number.
reports::ReportTable MeshScoreTable(std::span<const MeshScore> scores);
/// {unit, num_faces, mean_vertex_error_mm, median_vertex_error_mm and p90_vertex_error_mm over faces of the error in the
/// face region, {mean, median, p90} of each other number, faces: [...]}.
Json MeshScoresToJson(std::span<const MeshScore> scores);

}  // namespace daumier::eval
