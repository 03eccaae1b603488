#pragma once
#include "faces/face_database.h"
#include "fitting/code_model.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace daumier::deform {

/// A model that faces are edited by, and where it came from.
struct OpenedModel {
  std::unique_ptr<const fitting::CodeModel> model;
  std::string name;  ///< Of the folder; of the face model "face-ict".
  std::string kind;  ///< "hypernetwork", "conditioning", "linear", "faces" (principal components) or "face model".
  Json sources = Json::array();      ///< Of the faces, for manifests.
  std::string data_hash;             ///< Of the folder.
  std::vector<int> expression = {};  ///< Numbers of the code that are an expression; empty where it is not separate.
  std::filesystem::path faces = {};  ///< Database of the faces it was made of, where one is known: labels come from it.
  /// Of a run the faces of `faces` that it was trained on, and their standardised codes, a row a face.
  std::vector<int> training_faces = {};
  Eigen::MatrixXd training_codes = {};
};

/// Most faces of a folder of which principal components are taken, evenly spaced, and how many components.
inline constexpr int kMostFaces = 500, kNumSymmetric = 96, kNumAsymmetric = 32;

/// Opens, without LibTorch,
/// - a finished run of the task `deform` (kinds hypernetwork, conditioning and linear),
/// - a folder of faces, by principal components of at most kMostFaces of them,
/// - weights of a face model: LinearCaricatures.
/// @throws Error naming the folder and what is expected there; as ReadDeformRunFolder, FaceDatabase and
/// ReadFaceModelWeights.
OpenedModel OpenCodeModel(const std::filesystem::path& folder);

/// The first face model among shipped weights, which is used where no model is named. @throws UsageError if none is
/// there.
std::filesystem::path ShippedModel();

}  // namespace daumier::deform
