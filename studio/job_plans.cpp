#include "studio/job_plans.h"

#include "core/child_process.h"
#include "core/error.h"
#include "core/files.h"
#include "geometry/obj.h"
#include "geometry/ply.h"
#include "render/image.h"
#include "render/svg.h"
#include "studio/api.h"
#include "studio/job_options.h"
#include "studio/turntable.h"
#include "systems/portrait/landmark_files.h"
#include "systems/sketch/session_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kFaceFile[] = "face.obj", kHeadFile[] = "head.glb", kStages[] = "stages", kDrawing[] = "drawing.svg",
               kLandmarksFile[] = "landmarks.pts";

std::string TextIn(const Json& body, const char* key) {
  const Json value = body.value(key, Json());
  if (!value.is_string()) throw UsageError(fmt::format("the request has no text '{}'", key));
  return value.get<std::string>();
}

template <class Options>
Options OptionsIn(const Json& body) {
  return ParseOptions<Options>(body.value("options", Json::object()), "options");
}

/// A word of a command line as a shell reads it.
std::string Quoted(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("._-/=,:+%@").find(char(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// A verb of the program with its arguments, as a child.
class VerbRun {
 public:
  explicit VerbRun(std::vector<std::string> words) : words_(std::move(words)) {}

  void Add(const std::string& option, const std::string& value) {
    words_.push_back(option);
    words_.push_back(value);
  }
  void AddFlag(const std::string& flag, bool is_set) {
    if (is_set) words_.push_back(flag);
  }

  std::string CommandLine() const {
    std::vector<std::string> quoted;
    for (const std::string& word : words_) quoted.push_back(Quoted(word));
    return fmt::format("daumier {}", fmt::join(quoted, " "));
  }

  /// Runs in the folder. Returns what it printed. @throws Error with what it wrote of its failure; Cancelled.
  std::string Run(const fs::path& program, const fs::path& folder, const Task& task) const {
    std::vector<std::string> arguments = {program.string()};
    arguments.insert(arguments.end(), words_.begin(), words_.end());
    const auto child = RunChild(arguments, folder / kJobScratch, {.folder = folder, .task = task});
    DAUMIER_CHECK(child.has_value(), "{} is not there any more. Start the studio again", program.string());
    if (child->exit_code == 0) return child->out;
    std::string why = ProgressOf(folder / kJobScratch);  // Its last line.
    for (const std::string_view prefix : {"daumier: ", "error: "})
      if (why.starts_with(prefix)) why = why.substr(prefix.size());
    throw Error(why.empty() ? "the program ended without a result" : why);
  }

 private:
  std::vector<std::string> words_;
};

/// The name of a copy of a file in a job's folder, next to what the job writes there.
std::string NameOfCopy(const fs::path& file) {
  static const std::set<std::string> written = {"head", "stages", "landmarks", "predicted", "face", "drawing"};
  const std::string name = file.filename().string();
  return written.contains(file.stem().string()) ? "input_" + name : name;
}

void CopyInto(const fs::path& folder, const fs::path& file) {
  fs::copy_file(file, folder / NameOfCopy(file), fs::copy_options::overwrite_existing);
}

void WriteFace(const fs::path& file, const geometry::Points& face, const JobMaterial& material) {
  geometry::WriteObj(file, faces::SurfaceMesh(material.shaper.face_template(), face));
}

/// 68 x 2 numbers of a request.
std::vector<float> LandmarksIn(const Json& landmarks) {
  constexpr size_t kCount = 68;
  if (!landmarks.is_array() || landmarks.size() != kCount)
    throw UsageError(fmt::format("'landmarks' is no list of {} points [x, y]", kCount));
  std::vector<float> numbers;
  for (const Json& point : landmarks) {
    if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number())
      throw UsageError("'landmarks' is no list of points [x, y]");
    for (const Json& number : point) numbers.push_back(number.get<float>());
  }
  return numbers;
}

Json PointsOf(const std::vector<float>& numbers) {
  Json points = Json::array();
  for (size_t i = 0; i + 1 < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});
  return points;
}

Json SizeOf(const fs::path& picture) {
  const render::Image image = render::ReadImage(picture);
  return {image.width, image.height};
}

NewJob FindLandmarks(const Json& body, const JobMaterial& material) {
  const fs::path picture = material.uploads.FileOf(TextIn(body, "upload"));
  VerbRun run({"predict", NameOfCopy(picture), "--weights", "landmarks", "--out", "landmarks"});
  return {"landmarks", run.CommandLine(),
          [run, picture, program = material.program](const fs::path& folder, const Task& task) {
            CopyInto(folder, picture);
            run.Run(program, folder, task);
            for (const fs::directory_entry& entry : fs::directory_iterator(folder / "landmarks"))
              if (entry.path().extension() == ".pts")
                return Json{{"landmarks", PointsOf(portrait::ReadLandmarks(entry.path()))}, {"size", SizeOf(picture)}};
            throw Error("no face was found in the picture. Name one in which a face is larger");
          }};
}

void AddHair(VerbRun& run, const std::string& hair, const std::string& colour) {
  if (hair == "none") return;
  run.Add("--hair", hair);
  if (!colour.empty()) run.Add("--hair-colour", colour);
}

/// What a head is made of: files that are copied into its folder, and others that are written there.
struct HeadSources {
  std::vector<fs::path> copied;
  std::function<void(const fs::path& folder)> write;
};

JobWork RunHead(VerbRun run, HeadSources sources, const JobMaterial& material) {
  return [run = std::move(run), sources = std::move(sources), program = material.program](const fs::path& folder,
                                                                                          const Task& task) {
    for (const fs::path& file : sources.copied) CopyInto(folder, file);
    if (sources.write) sources.write(folder);
    return ParseJson(run.Run(program, folder, task), "the result");
  };
}

void AddClip(VerbRun& run, const std::string& clip, const JobMaterial& material, HeadSources& sources) {
  if (clip.empty()) return;
  sources.copied.push_back(material.uploads.FileOf(clip));
  run.Add("--animate", NameOfCopy(sources.copied.back()));
}

/// What rig and avatar have in common.
void AddHeadOptions(VerbRun& run, const HeadJobOptions& options, const JobMaterial& material, HeadSources& sources) {
  run.Add("--names", options.names);
  AddHair(run, options.hair, options.hair_colour);
  run.AddFlag("--vrm", options.vrm);
  run.AddFlag("--print", options.print);
  if (options.triangles > 0) run.Add("--triangles", std::to_string(options.triangles));
  AddClip(run, options.clip, material, sources);
  run.AddFlag("--json", true);
}

/// `daumier rig` of a face.
NewJob RigFace(const geometry::Points& face, const HeadJobOptions& options, const JobMaterial& material,
               const std::string& what) {
  if (options.hair == "auto")
    throw UsageError("hair 'auto' reads the hair of a picture. Name that of a face without one, for example 'short'");
  VerbRun run({"rig", kFaceFile, "--out", kHeadFile});
  HeadSources sources{.copied = {}, .write = [face, &material](const fs::path& folder) {
                        WriteFace(folder / kFaceFile, face, material);
                      }};
  AddHeadOptions(run, options, material, sources);
  std::string command = run.CommandLine();
  return {what, std::move(command), RunHead(std::move(run), std::move(sources), material)};
}

NewJob MakeHead(const Json& body, const JobMaterial& material) {
  return RigFace(FaceOfRequest(body, material), OptionsIn<HeadJobOptions>(body), material, "head");
}

/// Of a session that still is a drawing the drawing is read; of one whose face was changed since, that face is rigged.
NewJob MakeAvatar(const Json& body, const JobMaterial& material) {
  AvatarJobOptions options = OptionsIn<AvatarJobOptions>(body);
  const bool has_landmarks = body.contains("landmarks") && !body.at("landmarks").is_null();
  HeadSources sources;
  std::string input = kDrawing, kind = options.as;
  if (body.contains("session")) {
    const std::string id = TextIn(body, "session");
    if (has_landmarks) throw UsageError("landmarks are those of a picture, and a session has none");
    if (options.head.hair == "auto") options.head.hair = "none";
    const std::vector<render::WeightedStroke> strokes = material.desk.DrawnStrokes(id);
    if (strokes.empty()) return RigFace(FaceOfRequest(body, material), options.head, material, "avatar");
    kind = "drawing";
    sources.write = [strokes](const fs::path& folder) {
      render::WriteWeightedSvg(folder / kDrawing, strokes, {"line"});
    };
  } else {
    const fs::path file = material.uploads.FileOf(TextIn(body, "upload"));
    input = NameOfCopy(file);
    sources.copied.push_back(file);
  }
  VerbRun run({"avatar", input, "--out", kHeadFile, "--as", kind, "--stages", kStages});
  if (options.style != "none") run.Add("--style", options.style);
  if (options.caricature > 0) run.Add("--caricature", fmt::format("{:g}", options.caricature));
  if (has_landmarks) {
    run.Add("--landmarks", kLandmarksFile);
    sources.write = [pts = portrait::LandmarksAsPts(LandmarksIn(body.at("landmarks")))](const fs::path& folder) {
      WriteFileAtomically(folder / kLandmarksFile, pts);
    };
  }
  AddHeadOptions(run, options.head, material, sources);
  std::string command = run.CommandLine();
  return {"avatar", std::move(command), RunHead(std::move(run), std::move(sources), material)};
}

NewJob ReadDrawing(const Json& body, const JobMaterial& material) {
  const fs::path drawing = material.uploads.FileOf(TextIn(body, "upload"));
  VerbRun run({"predict", NameOfCopy(drawing), "--out", "predicted"});
  std::string command = run.CommandLine();
  return {"drawing", std::move(command), [run, drawing, &material](const fs::path& folder, const Task& task) {
            CopyInto(folder, drawing);
            run.Run(material.program, folder, task);
            for (const fs::directory_entry& entry : fs::directory_iterator(folder / "predicted")) {
              if (entry.path().extension() != ".obj") continue;
              const geometry::PolygonMesh mesh = geometry::ReadObj(entry.path());
              const int num_vertices = material.shaper.face_template().num_vertices();
              DAUMIER_CHECK(mesh.vertices.rows() >= num_vertices, "{} is no face of the studio's template",
                            entry.path().filename().string());
              const geometry::Points face = mesh.vertices.topRows(num_vertices);
              return Json{{"face", material.tray.Pin(entry.path().stem().string(), face, Json())}};
            }
            throw Error("no face was found in the drawing");
          }};
}

NewJob WriteMesh(const Json& body, const JobMaterial& material) {
  const std::string format = TextIn(body, "format");
  if (format != "obj" && format != "ply")
    throw UsageError(fmt::format("'format' is '{}', expected obj or ply", format.substr(0, 40)));
  const geometry::TriangleMesh mesh =
      faces::SurfaceMesh(material.shaper.face_template(), FaceOfRequest(body, material));
  return {"mesh", "", [mesh, format](const fs::path& folder, const Task&) {
            const fs::path file = folder / ("face." + format);
            format == "obj" ? geometry::WriteObj(file, mesh) : geometry::WritePly(file, mesh);
            return Json::object();
          }};
}

NewJob MakeTurntable(const Json& body, const JobMaterial& material) {
  const auto options = OptionsIn<TurntableOptions>(body);
  return {"turntable", "",
          [options, face = FaceOfRequest(body, material), &material](const fs::path& folder, const Task& task) {
            WriteTurntable(folder, material.shaper.face_template(), face, options, task);
            return Json::object();
          }};
}

using Plan = NewJob (*)(const Json& body, const JobMaterial& material);

const std::map<std::string, Plan, std::less<>>& Plans() {
  static const std::map<std::string, Plan, std::less<>> plans = {
      {"landmarks", FindLandmarks}, {"avatar", MakeAvatar}, {"head", MakeHead},
      {"drawing", ReadDrawing},     {"mesh", WriteMesh},    {"turntable", MakeTurntable}};
  return plans;
}

/// JSON schema of an options struct.
template <class Options>
Json SchemaOf() {
  Json properties = Json::object();
  for (const FieldInfo& field : DescribeFields<Options>())
    properties[field.key] = {
        {"description", fmt::format("{} Default: {}. {}", field.help, field.value, field.allowed)}};
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

}  // namespace

geometry::Points FaceNamed(const std::string& name, const JobMaterial& material) {
  if (!name.starts_with("s-")) return material.tray.Vertices(name);
  geometry::Points face = material.desk.Face(name);
  if (face.rows() == 0) throw UsageError("the drawing shows no face yet. Draw some lines of one first");
  return face;
}

geometry::Points FaceOfRequest(const Json& body, const JobMaterial& material) {
  if (body.contains("session")) return FaceNamed(TextIn(body, "session"), material);
  if (body.contains("face")) return FaceNamed(TextIn(body, "face"), material);
  if (!body.contains("shape")) throw UsageError("the request names no face: 'session', 'face' or 'shape'");
  return material.shaper.Make(ShapeFromJson(body.at("shape")),
                              [&](const std::string& name) { return FaceNamed(name, material); });
}

NewJob PlanJob(const Json& body, const JobMaterial& material) {
  static const std::set<std::string> keys = {"do",    "upload", "session",   "face",
                                             "shape", "format", "landmarks", "options"};
  for (const auto& [key, value] : body.items())
    if (!keys.contains(key)) {
      const std::string nearest = NearestWord(key, keys);
      throw UsageError(fmt::format("a job has no '{}'{}", key.substr(0, 40),
                                   nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
    }
  const std::string what = TextIn(body, "do");
  const auto plan = Plans().find(what);
  if (plan != Plans().end()) return plan->second(body, material);
  std::vector<std::string> names;
  for (const auto& [name, function] : Plans()) names.push_back(name);
  throw UsageError(fmt::format("there is no job '{}' (expected {})", what.substr(0, 40), fmt::join(names, ", ")));
}

Json JobSchema() {
  Json names = Json::array();
  for (const auto& [name, function] : Plans()) names.push_back(name);
  const Json text = {{"type", "string"}};
  Json properties;
  properties["do"] = {{"enum", std::move(names)}};
  for (const char* key : {"upload", "session", "face", "format"}) properties[key] = text;
  properties["shape"] = ShapeSchema();
  properties["landmarks"] = {{"type", "array"}, {"description", "68 points [x, y] in pixels of the picture"}};
  properties["options"]["oneOf"] = {SchemaOf<AvatarJobOptions>(), SchemaOf<HeadJobOptions>(),
                                    SchemaOf<TurntableOptions>()};
  return {{"type", "object"}, {"properties", std::move(properties)}, {"required", {"do"}}};
}

}  // namespace daumier::studio
