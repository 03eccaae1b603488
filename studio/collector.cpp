#include "studio/collector.h"

#include "core/error.h"
#include "core/files.h"
#include "core/manifest.h"
#include "core/output_place.h"
#include "core/random.h"
#include "render/draw.h"
#include "render/shading.h"
#include "reports/face_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kCollectionKind[] = "collection", kRecords[] = "drawings";
constexpr int kPicture = 640;
constexpr size_t kMostPictures = 8;

bool IsPersonName(const std::string& name) {
  return !name.empty() && name.size() <= 32 &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
}

bool IsRecordName(const std::string& name) {
  return name.size() >= 5 && name.size() <= 9 && std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

int FaceIn(const Json& body) {
  const Json face = body.value("face", Json());
  if (!face.is_number_integer()) throw UsageError("'face' is no whole number");
  return face.get<int>();
}

}  // namespace

void CheckCollection(const fs::path& folder, const std::vector<fs::path>& inputs) {
  CheckOutputFolder(folder, {kCollectionKind}, inputs);
}

Collector::Collector(fs::path folder, const ShownFaces& faces, const CollectorOptions& options,
                     const std::vector<fs::path>& inputs)
    : folder_(std::move(folder)),
      faces_(faces),
      options_(options),
      head_(reports::HeadOf(reports::SurfaceOf(faces.face_template()), faces.face_template().neutral)) {
  if (!IsPersonName(options_.person))
    throw UsageError(fmt::format("'{}' is no name of who draws, expected 1 to 32 letters, digits, '-' and '_'",
                                 options_.person.substr(0, 40)));
  CheckCollection(folder_, inputs);
  if (fs::exists(folder_ / "manifest.json")) {
    const Manifest earlier = ReadManifest(folder_, kCollectionKind);
    if (earlier.details.value("faces_checksum", "") != faces_.checksum())
      throw UsageError(
          fmt::format("{}: a collection of drawings of other faces. Name another folder with --out", folder_.string()));
  }
  if (!fs::exists(folder_ / "manifest.json")) {
    MakeDirectory(folder_);
    WriteDatabase();  // First the manifest: with it the folder is recognised as a collection.
  }
  MakeDirectory(folder_ / kRecords);
  ReadKept();
  FillQueue();
  WriteDatabase();
  AddRoutes();
}

fs::path Collector::RecordOf(const std::string& name) const {
  return folder_ / kRecords / (name + ".json");
}

HandDrawing Collector::Read(const std::string& name) const {
  const fs::path file = RecordOf(name);
  return HandDrawingFromJson(ReadJson(file), file.string());
}

void Collector::ReadKept() {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / kRecords)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".json" || !IsRecordName(name)) continue;
    const HandDrawing drawing = Read(name);
    const std::optional<int> face = faces_.Find(drawing.face);
    DAUMIER_CHECK(face, "{}: there is no face {} among the faces of this collection", entry.path().string(),
                  drawing.face);
    kept_.push_back({{name, Sha256OfFile(entry.path()), drawing.face, faces_.Group(*face)}, *face, drawing.person});
  }
  std::ranges::sort(kept_, {}, [](const Kept& kept) { return std::pair(kept.drawn.name.size(), kept.drawn.name); });
}

void Collector::FillQueue() {
  std::set<int> own, others;
  for (const Kept& kept : kept_) (kept.person == options_.person ? own : others).insert(kept.face);
  std::vector<int> order = Stream(0, "faces that are shown to " + options_.person).Permutation(faces_.size());
  std::erase_if(order, [&](int face) { return own.contains(face); });
  std::stable_partition(order.begin(), order.end(), [&](int face) { return !others.contains(face); });
  const size_t wanted =
      options_.count > 0 ? std::min(size_t(options_.count), size_t(faces_.size())) : size_t(faces_.size());
  order.resize(std::min(order.size(), wanted - std::min(wanted, own.size())));
  queue_.assign(order.begin(), order.end());
}

void Collector::WriteDatabase() const {
  DrawnFaces drawn{.face_template = faces_.face_template(),
                   .sources = faces_.sources(),
                   .drawings = {},
                   .vertices = [this](int drawing) { return faces_.Vertices(kept_[size_t(drawing)].face); },
                   .read = [this](int drawing) { return Read(kept_[size_t(drawing)].drawn.name); }};
  std::set<std::string> persons;
  Manifest manifest;
  for (const Kept& kept : kept_) {
    drawn.drawings.push_back(kept.drawn);
    persons.insert(kept.person);
    manifest.checksums[fmt::format("{}/{}.json", kRecords, kept.drawn.name)] = kept.drawn.checksum;
  }
  manifest.kind = kCollectionKind;
  manifest.verb = "studio --collect";
  manifest.sources = faces_.sources();
  manifest.counts = {{"faces", faces_.size()}, {"drawings", kept_.size()}, {"persons", persons.size()}};
  manifest.details = {{"faces_checksum", faces_.checksum()}};
  WriteManifest(folder_, manifest);
  WriteDrawnDatabase(folder_, drawn);
}

