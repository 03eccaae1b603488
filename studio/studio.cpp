#include "studio/studio.h"

#include "core/error.h"
#include "core/files.h"
#include "core/options.h"
#include "rig/arkit_names.h"
#include "rig/clip_json.h"
#include "systems/sketch/gesture_recogniser.h"
#include "systems/sketch/predictor.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kBytes[] = "application/octet-stream";

struct RandomShapeOptions {
  int seed = 1;
  double spread = 0.5;

  template <class V>
  void Visit(V&& visit) {
    visit("seed", seed, Range{0, 2e9}, "Seed of the random numbers.");
    visit("spread", spread, Range{0.0, 2.0}, "Standard deviation of the values.");
  }
};

std::shared_ptr<const sketch::GestureRecogniser> OpenGestures(const std::optional<fs::path>& weights) {
  if (!weights) return nullptr;
  return std::make_shared<const sketch::GestureRecogniser>(sketch::OpenGestureRecogniser(*weights));
}

std::string TextOr(const Json& body, const char* key, std::string otherwise = "") {
  const Json value = body.value(key, Json());
  if (value.is_null()) return otherwise;
  if (!value.is_string()) throw UsageError(fmt::format("'{}' is no text", key));
  return value.get<std::string>();
}

Json ObjectSchema(const std::vector<std::pair<const char*, const char*>>& texts) {
  Json properties = Json::object();
  for (const auto& [name, meaning] : texts) properties[name] = {{"description", meaning}};
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

const std::string& IdOf(const ApiRequest& request) {
  return request.path.find("id")->second;
}

/// The name of a recorded session as people read it.
std::string TitleOfExample(std::string stem) {
  std::ranges::replace(stem, '_', ' ');
  if (!stem.empty()) stem[0] = char(std::toupper(static_cast<unsigned char>(stem[0])));
  return stem;
}

}  // namespace

Studio::Studio(const fs::path& folder, const StudioWeights& weights, const fs::path& examples, fs::path program)
    : examples_(examples),
      predictor_(sketch::OpenSessionPredictor(weights.sketch, {})),
      display_(predictor_->run().face_template),
      desk_(folder / "sessions", predictor_, OpenGestures(weights.gestures)),
      tray_(folder / "faces", predictor_->face_template(), display_),
      shaper_(weights.face_model),
      uploads_(folder / "uploads"),
      material_{desk_, tray_, shaper_, uploads_, display_, std::move(program)},
      jobs_(folder / "jobs") {
  DAUMIER_CHECK(shaper_.face_template().num_vertices() == predictor_->run().face_template.num_vertices(),
                "{} and {} are of different face templates. Name weights of one", weights.sketch.string(),
                weights.face_model.string());
  AddHead(weights);
  AddSessions();
  AddFaces();
  AddShape();
  AddJobs();
  AddDrive();
}

void Studio::Add(std::string method, std::string path, std::string summary,
                 std::function<ApiReply(const ApiRequest&)> call, Json body, std::string reply) {
  routes_.push_back(
      {std::move(method), std::move(path), std::move(summary), std::move(call), std::move(body), std::move(reply)});
}

ApiReply Studio::VerticesReply(const geometry::Points& face) const {
  if (face.rows() == 0) return {.status = 204, .type = kBytes, .body = ""};
  return BinaryReply(display_.Vertices(face));
}

ApiReply Studio::StateWithFaceReply(const Json& state, const geometry::Points& face) const {
  std::string json = JsonReply(state).body;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto length = uint32_t(json.size());
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);  // Little endian, as the face's numbers (display_head.cpp).
  bytes += json;
  if (face.rows() > 0) bytes += display_.Vertices(face);
  return BinaryReply(std::move(bytes));
}

