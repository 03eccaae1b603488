#include "cli/own_look.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "geometry/obj_materials.h"
#include "render/image.h"

#include <algorithm>
#include <memory>
#include <string>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

/// The bytes of a PNG or JPEG file; null with a warning if there is none.
std::shared_ptr<const std::string> PictureBytes(const fs::path& file) {
  try {
    std::string bytes = ReadFile(file);
    const render::Image picture = render::DecodeImage(bytes, file.string());  // Torn ones are refused here.
    const bool is_ready = bytes.starts_with("\x89PNG") || bytes.starts_with("\xFF\xD8\xFF");
    if (!is_ready) bytes = render::EncodeImage(picture, render::ImageFormat::kPng);
    return std::make_shared<const std::string>(std::move(bytes));
  } catch (const Error& error) {
    log::Warn("a picture of the mesh is left out: {}", error.what());
    return nullptr;
  }
}

}  // namespace

OwnLook ReadOwnLook(const GivenFace& given) {
  if (!given.is_mesh || given.file.extension() == ".ply") return {};
  const geometry::UsedMaterials used = geometry::ReadUsedMaterials(given.file);
  if (used.materials.empty()) return {};
  const int num_polygons = given.mesh.num_polygons();
  if (std::ssize(used.of_polygons) != num_polygons) {
    log::Warn("{}: polygons were skipped, so the materials of the others are not known: it gets plain colours",
              given.file.string());
    return {};
  }
  OwnLook look;
  bool lacks_uv = false;
  for (const geometry::UsedMaterial& material : used.materials) {
    rig::OwnMaterial own{material.name, material.diffuse, material.opacity, nullptr};
    if (!material.picture.empty()) {
      lacks_uv = lacks_uv || !given.mesh.has_uv();
      if (given.mesh.has_uv()) own.picture = PictureBytes(material.picture);
    }
    look.materials.push_back(std::move(own));
  }
  if (lacks_uv) log::Warn("{}: materials have pictures, but the mesh has no UV", given.file.string());
  if (std::ranges::find(used.of_polygons, -1) != used.of_polygons.end())
    look.materials.push_back({"none", {}, 1, nullptr});
  for (int p = 0; p < num_polygons; ++p) {
    const int row = used.of_polygons[size_t(p)];
    look.of_triangles.insert(look.of_triangles.end(),
                             size_t(given.mesh.offsets[size_t(p) + 1] - given.mesh.offsets[size_t(p)] - 2),
                             row < 0 ? int(look.materials.size()) - 1 : row);
  }
  return look;
}

}  // namespace daumier::cli