Json Collector::StateNow() const {
  const auto done = std::ranges::count_if(kept_, [&](const Kept& kept) { return kept.person == options_.person; });
  Json face, next;
  if (!queue_.empty()) face = {{"number", queue_.front()}};
  if (queue_.size() > 1) next = {{"number", queue_[1]}};
  return {{"person", options_.person},
          {"done", done},
          {"total", done + std::ptrdiff_t(queue_.size())},
          {"face", face},
          {"next", next}};
}

Json Collector::State() const {
  const std::scoped_lock lock(mutex_);
  return StateNow();
}

std::string Collector::Picture(int face, const std::string& view) {
  if (face < 0 || face >= faces_.size() || (view != "front" && view != "side"))
    throw NotFound(fmt::format("there is no picture {} of face {}", view.substr(0, 40), face));
  const std::scoped_lock lock(picture_mutex_);
  const std::pair key(face, view);
  if (const auto found = pictures_.find(key); found != pictures_.end()) return found->second;
  const geometry::Points vertices = faces_.Vertices(face);
  const render::Frame frame = render::FrameOf(vertices);
  const render::Camera camera = view == "front" ? render::FrontalCamera(frame.centre, frame.half_height, kPicture)
                                                : render::SideCamera(frame.centre, frame.half_height, kPicture);
  const render::Image picture = render::ToRgb(render::RenderMesh(reports::InputOf(head_, vertices), camera));
  if (pictures_.size() >= kMostPictures) pictures_.clear();
  return pictures_[key] = render::EncodeImage(picture, render::ImageFormat::kPng);
}

Json Collector::Skip(int face) {
  const std::scoped_lock lock(mutex_);
  if (!queue_.empty() && queue_.front() == face) {
    queue_.pop_front();
    queue_.push_back(face);
  }
  return StateNow();
}

Json Collector::Add(const Json& body) {
  const std::scoped_lock lock(mutex_);
  const int face = FaceIn(body);
  if (queue_.empty() || queue_.front() != face)
    throw UsageError("this face is not the one that is shown. Reload the page");
  Json record = body;
  record["format_version"] = HandDrawing::kVersion;
  record["person"] = options_.person;
  record["face"] = faces_.id(face);
  record["sheet"] = {HandDrawing::kSheet, HandDrawing::kSheet};
  const HandDrawing drawing = HandDrawingFromJson(record, "the drawing");
  const int last = kept_.empty() ? 0 : std::stoi(kept_.back().drawn.name);
  const std::string name = fmt::format("{:05}", last + 1);
  const std::string bytes = HandDrawingToJson(drawing).dump() + "\n";
  // The record last: without it a drawing is not there.
  WriteSvg(folder_ / kRecords / (name + ".svg"), drawing);
  WriteFileAtomically(RecordOf(name), bytes);
  kept_.push_back({{name, Sha256(bytes), drawing.face, faces_.Group(face)}, face, options_.person});
  queue_.pop_front();
  WriteDatabase();
  return StateNow();
}

void Collector::AddRoutes() {
  const Json body = {{"type", "object"}, {"properties", {{"face", {{"type", "integer"}}}}}};
  routes_.push_back({"GET", "/api/info", "Version, mode and the size of the sheet", [](const ApiRequest&) {
                       return JsonReply({{"version", DAUMIER_VERSION},
                                         {"mode", "collect"},
                                         {"sheet", {HandDrawing::kSheet, HandDrawing::kSheet}}});
                     }});
  routes_.push_back({"GET", "/api/openapi.json", "This description",
                     [this](const ApiRequest&) { return JsonReply(OpenApiOf(routes_)); }});
  routes_.push_back({"GET", "/api/collect", "Who draws, how many drawings are done, and the face that is shown",
                     [this](const ApiRequest&) { return JsonReply(State()); }});
  routes_.push_back({"GET",
                     "/api/collect/faces/{number}/{view}",
                     "Its picture: view is front.png or side.png",
                     [this](const ApiRequest& request) {
                       std::string view = request.path.find("view")->second;
                       if (!view.ends_with(".png")) throw NotFound("pictures are front.png and side.png");
                       view.resize(view.size() - 4);
                       return ApiReply{.type = "image/png", .body = Picture(NumberInPath(request, "number"), view)};
                     },
                     {},
                     "image/png"});
  routes_.push_back({"POST", "/api/collect/skip", "Shows the face again after all others",
                     [this](const ApiRequest& request) { return JsonReply(Skip(FaceIn(BodyOf(request)))); }, body});
  routes_.push_back(
      {"POST", "/api/collect/drawings",
       "Keeps a drawing {face, width, seconds, strokes: [{points, times_ms, pressures}, ...]} and shows the "
       "next face",
       [this](const ApiRequest& request) { return JsonReply(Add(BodyOf(request))); }, body});
}

}  // namespace daumier::studio