void Studio::AddHead(const StudioWeights& weights) {
  const Json can = {{"gestures", weights.gestures.has_value()}, {"portraits", weights.has_portraits}};
  Add("GET", "/api/info", "Version, what the weights can do, and the size of a new sheet", [can](const ApiRequest&) {
    return JsonReply({{"version", DAUMIER_VERSION},
                      {"mode", "studio"},
                      {"can", can},
                      {"sheet", {SketchDesk::kSheet, SketchDesk::kSheet}}});
  });
  Add("GET", "/api/openapi.json", "This description",
      [this](const ApiRequest&) { return JsonReply(OpenApiOf(routes_)); });
  Add("GET", "/api/head", "The topology in which faces are shown: sizes, groups of triangles, colours",
      [this](const ApiRequest&) { return JsonReply(display_.description()); });
  Add(
      "GET", "/api/head/triangles", "Its triangles, uint32",
      [this](const ApiRequest&) { return BinaryReply(display_.triangles()); }, {}, kBytes);
}

std::string Studio::BeginSession(const Json& body) {
  NewSession begin{.name = TextOr(body, "name")};
  const std::string example = TextOr(body, "example"), face = TextOr(body, "begin", "blank");
  if (!example.empty()) {
    const fs::path file = examples_ / (example + ".json");
    if (fs::path(example).filename() != example || !fs::is_regular_file(file))
      throw NotFound(fmt::format("there is no example '{}'", example.substr(0, 40)));
    begin.recorded = sketch::ReadSession(file);
    if (begin.name.empty()) begin.name = TitleOfExample(example);
  } else if (!TextOr(body, "upload").empty()) {
    begin.recorded = sketch::ReadSession(uploads_.FileOf(TextOr(body, "upload")));
  } else if (face == "mean") {
    begin.begins_with_mean = true;
  } else if (face != "blank") {
    begin.begin = FaceNamed(face, material_);
  }
  return desk_.Add(begin);
}

void Studio::AddSessions() {
  Add("GET", "/api/examples", "Recorded sessions to begin with", [this](const ApiRequest&) {
    std::vector<std::string> names;
    if (fs::is_directory(examples_))
      for (const fs::directory_entry& entry : fs::directory_iterator(examples_))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    Json list = Json::array();
    for (const std::string& name : names) list.push_back({{"name", name}, {"title", TitleOfExample(name)}});
    return JsonReply({{"examples", std::move(list)}});
  });
  Add("GET", "/api/sessions", "Drawing sessions, the last changed first", [this](const ApiRequest&) {
    return JsonReply({{"sessions", desk_.List()}});
  });
  Add(
      "POST", "/api/sessions", "Begins a session",
      [this](const ApiRequest& request) { return JsonReply(desk_.State(BeginSession(BodyOf(request)))); },
      ObjectSchema({{"name", "its name"},
                    {"begin", "blank, mean, or a face: a pinned one or that of a session"},
                    {"example", "the name of an example instead"},
                    {"upload", "an uploaded recorded session instead"}}));
  Add("GET", "/api/sessions/{id}", "The state of a session",
      [this](const ApiRequest& request) { return JsonReply(desk_.State(IdOf(request))); });
  Add(
      "PATCH", "/api/sessions/{id}", "Renames a session",
      [this](const ApiRequest& request) {
        desk_.Rename(IdOf(request), TextOr(BodyOf(request), "name"));
        return JsonReply(desk_.State(IdOf(request)));
      },
      ObjectSchema({{"name", "its name"}}));
  Add("DELETE", "/api/sessions/{id}", "Removes a session for good", [this](const ApiRequest& request) {
    desk_.Remove(IdOf(request));
    return JsonReply(Json::object());
  });
  Add(
      "POST", "/api/sessions/{id}/events",
      "Does an event of a recorded session (docs/sketching.md). With ?face=1 the reply is bytes: the length of the "
      "state "
      "(uint32), the state (JSON, spaces up to a multiple of 4 bytes), and the face (float32; nothing without one)",
      [this](const ApiRequest& request) {
        if (!request.query.contains("face")) return JsonReply(desk_.Do(IdOf(request), BodyOf(request)));
        const SketchDesk::SeenState seen = desk_.DoAndSee(IdOf(request), BodyOf(request));
        return StateWithFaceReply(seen.state, seen.face);
      },
      ObjectSchema(
          {{"do",
            "draw, erase, follow_up, refine, region, translate, pull, brush, unbrush, roll, gesture, undo or redo"},
           {"points", "[[x, y], ...], pixels of the sheet"}}));
  Add(
      "POST", "/api/sessions/{id}/preview",
      "The face while the pen is down, float32: of the network alone with an unfinished stroke, or of an operation of "
      "refinement, which changes nothing yet",
      [this](const ApiRequest& request) {
        Json body = BodyOf(request);
        if (!body.contains("do")) body["do"] = "draw";
        return VerticesReply(desk_.Preview(IdOf(request), sketch::EventFromJson(body)));
      },
      ObjectSchema({{"do", "draw, if absent; region, translate, pull, brush, unbrush or roll"},
                    {"points", "[[x, y], ...], pixels of the sheet"}}),
      kBytes);
  Add(
      "GET", "/api/sessions/{id}/vertices", "The face, float32; 204 while there is none",
      [this](const ApiRequest& request) { return VerticesReply(desk_.Face(IdOf(request))); }, {}, kBytes);
  Add("GET", "/api/sessions/{id}/camera", "How a view (yaw, pitch in degrees) shows the face on the sheet",
      [this](const ApiRequest& request) {
        const auto matrix =
            desk_.PixelFromCm(IdOf(request), {NumberIn(request, "yaw", 0), NumberIn(request, "pitch", 0)});
        Json rows = Json::array();
        for (Eigen::Index row = 0; row < matrix.rows(); ++row)
          rows.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
        return JsonReply({{"pixel_from_cm", std::move(rows)}});
      });
  Add("GET", "/api/sessions/{id}/session.json", "The recorded session, for `daumier predict --session`",
      [this](const ApiRequest& request) { return ApiReply{.body = ReadFile(desk_.FileOf(IdOf(request)))}; });
}

