#pragma once
#include "cli/own_look.h"
#include "core/json.h"
#include "rig/foreign_head.h"

#include <string>

/// `daumier rig --cut`.
namespace daumier::cli {

/// A head of any topology with its sealed slits open.
struct CutHead {
  geometry::TriangleMesh mesh;
  Eigen::Index pocket = 0;  ///< The first triangle of the pocket behind the lips; all that follow are of it.
  Json facts;  ///< Numbers of vertices, and of each slit the length of its cut in mm, or why there is none.
};

/// Opens the slits (ForeignRig::Open), logs what was cut, and gives the triangles their materials: the pocket has one of its
/// own where the head has any. file: in messages.
CutHead CutOpen(const rig::ForeignRig& rig, const rig::RegisteredTemplate& registered, const std::string& file,
                const geometry::TriangleMesh& mesh, OwnLook& look);

/// The pocket's colour on a head without materials of its own.
void ColourPocket(Eigen::Index pocket, rig::ForeignHead& head);

}  // namespace daumier::cli
