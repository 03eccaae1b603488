#pragma once
#include "faces/face_model.h"

#include <filesystem>
#include <map>
#include <string>

/// A face model in a folder: that of shipped weights.
///   template.safetensors, template.json   as of a folder of faces (WriteFaceTemplate), exact
///   shapes.safetensors                    `identity` (3V x S) and `expression` (3V x E) by AddScaledShapes;
///                                         `numbering` (V) I32 where the source's numbers are known
///   model.json                            names and kinds of controls, names of shapes, expressions as weights
/// Eyes (faces/eyeball.h) and the albedo basis (MakeAlbedoBasis) are functions of the template and are not stored.
namespace daumier::faces {

inline constexpr const char* kModelText = "model.json";
inline constexpr const char* kModelShapes = "shapes.safetensors";

/// Largest difference of a stored displacement, cm: 0.005 mm.
inline constexpr double kShapeToleranceCm = 5e-4;

/// Returns name -> checksum of the files written. @throws Error as AddScaledShapes.
std::map<std::string, std::string> WriteFaceModel(const std::filesystem::path& directory, const FaceModel& model);

/// @throws Error naming file and cause: missing, damaged, of another version, or numbers that do not belong together.
FaceModel ReadFaceModel(const std::filesystem::path& directory);

/// The model of shipped weights of a face model. `source`: what it has to be a model of ("ict"); empty: anything.
/// @throws Error as ReadWeights and ReadFaceModel, or if it is of another source.
FaceModel ReadFaceModelWeights(const std::filesystem::path& directory, const std::string& source = "");

/// How far the shapes of a model are from those of another one, cm: the largest length of a difference of two
/// displacements of a vertex, at weight 1. @throws Error if they have different numbers of vertices or shapes.
struct ModelDifference {
  double identity_cm = 0, expression_cm = 0;
};
ModelDifference DifferenceOf(const FaceModel& a, const FaceModel& b);

}  // namespace daumier::faces