void Studio::AddFaces() {
  Add("GET", "/api/faces", "Pinned faces", [this](const ApiRequest&) { return JsonReply({{"faces", tray_.List()}}); });
  Add(
      "POST", "/api/faces", "Pins a face",
      [this](const ApiRequest& request) {
        const Json body = BodyOf(request);
        const std::string id = tray_.Pin(TextOr(body, "name"), FaceOf(body), body.value("shape", Json()));
        return JsonReply({{"id", id}, {"name", tray_.NameOf(id)}});
      },
      ObjectSchema({{"name", "its name"}, {"session", "that of a session"}, {"shape", "that of a shape"}}));
  Add(
      "GET", "/api/faces/{id}/vertices", "A pinned face, float32",
      [this](const ApiRequest& request) { return VerticesReply(tray_.Vertices(IdOf(request))); }, {}, kBytes);
  Add(
      "GET", "/api/faces/{id}/thumbnail.png", "Its picture",
      [this](const ApiRequest& request) {
        return ApiReply{.type = "image/png", .body = ReadFile(tray_.ThumbnailOf(IdOf(request)))};
      },
      {}, "image/png");
  Add("DELETE", "/api/faces/{id}", "Removes a pinned face for good", [this](const ApiRequest& request) {
    tray_.Remove(IdOf(request));
    return JsonReply(Json::object());
  });
}

void Studio::AddShape() {
  Add("GET", "/api/shape", "Names and ranges of what shapes a face",
      [this](const ApiRequest&) { return JsonReply(shaper_.Description()); });
  Add(
      "POST", "/api/shape", "The face of a shape document, float32",
      [this](const ApiRequest& request) {
        return VerticesReply(FaceOf({{"shape", BodyOf(request)}}));
      },
      ShapeSchema(), kBytes);
  Add(
      "POST", "/api/shape/random", "Values of controls of a random face",
      [this](const ApiRequest& request) {
        const auto options = ParseOptions<RandomShapeOptions>(BodyOf(request), "the body");
        return JsonReply({{"controls", shaper_.RandomControls(uint64_t(options.seed), options.spread)}});
      },
      ObjectSchema({{"seed", "of the random numbers"}, {"spread", "standard deviation of the values"}}));
}

