#include "studio/study.h"

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "faces/import/mesh_folder.h"
#include "geometry/triangulate.h"
#include "render/draw.h"
#include "render/shading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kFront[] = "front", kTurned[] = "turned", kBestQuestion[] = "best";
constexpr int kResultPicture = 560, kGreatestRating = 5;
constexpr double kTurnDegrees = 40;
constexpr size_t kMostResultPictures = 24, kLeastMethods = 2, kMostMethods = 6;

enum class FileOf { kMesh, kPicture, kOther };

FileOf KindOfFile(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  constexpr std::array kPictures = {".png", ".jpg", ".jpeg", ".webp"};
  if (ending == ".obj" || ending == ".ply") return FileOf::kMesh;
  return std::ranges::count(kPictures, ending) > 0 ? FileOf::kPicture : FileOf::kOther;
}

StudyItem ReadStudyItem(const fs::path& folder) {
  StudyItem item{.name = folder.filename().string(), .source = {}, .results = {}};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const FileOf kind = KindOfFile(entry.path());
    if (!entry.is_regular_file() || kind == FileOf::kOther || IsSystemFile(entry.path().filename())) continue;
    const std::string stem = entry.path().stem().string();
    if (stem == "source" && kind == FileOf::kPicture)
      item.source = entry.path();
    else
      item.results.push_back({stem, entry.path(), kind == FileOf::kMesh});
  }
  std::ranges::sort(item.results, {}, &StudyItem::Result::method);
  const auto twice = std::ranges::adjacent_find(item.results, {}, &StudyItem::Result::method);
  DAUMIER_CHECK(twice == item.results.end(), "{}: two files of the method {}", folder.string(), twice->method);
  DAUMIER_CHECK(!item.source.empty(), "{}: there is no source.png or source.jpg", folder.string());
  DAUMIER_CHECK(item.results.size() >= kLeastMethods && item.results.size() <= kMostMethods,
                "{}: results of {} methods (METHOD.obj, .ply, .png or .jpg), expected {} to {}", folder.string(),
                item.results.size(), kLeastMethods, kMostMethods);
  return item;
}

std::string TypeOf(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("RIFF")) return "image/webp";
  return "image/jpeg";
}

ApiReply PictureReply(std::string bytes) {
  std::string type = TypeOf(bytes);
  return {.type = std::move(type), .body = std::move(bytes)};
}

render::RenderInput PictureOf(geometry::TriangleMesh mesh, const DisplayHead* display) {
  if (display != nullptr && display->IsBareFace(mesh)) return display->Picture(mesh.vertices);
  return {.surface = std::move(mesh)};
}

std::string RenderedMesh(const fs::path& file, const std::string& view, const DisplayHead* display) {
  const render::RenderInput input = PictureOf(geometry::TriangulateMesh(faces::ReadMesh(file)), display);
  const render::Frame frame = render::FrameOf(input.surface.vertices);
  const render::Camera camera =
      render::TurnedCamera(frame.centre, frame.half_height, kResultPicture, view == kTurned ? kTurnDegrees : 0.0);
  return render::EncodeImage(render::ToRgb(render::RenderMesh(input, camera)), render::ImageFormat::kPng);
}

int GreatestParticipant(const std::vector<Vote>& votes) {
  int greatest = 0;
  for (const Vote& vote : votes) {
    int number = 0;
    const std::string& text = vote.participant;
    if (std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc())
      greatest = std::max(greatest, number);
  }
  return greatest;
}

std::vector<Vote> VotesIn(const fs::path& file) {
  return fs::exists(file) ? ReadVotes(file) : std::vector<Vote>();
}

double NumberAt(const Json& json, const char* key) {
  const Json value = json.is_object() ? json.value(key, Json()) : Json();
  if (!value.is_number()) throw UsageError(fmt::format("'{}' is no number", key));
  return value.get<double>();
}

}  // namespace

std::vector<StudyItem> ReadStudyItems(const fs::path& folder) {
  std::vector<fs::path> folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && !IsSystemFile(entry.path().filename())) folders.push_back(entry.path());
  DAUMIER_CHECK(!folders.empty(),
                "{}: there is no folder in it (expected one an item, with source.png and METHOD.obj or .png)",
                folder.string());
  std::ranges::sort(folders);
  std::vector<StudyItem> items;
  for (const fs::path& each : folders) items.push_back(ReadStudyItem(each));
  return items;
}

