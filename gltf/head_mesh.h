#pragma once
#include "geometry/mesh.h"
#include "gltf/glb_builder.h"
#include "gltf/head_file.h"
#include "gltf/split_mesh.h"

#include <string>
#include <vector>

namespace daumier::gltf {

/// Displacements below this are 0 in files, m.
inline constexpr float kLeastDisplacement = 1e-6f;

/// N x 3, m: positions of the split vertices from a pivot (cm).
FloatRows PositionsFrom(const geometry::Vector3& pivot, const geometry::Points& vertices, const SplitMesh& split);
/// N x 3, unit length: normals of the unsplit surface (geometry::VertexNormals); +z where no triangle has area.
FloatRows SplitNormals(const geometry::TriangleMesh& mesh, const SplitMesh& split);

/// Adds a mesh of one primitive, about a pivot (cm), with targets if it has any. `material`: index in the document.
/// Without UV or texture, vertices are coloured by `materials`. Returns the mesh.
int AddMesh(GlbBuilder& builder, const char* name, const geometry::TriangleMesh& mesh,
            const std::vector<faces::HeadMaterial>& materials, const geometry::Vector3& pivot,
            const rig::MorphTargets& targets, int material, bool is_coloured, const HeadFileOptions& options);

/// Adds the mesh of an attachment, about a pivot (cm), its vertices coloured. Returns the mesh.
int AddAttachmentMesh(GlbBuilder& builder, const std::string& name, const rig::HeadAttachment& attachment,
                      const geometry::Vector3& pivot, int material);

}  // namespace daumier::gltf