void Studio::AddJobs() {
  Add(
      "POST", "/api/uploads", "Keeps a file (the body) under the name of the query",
      [this](const ApiRequest& request) {
        const auto name = request.query.find("name");
        return JsonReply(uploads_.Add(name == request.query.end() ? "file" : name->second, request.body));
      },
      ObjectSchema({}));
  Add(
      "GET", "/api/uploads/{id}", "An uploaded file",
      [this](const ApiRequest& request) { return BinaryReply(ReadFile(uploads_.FileOf(IdOf(request)))); }, {}, kBytes);
  Add(
      "POST", "/api/jobs", "Begins a job",
      [this](const ApiRequest& request) {
        return JsonReply(jobs_.Describe(jobs_.Add(PlanJob(BodyOf(request), material_))));
      },
      JobSchema());
  Add("GET", "/api/jobs/{id}", "The state of a job",
      [this](const ApiRequest& request) { return JsonReply(jobs_.Describe(IdOf(request))); });
  Add("DELETE", "/api/jobs/{id}", "Cancels a job", [this](const ApiRequest& request) {
    jobs_.Cancel(IdOf(request));
    return JsonReply(jobs_.Describe(IdOf(request)));
  });
  Add(
      "GET", "/api/jobs/{id}/files/{name...}", "A file of a job that is done",
      [this](const ApiRequest& request) {
        return BinaryReply(ReadFile(jobs_.FileOf(IdOf(request), request.path.find("name")->second)));
      },
      {}, kBytes);
}

void Studio::AddDrive() {
  Add(
      "POST", "/api/drive", "Takes weights from a face tracker: {\"weights\": {...}} or a result of MediaPipe",
      [this](const ApiRequest& request) {
        const rig::Recording recording = rig::ParseClipJson(request.body, "the body");
        DAUMIER_CHECK(recording.num_frames() > 0, "the body has no frame of weights");
        Json weights = Json::object();
        for (Eigen::Index i = 0; i < recording.weights.cols(); ++i)
          weights[recording.names[size_t(i)]] = recording.weights(recording.weights.rows() - 1, i);
        SetDrive(std::move(weights));
        return JsonReply(Json::object());
      },
      ObjectSchema({{"weights", "by the names of ARKit, 0 to 1"}}));
  Add("GET", "/api/drive", "The last weights; 204 while there are none", [this](const ApiRequest&) {
    const std::scoped_lock lock(drive_mutex_);
    if (!drive_) return ApiReply{.status = 204, .body = ""};
    const std::chrono::duration<double, std::milli> age = std::chrono::steady_clock::now() - drive_->when;
    return JsonReply({{"weights", drive_->weights}, {"age_ms", age.count()}});
  });
  Add("GET", "/api/live_link", "Where packets of Live Link Face are received, and how many came; 204 if they are not",
      [this](const ApiRequest&) {
        return live_link_ ? JsonReply(live_link_->Describe()) : ApiReply{.status = 204, .body = ""};
      });
}

void Studio::SetDrive(Json weights) {
  const std::scoped_lock lock(drive_mutex_);
  drive_ = {std::move(weights), std::chrono::steady_clock::now()};
}

void Studio::ReceiveLiveLink(const LiveLinkPlace& place) {
  live_link_ = std::make_unique<LiveLinkReceiver>(place, [this](const Eigen::VectorXf& received) {
    Json weights = Json::object();
    for (int i = 0; i < rig::kNumArkitNames; ++i) weights[std::string(rig::ArkitNames()[size_t(i)])] = received[i];
    SetDrive(std::move(weights));
  });
}

}  // namespace daumier::studio
