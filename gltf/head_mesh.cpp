#include "gltf/head_mesh.h"

#include "geometry/normals.h"
#include "gltf/head_document.h"
#include "rig/arkit_names.h"
#include "rig/material_colours.h"
#include "rig/weight_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace daumier::gltf {
namespace {

uint8_t LinearFromSrgb(double s) {
  const double linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  return static_cast<uint8_t>(std::lround(255 * linear));
}

std::vector<std::array<uint8_t, 4>> ColoursOf(const std::vector<faces::HeadMaterial>& materials) {
  std::vector<std::array<uint8_t, 4>> colours;
  for (const faces::HeadMaterial material : materials) {
    const Eigen::Vector3d srgb = rig::MaterialColour(material).cast<double>();
    colours.push_back({LinearFromSrgb(srgb.x()), LinearFromSrgb(srgb.y()), LinearFromSrgb(srgb.z()), 255});
  }
  return colours;
}

std::vector<std::array<uint8_t, 4>> ColoursOf(const Eigen::MatrixXf& srgb, const std::vector<int>& rows) {
  std::vector<std::array<uint8_t, 4>> colours;
  const auto linear = [](float value) { return LinearFromSrgb(std::clamp<double>(value, 0, 1)); };
  for (const int row : rows) colours.push_back({linear(srgb(row, 0)), linear(srgb(row, 1)), linear(srgb(row, 2)), 255});
  return colours;
}

/// N x 2 with v downwards, as glTF has it.
FloatRows FlippedUv(const SplitMesh& split) {
  FloatRows uv(split.uv.rows(), 2);
  uv.col(0) = split.uv.col(0).cast<float>();
  uv.col(1) = (1 - split.uv.col(1).array()).cast<float>();
  return uv;
}

/// N x 3, m: target t of the split vertices.
FloatRows Displacements(const rig::MorphTargets& targets, int t, const SplitMesh& split) {
  FloatRows displacements(split.num_vertices(), 3);
  for (int n = 0; n < split.num_vertices(); ++n) {
    const Eigen::Vector3f offset = targets.offsets.col(t).segment<3>(3 * split.source_vertices[size_t(n)]);
    for (int c = 0; c < 3; ++c) {
      const float metres = 0.01f * offset[c];
      displacements(n, c) = std::abs(metres) < kLeastDisplacement ? 0.f : metres;
    }
  }
  return displacements;
}

geometry::TriangleMesh Displaced(const geometry::TriangleMesh& mesh, const rig::MorphTargets& targets, int t) {
  geometry::TriangleMesh displaced = mesh;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    displaced.vertices.row(v) += targets.offsets.col(t).segment<3>(3 * v).cast<double>().transpose();
  }
  return displaced;
}

/// `mesh.primitives[0]`, without targets.
Json Primitive(GlbBuilder& builder, const SplitMesh& split, const FloatRows& positions, const FloatRows& normals,
               int material) {
  Json attributes;
  attributes["POSITION"] = builder.AddAttribute(positions, kPositionExponent, true);
  attributes["NORMAL"] = builder.AddAttribute(normals, kNormalExponent);
  if (split.uv.rows() > 0) attributes["TEXCOORD_0"] = builder.AddAttribute(FlippedUv(split), kUvExponent);
  if (!split.materials.empty()) attributes["COLOR_0"] = builder.AddColors(ColoursOf(split.materials));
  return {{"attributes", attributes},
          {"indices", builder.AddIndices(split.indices, split.num_vertices())},
          {"material", material}};
}

/// rig::WeightLimits as {TARGET: {"base": number, TARGET: factor, ...}} in the file's names, without those that it lacks.
Json LimitsAmong(const std::vector<std::string>& names) {
  const auto spelled = [&](std::string_view target) {
    const auto is_it = [&](const auto& name) { return rig::FindArkitName(name) == rig::FindArkitName(target); };
    return std::find_if(names.begin(), names.end(), is_it);
  };
  Json limits = Json::object();
  for (const rig::WeightLimit& limit : rig::WeightLimits()) {
    const auto target = spelled(limit.target);
    if (target == names.end()) continue;
    limits[*target]["base"] = limit.base;
    for (const auto& [of, factor] : limit.terms)
      if (const auto other = spelled(of); other != names.end()) limits[*target][*other] = factor;
  }
  return limits;
}

}  // namespace

