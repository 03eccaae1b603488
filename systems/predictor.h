#pragma once
#include "core/json.h"
#include "core/task.h"
#include "faces/face_model.h"
#include "geometry/mesh.h"
#include "render/drawing.h"
#include "render/framing.h"
#include "render/image.h"
#include "render/sheet.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace daumier::systems {

/// Input of a prediction. A system accepts one kind or several.
using Input = std::variant<render::Drawing, render::Image, geometry::PolygonMesh>;

/// A file of a result: NAME + suffix, one of System::result_files.
struct ResultText {
  std::string suffix, text;
};
struct ResultMask {
  std::string suffix;
  render::Image image;
};

/// A face found for an input.
struct FaceResult {
  std::shared_ptr<const faces::FaceTemplate> face_template = {};  ///< Null where the result has no mesh.
  geometry::Points vertices = {};                                 ///< V x 3, cm.
  Eigen::VectorXf identity = {}, expression = {}, code = {};      ///< Of the system's model; empty where it has none.
  geometry::Points landmarks = {};                      ///< 68 x 3, cm, iBUG order; NaN where the template has none.
  std::optional<render::Placement> frame = {};          ///< Of a drawing: p_canvas = scale * p_sheet + shift.
  std::vector<render::Stroke> drawn = {}, curves = {};  ///< On the canvas: the drawing, and the face's feature curves.
  std::vector<render::SheetCell> pictures = {};         ///< Of the sheet, before the views of the mesh.
  std::vector<ResultText> files = {};                   ///< In addition to mesh, sheet and strokes.
  std::vector<ResultMask> masks = {};                   ///< Pictures of numbers, written as PNG.
  std::vector<std::string> warnings = {};
  Json record = Json::object();  ///< Numbers of the prediction, by system.
};

/// A trained run, ready to predict, in memory. The same object may be used by several threads; its parts refer to each
/// other, so that it is neither copied nor moved.
class Predictor {
 public:
  Predictor() = default;
  Predictor(const Predictor&) = delete;
  Predictor& operator=(const Predictor&) = delete;
  virtual ~Predictor() = default;
  /// The inputs that an input is predicted as: itself alone, or those of the faces that it holds, in their order.
  virtual std::vector<Input> Separate(Input input) const { return {std::move(input)}; }
  /// The template of all its faces; null if it makes no meshes, or has several templates.
  virtual std::shared_ptr<const faces::FaceTemplate> face_template() const { return nullptr; }
  /// One face an input, in order. @throws Error if the system does not take an input's kind, or finds no face in it, of
  /// several inputs with the position in the list ("input 2 of 5: ..."); Cancelled if the task is.
  virtual std::vector<FaceResult> Predict(std::span<const Input> inputs, const Task& task = {}) const = 0;
};

}  // namespace daumier::systems
