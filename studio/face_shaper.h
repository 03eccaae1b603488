#pragma once
#include "core/json.h"
#include "faces/controls/face_controls.h"
#include "faces/exaggeration.h"
#include "faces/face_model.h"
#include "fitting/mesh_code.h"
#include "rig/expression_targets.h"
#include "studio/shape_document.h"
#include "systems/deform/open_code_model.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace daumier::studio {

/// Finds a face by its name in a document, V x 3, cm. Throws NotFound.
using NamedFace = std::function<geometry::Points(const std::string& name)>;

/// Faces of shape documents. In this order: the base, mixed with `toward` vertex by vertex; the anatomical controls
/// (faces::FaceControls); curvature (faces::Exaggerate); caricature (fitting::Exaggerate); handles, which the deformable model
/// follows without leaving their parts of the face (fitting::EditByHandles); and the weights of expressions times their gains,
/// on the 52 targets of that face (rig::ExpressionTargets). Handles on skull or neck move whatever the model moves with them. Equal documents of equal faces give equal bytes. Thread-safe; the neutral
/// face and the targets of the last document are kept.
class FaceShaper {
 public:
  /// The weights of a face model. @throws Error as deform::OpenCodeModel and rig::ExpressionTargets.
  explicit FaceShaper(const std::filesystem::path& face_model);

  const faces::FaceTemplate& face_template() const { return model_.face_template; }

  /// {controls: [{name, title, group, sides, least, greatest}, ...], expressions: [52 names], expression_groups: {eyes: [...], ...},
  /// caricature: [0, 2], exaggeration: [0, 0.4]}
  Json Description() const;

  /// V x 3, cm. @throws UsageError on an unknown name of a control, an expression or a vertex, suggesting the nearest; as `named`.
  geometry::Points Make(const ShapeDocument& shape, const NamedFace& named);

  /// Values of a random face: of each control but sideways ones spread times a standard normal number, at most 3; both sides equal.
  std::map<std::string, double> RandomControls(uint64_t seed, double spread) const;

 private:
  /// A neutral face, of which the next document may be a small change: while handles are dragged all before them stays.
  struct Made {
    ShapeDocument shape;  ///< Without its expression.
    geometry::Points base, toward, before_handles, face;
  };
  /// What handles of the same vertices need, whatever their moves.
  struct HandleStart {
    geometry::Points face;  ///< Before they move it,
    fitting::MeshCode code;
    std::vector<int> vertices, outside;
  };
  /// What exaggeration of one face needs, whatever its strength.
  struct ExaggerationStart {
    geometry::Points face;
    faces::FaceExaggerator exaggerator;
  };
  /// Targets of the expressions that have been weighted on last_; the columns of others are zero.
  struct MadeTargets {
    Eigen::MatrixXf offsets;
    std::vector<bool> is_made;
  };
  /// mutex_ is locked, as for all below.
  geometry::Points BeforeHandles(const ShapeDocument& shape, const geometry::Points& base,
                                 const geometry::Points& toward);
  geometry::Points Exaggerated(const geometry::Points& face, double gamma);
  geometry::Points WithExpressions(const geometry::Points& face, const Eigen::VectorXf& weights);
  geometry::Points WithHandles(const geometry::Points& face, const std::vector<ShapeHandle>& handles);
  Eigen::VectorXd ValuesOf(const ShapeDocument& shape) const;
  Eigen::VectorXf WeightsOf(const ShapeDocument& shape) const;

  const faces::FaceModel model_;
  const deform::OpenedModel opened_;
  const faces::FaceControls controls_;
  const rig::ExpressionTargets expressions_;
  std::mutex mutex_;
  std::optional<Made> last_;
  std::optional<HandleStart> handle_start_;
  std::optional<ExaggerationStart> exaggeration_start_;
  std::optional<MadeTargets> targets_;  ///< Of last_.
};

}  // namespace daumier::studio
