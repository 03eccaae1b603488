#include "studio/head_files.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "geometry/ply.h"
#include "render/camera.h"
#include "reports/rigged_head.h"
#include "rig/texture_space.h"
#include "studio/turntable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kTextureFile[] = "texture.png";

float LinearFromSrgb(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

void WriteMeshOf(const fs::path& file, const geometry::TriangleMesh& mesh, const geometry::ObjMaterial& material) {
  if (file.extension() == ".ply") return geometry::WritePly(file, mesh);
  geometry::WriteObj(file, mesh, {{material.name, material.name, mesh.triangles.rows()}}, {material});
}

/// The mean colour of a surface with one a vertex.
std::array<float, 3> ColourOf(const rig::HeadAttachment& attachment) {
  std::array<float, 3> colour{};
  const Eigen::RowVectorXf mean = attachment.colours.colwise().mean();
  for (int c = 0; c < 3; ++c) colour[size_t(c)] = std::clamp(LinearFromSrgb(mean[c]), 0.0f, 1.0f);
  return colour;
}

}  // namespace

void WriteHeadMesh(const fs::path& file, const gltf::HeadInFile& head) {
  const bool is_obj = file.extension() == ".obj";
  WriteMeshOf(file, rig::JoinedMesh(head.head), {"head", {1, 1, 1}, 0});
  if (is_obj && head.texture) {
    render::WriteImage(file.parent_path() / kTextureFile, *head.texture);
    const fs::path library = fs::path(file).replace_extension(".mtl");
    WriteFileAtomically(library, fmt::format("{}map_Kd {}\n", ReadFile(library), kTextureFile));
  }
  for (const rig::HeadAttachment& attachment : head.head.attachments) {
    std::string name = attachment.name;
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const fs::path place =
        file.parent_path() / fmt::format("{}_{}{}", file.stem().string(), name, file.extension().string());
    WriteMeshOf(place, attachment.mesh, {name, ColourOf(attachment), 0});
  }
}

void WriteHeadTurntable(const fs::path& folder, const gltf::HeadInFile& head, const TurntableOptions& options,
                        const Task& task) {
  constexpr double kMargin = 1.2;  // The head turns about its middle, and is deeper than wide.
  const reports::RiggedHeadPictures pictures(head.head, head.texture);
  const rig::HeadPose rest = rig::PoseNamed(head.head.targets.names, {});
  const geometry::Points vertices = rig::PosableHead(head.head).Vertices(rest);
  const render::Frame frame = render::FrameOf(vertices, kMargin);
  const auto draw = [&](double yaw) {
    return pictures.Draw(rest, render::TurnedCamera(frame.centre, frame.half_height, options.size, yaw));
  };
  WriteTurntable(folder, draw, options, task);
}

}  // namespace daumier::studio