std::vector<int> OrderOfItems(int participant, int num_items) {
  return Stream(0, "items of a study", uint64_t(participant)).Permutation(num_items);
}

std::vector<int> OrderOfResults(int participant, const StudyItem& item) {
  return Stream(0, "results of the item " + item.name, uint64_t(participant)).Permutation(int(item.results.size()));
}

Study::Study(const fs::path& folder, fs::path votes, VoteKind kind, std::optional<int> participant,
             std::unique_ptr<const DisplayHead> display)
    : items_(ReadStudyItems(folder)), votes_(std::move(votes)), kind_(kind), display_(std::move(display)) {
  if (participant && *participant < 1)
    throw UsageError(fmt::format("the participant's number is {}, expected 1 or more", *participant));
  Begin(participant.value_or(GreatestParticipant(VotesIn(votes_)) + 1));
  AddRoutes();
}

void Study::Begin(int participant) {
  participant_ = participant;
  done_.clear();
  for (const Vote& vote : VotesIn(votes_))
    if (vote.participant == std::to_string(participant)) done_.insert(vote.item);
}

std::vector<int> Study::Left() const {
  std::vector<int> left = OrderOfItems(participant_, int(items_.size()));
  std::erase_if(left, [&](int item) { return done_.contains(items_[size_t(item)].name); });
  return left;
}

Json Study::Describe(int item) const {
  const StudyItem& of = items_[size_t(item)];
  Json results = Json::array();
  for (const int result : OrderOfResults(participant_, of)) {
    Json views = {kFront};
    if (of.results[size_t(result)].is_mesh) views.push_back(kTurned);
    results.push_back({{"views", std::move(views)}});
  }
  return {{"number", item}, {"results", std::move(results)}};
}

std::vector<std::string> Study::Questions() const {
  if (kind_ == VoteKind::kBest) return {kBestQuestion};
  return {"aesthetics", "accuracy", "similarity"};
}

Json Study::StateNow() const {
  const std::vector<int> left = Left();
  const bool is_best = kind_ == VoteKind::kBest;
  return {{"participant", participant_},
          {"done", items_.size() - left.size()},
          {"total", items_.size()},
          {"kind", is_best ? "best" : "ratings"},
          {"questions", Questions()},
          {"greatest", is_best ? 1 : kGreatestRating},
          {"item", left.empty() ? Json() : Describe(left[0])},
          {"next", left.size() < 2 ? Json() : Describe(left[1])}};
}

Json Study::State() {
  const std::scoped_lock lock(mutex_);
  return StateNow();
}

const StudyItem& Study::ItemAt(int item) const {
  if (item < 0 || item >= int(items_.size())) throw NotFound(fmt::format("there is no item {}", item));
  return items_[size_t(item)];
}

std::string Study::SourcePicture(int item) const {
  return ReadFile(ItemAt(item).source);
}

std::string Study::ResultPicture(int item, int place, const std::string& view) {
  const StudyItem& of = ItemAt(item);
  if (place < 1 || place > int(of.results.size())) throw NotFound(fmt::format("item {} has no place {}", item, place));
  int participant = 0;
  {
    const std::scoped_lock lock(mutex_);
    participant = participant_;
  }
  const StudyItem::Result& result = of.results[size_t(OrderOfResults(participant, of)[size_t(place - 1)])];
  if (view != kFront && !(view == kTurned && result.is_mesh))
    throw NotFound(fmt::format("there is no view {}", view.substr(0, 40)));
  if (!result.is_mesh) return ReadFile(result.file);
  const std::scoped_lock lock(picture_mutex_);
  const std::tuple key(item, result.method, view);
  if (const auto found = pictures_.find(key); found != pictures_.end()) return found->second;
  std::string picture = RenderedMesh(result.file, view, display_.get());
  if (pictures_.size() >= kMostResultPictures) pictures_.clear();
  return pictures_[key] = std::move(picture);
}

