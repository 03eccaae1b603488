#pragma once
#include "geometry/alignment.h"
#include "rig/expression_targets.h"
#include "rig/head_interior.h"
#include "rig/head_parts.h"
#include "rig/head_rig.h"
#include "rig/head_slits.h"
#include "rig/rest_expression.h"
#include "rig/seam_cut.h"

#include <string>
#include <vector>

namespace daumier::rig {

/// A template on a head of any topology.
struct RegisteredTemplate {
  geometry::Points vertices;  ///< V x 3, cm, in the template's frame.
  geometry::Similarity template_from_head;
};

/// A head of any topology with the 52 expressions, in its own frame.
struct ForeignHead {
  RiggedHead head;  ///< Its mesh has all vertices of the head, in their order, and the triangles but those of eyes.
  std::vector<int> triangles;   ///< Rows of the head's triangles: those of `head.mesh`, then of its eyes.
  std::vector<FaceSide> sides;  ///< Of each vertex of the head.
  HeadSlits slits;              ///< slits.sides: of places.
  RestExpression at_rest;       ///< Of the registered face.
  std::vector<std::string> warnings;
};

/// Makes rigged heads of meshes of any topology. Made once for a face model; const and thread-safe.
class ForeignRig {
 public:
  /// @throws Error as ExpressionTargets, HeadRig and HeadInterior.
  explicit ForeignRig(const faces::FaceModel& model);

  /// The targets of the registered template (ExpressionTargets), carried to the vertices of the head (CarryTargets); lower
  /// teeth and tongue follow the jaw as one piece (HeadInterior::JawMotion), and skin around a ball stays in front of it.
  /// Eyes that are balls turn: without materials of their own, they get iris and pupil where they look.
  /// head: cm, y up, the face to +z. Warnings name what is sealed or not found, and
  /// a mouth that is open or smiles at rest.
  /// @throws Error if nothing of the head lies on the template, or as MakeHeadSurface and CarryTargets.
  ForeignHead On(const geometry::TriangleMesh& head, const RegisteredTemplate& registered) const;

  /// The head with its sealed slits open (OpenSealedSlits), in its own frame: `On` carries expressions to it that open them.
  /// The sources of its triangles are rows of `head`. @throws Error as On.
  OpenedHead Open(const geometry::TriangleMesh& head, const RegisteredTemplate& registered) const;

  const std::vector<std::string>& warnings() const { return targets_.warnings(); }

 private:
  Eigen::MatrixXf OffsetsOfPlaces(const HeadSurface& surface, const HeadParts& parts, const TemplateMatch& match,
                                  const HeadSlits& slits, const geometry::Points& registered,
                                  const MorphTargets& targets) const;

  geometry::Triangles triangles_;
  ExpressionTargets targets_;
  HeadRig head_rig_;
  HeadInterior interior_;
  std::array<int, 68> landmarks_;
  FaceSlits slits_;
  std::vector<FaceSide> sides_;
};

}  // namespace daumier::rig
