#pragma once
#include "core/json.h"
#include "faces/face_model.h"
#include "studio/display_head.h"
#include "studio/workspace.h"

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace daumier::studio {

/// Pinned faces of one template, on disk: of each a folder f-NNNN with face.obj, the face (V x 3, cm), face.json
/// {name, shape: its shape document or null}, and thumbnail.png. Thread-safe.
class FaceTray {
 public:
  /// display: what thumbnails show of faces; it outlives the tray.
  FaceTray(const std::filesystem::path& folder, std::shared_ptr<const faces::FaceTemplate> face_template,
           const DisplayHead& display);

  /// [{id, name, shape}, ...] in the order in which they were pinned. Folders that are damaged are left out.
  Json List() const;
  /// Returns the id. shape: null where there is none. @throws Error if the face has other vertices or the disk fails.
  std::string Pin(std::string_view name, const geometry::Points& vertices, const Json& shape);
  /// V x 3, cm. @throws NotFound; Error if the file is damaged.
  geometry::Points Vertices(std::string_view id) const;
  std::filesystem::path FileOf(std::string_view id) const;       ///< @throws NotFound.
  std::filesystem::path ThumbnailOf(std::string_view id) const;  ///< @throws NotFound.
  bool Has(std::string_view id) const;
  std::string NameOf(std::string_view id) const;  ///< @throws NotFound.
  void Remove(std::string_view id);               ///< @throws NotFound.

  static constexpr int kThumbnail = 96;  ///< Pixels a side.

 private:
  void WriteThumbnail(const std::filesystem::path& file, const geometry::Points& vertices) const;

  const std::shared_ptr<const faces::FaceTemplate> face_template_;
  const DisplayHead& display_;
  mutable std::mutex mutex_;
  NumberedFolders folders_;
  mutable std::map<std::string, geometry::Points, std::less<>> read_;  ///< At most kMostRead.
};

}  // namespace daumier::studio
