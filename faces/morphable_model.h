#pragma once
#include "faces/face_database.h"
#include "faces/face_model.h"
#include "faces/portrait_coefficients.h"

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace daumier::faces {

/// What an expression weight may be.
enum class ExpressionWeights {
  kUnit,            ///< 0 .. 1: named shapes of which each is a whole movement.
  kStandardNormal,  ///< Statistical modes.
};

/// The 3DMM of portraits [Pan et al. 2024, eq. 1 and 2]: S = mean + A_id a_id + A_exp a_exp, T = mean + A_tex a_tex.
/// Its frame is that of the source moved by -centre, so that the 68 landmarks of the source's neutral face have their
/// mean at the origin.
struct MorphableModel {
  FaceTemplate face_template;                 ///< `neutral` is the mean shape, in this frame.
  Eigen::MatrixXf identity;                   ///< 3V x S, S <= 80: displacement in cm of one standard deviation each.
  Eigen::MatrixXf expression;                 ///< 3V x E, E <= 64, cm.
  std::vector<std::string> expression_names;  ///< E
  ExpressionWeights expression_weights = ExpressionWeights::kUnit;
  Eigen::MatrixXf albedo_mean;                           ///< V x 3, RGB 0 .. 1.
  Eigen::MatrixXf albedo_modes;                          ///< 3V x A, A <= 80: one standard deviation each.
  geometry::Vector3 centre = geometry::Vector3::Zero();  ///< cm, in the source's frame.
  std::string identity_source;                           ///< "shapes" or "components", for manifests.
};

/// Where the colours of a model come from: the matrices as in MorphableModel.
struct AlbedoModes {
  Eigen::MatrixXf mean, modes;
};

/// The model whose identity modes are the first 80 identity shapes of a source, and whose expressions are its
/// expression shapes. @throws Error if an identity control is not Gaussian (its shapes are no standard deviations: use
/// components), there are more than 64 expression shapes, or the colours are of another number of vertices.
MorphableModel ModelOfShapes(const FaceModel& source, const AlbedoModes& albedo);

/// The model whose identity modes are the principal components of given neutral faces, at most 80, those that explain
/// more than 1e-6 of the first one's variance; the mean shape is the mean of these faces. A standard deviation is that
/// over the faces. face(i), i = 0 .. num_faces - 1: 3V coordinates in cm, in the source's frame.
/// @throws Error as ModelOfShapes, and if there are fewer than two faces.
MorphableModel ModelOfFaces(const FaceModel& source, const AlbedoModes& albedo, int num_faces,
                            const std::function<std::span<const float>(int)>& face);

/// The model with given identity modes (3V x S, one standard deviation each, cm) about a mean shape (V x 3, cm, in the
/// source's frame). @throws Error as ModelOfShapes, and if there are more than 80 modes or other vertices.
MorphableModel ModelOfModes(const FaceModel& source, const AlbedoModes& albedo, const geometry::Points& mean,
                            Eigen::MatrixXf modes, const std::string& identity_source);

/// "unit" and "standard normal": of files and manifests. @throws Error for another word.
std::string NameOf(ExpressionWeights weights);
ExpressionWeights ExpressionWeightsNamed(const std::string& name);

/// The neutral faces (expression 0) of these persons, all levels: indices of the database.
std::vector<int> NeutralFaces(const FaceDatabase& database, const std::vector<int>& persons);

/// A face of the model.
struct ColouredFace {
  geometry::Points vertices;  ///< V x 3, cm, posed by nothing.
  Eigen::MatrixXf albedo;     ///< V x 3; may leave 0 .. 1.
};

/// The face of 239 coefficients; light and pose do not matter. @throws Error if there are not 239.
ColouredFace Reconstruct(const MorphableModel& model, std::span<const float> coefficients);

/// Identity weights (80) of the model's face that is nearest to `neutral` (V x 3, in this frame) plus `ridge` times
/// their square: min |mean + A a - s|^2 / V + ridge |a|^2, in cm^2. @throws Error if the number of vertices differs.
Eigen::VectorXf FitIdentity(const MorphableModel& model, const geometry::Points& neutral, double ridge = 1e-4);

/// Writes template.{safetensors,json} and morphable.safetensors (docs/formats.md) in `directory`; returns name ->
/// checksum. WriteMorphableModel adds manifest.json (kind "morphable model").
std::map<std::string, std::string> WriteMorphableFiles(const std::filesystem::path& directory,
                                                       const MorphableModel& model);
void WriteMorphableModel(const std::filesystem::path& directory, const MorphableModel& model);
/// @throws Error naming file and cause: missing, truncated, of a newer version, or shapes that do not belong together.
MorphableModel ReadMorphableModel(const std::filesystem::path& directory);

}  // namespace daumier::faces
