#include "studio/face_tray.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/obj.h"
#include "render/draw.h"
#include "studio/api.h"

#include <fmt/format.h>

#include <utility>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kFace[] = "face.obj", kRecord[] = "face.json", kThumbnailFile[] = "thumbnail.png";
constexpr size_t kMostRead = 16;

}  // namespace

FaceTray::FaceTray(const fs::path& folder, std::shared_ptr<const faces::FaceTemplate> face_template,
                   const DisplayHead& display)
    : face_template_(std::move(face_template)), display_(display), folders_(folder, 'f') {}

Json FaceTray::List() const {
  const std::scoped_lock lock(mutex_);
  Json list = Json::array();
  for (const std::string& id : folders_.Names()) {
    const fs::path record = folders_.Of(id) / kRecord;
    if (!fs::is_regular_file(record) || !fs::is_regular_file(folders_.Of(id) / kFace)) continue;
    const Json json = TryParseJson(ReadFile(record)).value_or(Json());
    if (!json.is_object() || !json.value("name", Json()).is_string()) continue;
    list.push_back({{"id", id}, {"name", json.at("name")}, {"shape", json.value("shape", Json())}});
  }
  return list;
}

std::string FaceTray::Pin(std::string_view name, const geometry::Points& vertices, const Json& shape) {
  const geometry::TriangleMesh surface = faces::SurfaceMesh(*face_template_, vertices);
  const std::scoped_lock lock(mutex_);
  std::string id = folders_.Add();
  const fs::path folder = folders_.Of(id);
  WriteThumbnail(folder / kThumbnailFile, vertices);
  geometry::WriteObj(folder / kFace, surface);
  const std::string kept = KeptName(name, fmt::format("Face {}", std::stoi(id.substr(2))));
  WriteFileAtomically(folder / kRecord, Json({{"name", kept}, {"shape", shape}}).dump(1) + "\n");
  return id;
}

void FaceTray::WriteThumbnail(const fs::path& file, const geometry::Points& vertices) const {
  render::Frame frame = render::FrameOf(vertices);
  frame.half_height *= 1.02;
  render::Camera camera = render::TurnedCamera(frame.centre, frame.half_height, kThumbnail, 20);
  render::WriteImage(file, render::ToRgb(render::RenderMesh(display_.Picture(vertices), camera)));
}

geometry::Points FaceTray::Vertices(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  if (const auto read = read_.find(id); read != read_.end() && folders_.Has(id)) return read->second;
  const fs::path file = folders_.Of(id) / kFace;
  if (!fs::is_regular_file(file)) throw NotFound(fmt::format("the face {} has no mesh any more", id));
  geometry::Points vertices = geometry::ParseObjVertices(ReadFile(file), file.string(), face_template_->num_vertices());
  if (read_.size() == kMostRead) read_.clear();
  read_.emplace(std::string(id), vertices);
  return vertices;
}

fs::path FaceTray::FileOf(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  return folders_.Of(id) / kFace;
}

fs::path FaceTray::ThumbnailOf(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  fs::path file = folders_.Of(id) / kThumbnailFile;
  if (!fs::is_regular_file(file)) throw NotFound(fmt::format("the face {} has no picture", id));
  return file;
}

bool FaceTray::Has(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  return folders_.Has(id);
}

std::string FaceTray::NameOf(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  const fs::path record = folders_.Of(id) / kRecord;
  if (!fs::is_regular_file(record)) throw NotFound(fmt::format("there is no face '{}'", id));
  const Json json = ReadJson(record);
  const Json name = json.is_object() ? json.value("name", Json()) : Json();
  DAUMIER_CHECK(name.is_string(), "{}: it has no name. Remove the face, or write {{\"name\": ...}}", record.string());
  return name.get<std::string>();
}

void FaceTray::Remove(std::string_view id) {
  const std::scoped_lock lock(mutex_);
  folders_.Remove(id);
  read_.erase(std::string(id));
}

}  // namespace daumier::studio
