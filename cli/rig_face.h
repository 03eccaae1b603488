#pragma once
#include "faces/face_model.h"
#include "faces/source.h"
#include "geometry/mesh.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::cli {

/// Whether a rig begins with the expression that a face shows.
enum class ShownExpression {
  kRemoved,  ///< Where the prediction states it, as those of portraits do.
  kKept,
};

/// A mesh, or a face of a database: vertices, and polygons where they are known.
struct GivenFace {
  geometry::PolygonMesh mesh;
  std::filesystem::path file;  ///< As messages name it.
  bool is_mesh = true;         ///< Otherwise of a database, whose topology needs no check.
};

/// Reads `face` as ReadFaceToRig does, of whatever topology. @throws UsageError if there is no such face.
GivenFace ReadGivenFace(const std::filesystem::path& face);

/// The vertices of a face of the template, V x 3: those of the mesh, or the first V of a finished head.
/// @throws Error if a vertex is not finite, the polygons are not the topology's, or the size suggests another unit.
geometry::Points CheckedVertices(const GivenFace& given, const faces::FaceTemplate& face_template);

/// Reads a face of the template as ReadGivenFace and CheckedVertices do. @throws Error also if it is of another topology,
/// with `repair`.
geometry::Points ReadFaceOf(const std::filesystem::path& face, const faces::FaceTemplate& face_template,
                            const std::string& repair);

/// Whether a mesh begins with the vertices of a topology and ends with those of other parts. The head of another neutral
/// face than the topology's has another cut of the neck, and so another number of them.
bool IsHeadOf(const GivenFace& given, const faces::FaceTemplate& face_template);

/// Vertices of the finished head that `daumier predict` writes; V where the template has none.
int NumHeadVertices(const faces::FaceTemplate& face_template);

/// A face that is to be rigged.
struct FaceToRig {
  faces::FaceModel model;            ///< Of its topology.
  geometry::Points neutral;          ///< V x 3, cm.
  std::string name;                  ///< Of the file, or of the face in its database.
  std::vector<std::string> remarks;  ///< What was done to it.
  bool states_expression = false;    ///< The prediction does, other than none.
};

/// The face of a mesh, or of a database, with the face model of its topology:
/// - a mesh (.obj, .ply) of the V vertices of a face model's topology, or with as many as its finished head, of which
///   the first V are the face's; as `daumier predict` writes it, also without its extension (predicted/drawing);
/// - FOLDER/NAME where FOLDER holds a database of faces: "face-00012", or "person-00003-level-1-neutral".
/// The face model is that of `source`; without it the first that has the topology, of the shipped ones, then MakeHuman's
/// where it is installed. Nothing for a mesh of another topology.
/// @throws Error naming the topologies that were tried, for a database of none of them; if a vertex is not finite, or if
/// the size suggests another unit.
std::optional<FaceToRig> ReadFaceToRig(const GivenFace& given, const std::optional<faces::SourceOptions>& source,
                                       ShownExpression expression);

/// The model whose expressions heads of other topologies get: that of `source`; without it the first of the shipped ones,
/// then MakeHuman's. @throws UsageError if there is none.
faces::FaceModel ModelForForeignHeads(const std::optional<faces::SourceOptions>& source);

}  // namespace daumier::cli
