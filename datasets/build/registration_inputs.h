#pragma once
#include "datasets/build/landmark_file.h"
#include "datasets/build/landmark_fit.h"
#include "faces/face_model.h"
#include "geometry/mesh.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::datasets {

/// The meshes to register and the files of their landmarks.
struct MeshInputs {
  std::vector<std::filesystem::path> meshes;  ///< OBJ or PLY, counter-clockwise seen from outside; distinct names.
  /// A LandmarkFile for all meshes, or a folder with one for each: NAME.txt, .json, .pts, .pp, .csv, .tsv, .fcsv,
  /// .mrk.json, .xml, or NAME_picked_points.pp, the first of them that is there.
  std::filesystem::path landmarks;
  std::filesystem::path vertex_map = {};  ///< May be empty; see LandmarkFile.
  faces::ZeroPoints zero = faces::ZeroPoints::kPlaces;
};

/// A mesh to register.
struct LandmarkedMesh {
  std::string name;
  std::filesystem::path landmark_file;
  geometry::TriangleMesh mesh;
  MeshLandmarks landmarks;
  ShiftedNumbers shifted;  ///< LandmarkFile::ShiftedOn.
};

/// The name of an input in messages and files.
std::string NameOf(const std::filesystem::path& mesh);

/// @throws Error naming file and cause: unreadable, no surface, landmarks missing or out of range, or fewer than six.
LandmarkedMesh ReadLandmarkedMesh(const MeshInputs& inputs, int index);

/// Whether the mesh had to be turned.
enum class Winding { kAsStored, kTurned };
/// Turns the triangles of a mesh that is inside out. @throws Error naming the file of the landmarks if they do not fit
/// the template (FaultOfLandmarks).
Winding CheckAgainst(const faces::FaceTemplate& face, double contour_weight, const RegistrationLimits& limits,
                     LandmarkedMesh& target);
/// Exchanges two corners of every triangle.
void TurnTriangles(geometry::TriangleMesh& mesh);

/// Indices of the present ones of the 68 landmarks, and their places, one a row.
std::vector<int> PresentLandmarks(const MeshLandmarks& landmarks);
geometry::Points PlacesOf(const MeshLandmarks& landmarks);

}  // namespace daumier::datasets
