#pragma once
#include "benchmark/kit.h"
#include "core/json.h"
#include "eval/surface_score.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// A folder of predictions, by this program or any other.
namespace daumier::benchmark {

/// Of each item that has a prediction, its file: NAME.obj or NAME.ply of a face, NAME.pts, .txt, .csv or .json of landmarks; where
/// there are several of one name the first of these counts.
/// @throws Error naming the folder, the file and the repair: no folder, no prediction at all, a name of no item (with the nearest
/// one, or the split that has it).
std::map<std::string, std::filesystem::path> PredictionFiles(const std::filesystem::path& folder, const Kit& kit,
                                                             KitTask task, KitSplit split);

/// A predicted face.
struct PredictedFace {
  geometry::TriangleMesh mesh;   ///< As it is in the file.
  bool has_kit_topology = true;  ///< Its first V vertices are those of the template.
};

/// Reads the faces of a folder. Without a file landmarks.txt in it their first V vertices are those of the kit's template, which has to
/// show in their triangles: programs that write meshes may renumber them. More vertices may follow, as `daumier predict` writes necks and
/// eyes. With landmarks.txt they have a topology of their own.
class FaceReaderOfFolder {
 public:
  /// @throws Error naming landmarks.txt: not 68 lines of a vertex each, -1 where the topology has no such landmark.
  FaceReaderOfFolder(const std::filesystem::path& folder, const Kit& kit);
  /// @throws Error naming the file and the repair: unreadable, a vertex that is no finite number, fewer than V vertices, fewer than four
  /// of five of the template's triangles.
  PredictedFace Read(const std::filesystem::path& file) const;
  const eval::LandmarkVertices& landmarks() const { return landmarks_; }

 private:
  const faces::FaceTemplate& template_;
  bool has_own_topology_ = false;
  eval::LandmarkVertices landmarks_;
};

/// SHA-256 over names and checksums of the files: names these predictions in results.
std::string PredictionsHash(const std::map<std::string, std::filesystem::path>& files);

}  // namespace daumier::benchmark