Json Study::Keep(const Json& body) {
  const std::scoped_lock lock(mutex_);
  const std::vector<int> left = Left();
  if (left.empty() || NumberAt(body, "item") != left[0])
    throw UsageError("this item is not the one that is shown. Reload the page");
  const StudyItem& item = items_[size_t(left[0])];
  const double seconds = NumberAt(body, "seconds");
  if (!(seconds >= 0)) throw UsageError(fmt::format("'seconds' is {}, expected 0 or more", seconds));
  const bool is_best = kind_ == VoteKind::kBest;
  const int count = int(item.results.size()), greatest = is_best ? 1 : kGreatestRating;
  const std::vector<std::string> questions = Questions();

  std::map<std::pair<int, std::string>, double> values;  // By place and question.
  for (const Json& given : body.value("votes", Json::array())) {
    const double place = NumberAt(given, "place"), value = NumberAt(given, "value");
    const Json question = given.value("question", Json());
    if (place != std::floor(place) || place < 1 || place > count)
      throw UsageError(fmt::format("'place' is {}, expected 1 to {}", place, count));
    if (!question.is_string() || std::ranges::count(questions, question.get<std::string>()) == 0)
      throw UsageError(fmt::format("'question' is {}, expected {}", question.dump(), fmt::join(questions, ", ")));
    if (value != std::floor(value) || value < 1 || value > greatest)
      throw UsageError(fmt::format("'value' is {}, expected 1 to {}", value, greatest));
    values[{int(place), question.get<std::string>()}] = value;
  }
  const size_t expected = is_best ? 1 : size_t(count) * questions.size();
  if (values.size() != expected)
    throw UsageError(fmt::format("{} votes, expected {}: every question needs one", values.size(), expected));

  std::vector<Vote> votes;
  const std::vector<int> order = OrderOfResults(participant_, item);
  for (int place = 1; place <= count; ++place)
    for (const std::string& question : questions) {
      const auto found = values.find({place, question});
      votes.push_back({std::to_string(participant_), item.name, item.results[size_t(order[size_t(place - 1)])].method,
                       place, question, found == values.end() ? 0.0 : found->second,
                       std::round(seconds * 1000) / 1000});
    }
  AppendVotes(votes_, votes);
  done_.insert(item.name);
  return StateNow();
}

Json Study::NextParticipant() {
  const std::scoped_lock lock(mutex_);
  Begin(std::max(participant_, GreatestParticipant(VotesIn(votes_))) + 1);
  return StateNow();
}

void Study::AddRoutes() {
  routes_.push_back({"GET", "/api/info", "Version and mode", [](const ApiRequest&) {
                       return JsonReply({{"version", DAUMIER_VERSION}, {"mode", "study"}});
                     }});
  routes_.push_back({"GET", "/api/openapi.json", "This description",
                     [this](const ApiRequest&) { return JsonReply(OpenApiOf(routes_)); }});
  routes_.push_back({"GET", "/api/study", "The participant, the questions, and the item that is shown",
                     [this](const ApiRequest&) { return JsonReply(State()); }});
  routes_.push_back(
      {"GET",
       "/api/study/items/{number}/source",
       "The picture of an item",
       [this](const ApiRequest& request) { return PictureReply(SourcePicture(NumberInPath(request, "number"))); },
       {},
       "image/png"});
  routes_.push_back({"GET",
                     "/api/study/items/{number}/results/{place}/{view}",
                     "The result at a place, from 1: view is front or turned",
                     [this](const ApiRequest& request) {
                       return PictureReply(ResultPicture(NumberInPath(request, "number"),
                                                         NumberInPath(request, "place"),
                                                         request.path.find("view")->second));
                     },
                     {},
                     "image/png"});
  routes_.push_back({"POST",
                     "/api/study/votes",
                     "Keeps the votes {item, seconds, votes: [{place, question, value}, ...]} and shows the next item",
                     [this](const ApiRequest& request) { return JsonReply(Keep(BodyOf(request))); },
                     {{"type", "object"}, {"properties", {{"item", {{"type", "integer"}}}}}}});
  routes_.push_back({"POST",
                     "/api/study/participants",
                     "The next participant begins",
                     [this](const ApiRequest&) { return JsonReply(NextParticipant()); },
                     {{"type", "object"}}});
}

}  // namespace daumier::studio