FloatRows PositionsFrom(const geometry::Vector3& pivot, const geometry::Points& vertices, const SplitMesh& split) {
  FloatRows positions(split.num_vertices(), 3);
  for (int n = 0; n < split.num_vertices(); ++n) {
    positions.row(n) =
        Metres(vertices.row(split.source_vertices[size_t(n)]).transpose(), pivot).cast<float>().transpose();
  }
  return positions;
}

FloatRows SplitNormals(const geometry::TriangleMesh& mesh, const SplitMesh& split) {
  const geometry::Points source = geometry::VertexNormals(mesh);
  FloatRows normals(split.num_vertices(), 3);
  for (int n = 0; n < split.num_vertices(); ++n) {
    const Eigen::RowVector3f normal = source.row(split.source_vertices[size_t(n)]).cast<float>();
    normals.row(n) = normal.any() ? normal : Eigen::RowVector3f(0, 0, 1);
  }
  return normals;
}

int AddMesh(GlbBuilder& builder, const char* name, const geometry::TriangleMesh& mesh,
            const std::vector<faces::HeadMaterial>& materials, const geometry::Vector3& pivot,
            const rig::MorphTargets& targets, int material, bool is_coloured, const HeadFileOptions& options) {
  SplitMesh split = SplitAtSeams(mesh, is_coloured ? materials : std::vector<faces::HeadMaterial>());
  if (builder.encoding() == GlbEncoding::kMeshopt) split = OrderForCompression(split);
  const FloatRows normals = SplitNormals(mesh, split);
  Json primitive = Primitive(builder, split, PositionsFrom(pivot, mesh.vertices, split), normals, material);
  std::optional<Json> still;  // Of a mesh of an avatar, whose targets mostly move others: one for all.
  for (int t = 0; t < targets.num_targets(); ++t) {
    const FloatRows displacements = Displacements(targets, t, split);
    const bool is_shared = options.nodes == HeadNodeNames::kReadyPlayerMe && displacements.isZero(0);
    if (is_shared && still) {
      primitive["targets"].push_back(*still);
      continue;
    }
    Json target;
    target["POSITION"] = builder.AddAttribute(displacements, kDisplacementExponent, true);
    if (options.normals) {
      const FloatRows displaced = SplitNormals(Displaced(mesh, targets, t), split);
      target["NORMAL"] = builder.AddAttribute(displaced - normals, kNormalExponent);
    }
    if (is_shared) still = target;
    primitive["targets"].push_back(std::move(target));
  }
  Json item = {{"name", name}};
  if (targets.num_targets() > 0) {
    Json extras = {{"targetNames", targets.names}};
    if (Json limits = LimitsAmong(targets.names); !limits.empty()) extras["weightLimits"] = std::move(limits);
    primitive["extras"] = extras;
    item["weights"] = std::vector<int>(targets.names.size(), 0);
    item["extras"] = extras;
  }
  item["primitives"] = Json::array({primitive});
  return builder.Add("meshes", std::move(item));
}

int AddAttachmentMesh(GlbBuilder& builder, const std::string& name, const rig::HeadAttachment& attachment,
                      const geometry::Vector3& pivot, int material) {
  SplitMesh split = SplitAtSeams(attachment.mesh, {});
  if (builder.encoding() == GlbEncoding::kMeshopt) split = OrderForCompression(split);
  Json primitive = Primitive(builder, split, PositionsFrom(pivot, attachment.mesh.vertices, split),
                             SplitNormals(attachment.mesh, split), material);
  primitive["attributes"]["COLOR_0"] = builder.AddColors(ColoursOf(attachment.colours, split.source_vertices));
  return builder.Add("meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
}

}  // namespace daumier::gltf
