#include "fitting/exaggerated_face.h"

#include "faces/appearance/scalp.h"
#include "fitting/mesh_code.h"

namespace daumier::fitting {
namespace {

constexpr double kNeckReach = 4;  // From its border, cm.

/// Lets the neck's border move as one piece: modes wave there, as no landmark or part of the face is near.
void StillNeck(const faces::FaceTemplate& face, geometry::Points& offsets) {
  const auto border = face.annotation.regions.find("neck_border");
  if (border == face.annotation.regions.end() || border->second.empty()) return;
  const Eigen::RowVector3d mean = offsets(border->second, Eigen::all).colwise().mean();
  const geometry::Points rim = face.neutral(border->second, Eigen::all);
  for (Eigen::Index v = 0; v < offsets.rows(); ++v) {
    const double distance = (rim.rowwise() - face.neutral.row(v)).rowwise().norm().minCoeff();
    const double share = faces::SmoothBetween(0, kNeckReach, distance);
    offsets.row(v) = share * offsets.row(v) + (1 - share) * mean;
  }
}

/// The mean of the offsets and their mirror image: one picture shows too little of a face's sides to separate its
/// asymmetry from errors, which are conspicuous when they are exaggerated.
void MakeEven(const faces::FaceTemplate& face, geometry::Points& offsets) {
  const std::vector<int>& mirror = face.annotation.mirror;
  if (mirror.empty()) return;
  geometry::Points mirrored = offsets(mirror, Eigen::all);
  mirrored.col(0) *= -1;
  offsets = (offsets + mirrored) / 2;
}

}  // namespace

ExaggeratedFace Exaggerate(const CodeModel& model, const geometry::Points& face, double strength,
                           std::span<const int> expression) {
  const MeshCode found = CodeOfMesh(model, face);
  Eigen::VectorXd deviation = found.code;
  for (const int number : expression) deviation[number] = 0;
  const Eigen::VectorXd code = found.code + strength * deviation;
  geometry::Points offsets = model.Vertices(code) - found.vertices;
  MakeEven(model.face_template(), offsets);
  StillNeck(model.face_template(), offsets);
  return {face + offsets, code.norm()};
}

}  // namespace daumier::fitting
