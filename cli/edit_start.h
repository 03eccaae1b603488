#pragma once
#include "core/json.h"
#include "fitting/code_landmarks.h"
#include "render/sheet.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::cli {

/// What an edit begins with; at most one of them is given.
struct EditStartArguments {
  std::filesystem::path face;               ///< A mesh, or FOLDER/NAME of a face in a database.
  std::filesystem::path mesh_landmarks;     ///< Of the mesh: it is registered first.
  std::filesystem::path landmarks;          ///< Of a picture.
  std::filesystem::path landmark_vertices;  ///< Those that they show, where they are no usual set.
  std::filesystem::path picture;            ///< For the sheet; without landmarks they are found in it.
  std::filesystem::path code;               ///< edit.json of an earlier edit, or FILE#NAME of one of its faces.
};

/// A face of an edit.
struct EditedFace {
  std::string name;           ///< Of its files.
  std::string caption;        ///< Below its picture.
  Eigen::VectorXd code;       ///< Empty where it is no face of the model.
  geometry::Points vertices;  ///< V x 3, cm.
  Json record = Json::object();
};

/// Where a picture shows a face.
struct PicturedFace {
  std::filesystem::path picture;
  fitting::ScaledView view;
  fitting::PicturePoints landmarks;  ///< 68 x 2, pixels; NaN: absent.
};

/// The face that edits begin with, `start`.
struct EditStart {
  EditedFace face;
  std::vector<render::SheetCell> pictures = {};  ///< Of the sheet, before the faces.
  std::optional<PicturedFace> pictured = {};
};

/// FILE#NAME, or FILE: the face "start".
struct CodePlace {
  std::filesystem::path file;
  std::string face;
};
CodePlace FileOfCode(const std::filesystem::path& code);

/// The mean face, or the one that the arguments name. @throws UsageError if they name several; Error naming file, cause
/// and repair.
EditStart StartOf(const EditStartArguments& arguments, const fitting::CodeModel& model);

/// The face of a mesh or a database as a face of the model.
EditedFace FaceOf(const std::filesystem::path& face, const std::filesystem::path& mesh_landmarks,
                  const fitting::CodeModel& model);

}  // namespace daumier::cli
