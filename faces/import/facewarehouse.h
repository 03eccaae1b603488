#pragma once
#include "faces/import/given_faces.h"

#include <filesystem>
#include <string_view>

namespace daumier::faces {

/// A shape.bs of FaceWarehouse [Cao et al. 2014]: int32 number of shapes without the neutral one (46), int32 number of
/// vertices, int32 number of faces (which disagrees with the meshes and is ignored), then float32 x, y, z of
/// every vertex of every shape, all little-endian; shape 0 is neutral. Further bytes are skipped. Returns the number of
/// shapes including the neutral one.
/// @throws Error naming the file: truncated, not 1 to 1000 shapes without the neutral one, or not `num_vertices`.
int CountShapes(std::string_view bytes, int num_vertices, const std::string& name);
/// V x 3 of one shape, in the file's unit. @throws Error as CountShapes, and if a position is not finite.
geometry::Points ReadShape(std::string_view bytes, int shape, int num_vertices, const std::string& name);

/// Which files of a person are read.
enum class FaceWarehouseSet {
  kBlendshapes,    ///< Tester_k/Blendshape/shape.bs: "neutral", "shape_1" .. "shape_46".
  kTrainingPoses,  ///< Tester_k/TrainingPose/pose_0.obj .. pose_19.obj: "neutral", "pose_1" .. "pose_19".
};

/// The persons Tester_1, Tester_2, ... below `folder`, in order of their number; numbers may be missing. shape.bs has
/// no polygons: they come from `template_mesh`, or, if it is empty, from the first Blendshape/shape_0.obj or
/// TrainingPose/pose_0.obj. A unit counts as 10 cm unless the annotation has another unit.
/// @throws Error naming the file: missing, of another topology, or as ReadShape and ImportGivenFaces.
GivenFaces LoadFaceWarehouse(const std::filesystem::path& folder, const std::filesystem::path& template_mesh,
                             FaceWarehouseSet set, const AnnotationFile& annotation);

}  // namespace daumier::faces
