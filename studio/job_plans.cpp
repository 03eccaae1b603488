#include "studio/job_plans.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/obj.h"
#include "geometry/ply.h"
#include "render/image.h"
#include "studio/api.h"
#include "studio/head_jobs.h"
#include "studio/job_options.h"
#include "studio/job_requests.h"
#include "studio/turntable.h"
#include "studio/verb_run.h"
#include "systems/portrait/landmark_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <set>
#include <utility>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

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
  return {"landmarks", run.CommandLine(), "",
          [run, picture, program = material.program](const fs::path& folder, const Task& task) {
            CopyInto(folder, picture);
            run.Run(program, folder, folder / kJobScratch, task);
            for (const fs::directory_entry& entry : fs::directory_iterator(folder / "landmarks"))
              if (entry.path().extension() == ".pts")
                return Json{{"landmarks", PointsOf(portrait::ReadLandmarks(entry.path()))}, {"size", SizeOf(picture)}};
            throw Error("no face was found in the picture. Name one in which a face is larger");
          }};
}

NewJob ReadDrawing(const Json& body, const JobMaterial& material) {
  const fs::path drawing = material.uploads.FileOf(TextIn(body, "upload"));
  VerbRun run({"predict", NameOfCopy(drawing), "--out", "predicted"});
  std::string command = run.CommandLine();
  return {"drawing", std::move(command), "", [run, drawing, &material](const fs::path& folder, const Task& task) {
            CopyInto(folder, drawing);
            run.Run(material.program, folder, folder / kJobScratch, task);
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

/// How a person makes the same mesh without the studio.
struct MeshCommand {
  std::string command, note;
};

MeshCommand CommandOfMesh(const Json& body, const std::string& format, const JobMaterial& material) {
  const bool is_session = body.contains("session");  // Which FaceOfRequest takes first.
  if (format == "obj" && is_session && material.desk.HasEvents(TextIn(body, "session"))) {
    VerbRun run(
        {"predict", "--session", fmt::format("sessions/{}/session.json", TextIn(body, "session")), "--out", "drawing"});
    return {run.CommandLine(), "In the studio's folder. The mesh is the last one in the folder `drawing`"};
  }
  if (format == "obj" && !is_session && body.contains("face"))
    return {"", fmt::format("No verb is needed: it is faces/{}/face.obj in the studio's folder", TextIn(body, "face"))};
  return {"", "No verb makes it: POST /api/jobs does"};
}

NewJob WriteMesh(const Json& body, const JobMaterial& material) {
  const std::string format = TextIn(body, "format");
  if (format != "obj" && format != "ply")
    throw UsageError(fmt::format("'format' is '{}', expected obj or ply", format.substr(0, 40)));
  if (body.contains("avatar")) return PlanAvatarMesh(body.at("avatar"), format, material);
  const geometry::TriangleMesh mesh =
      faces::SurfaceMesh(material.shaper.face_template(), FaceOfRequest(body, material));
  MeshCommand typed = CommandOfMesh(body, format, material);
  return {"mesh", std::move(typed.command), std::move(typed.note), [mesh, format](const fs::path& folder, const Task&) {
            const fs::path file = folder / ("face." + format);
            format == "obj" ? geometry::WriteObj(file, mesh) : geometry::WritePly(file, mesh);
            return Json::object();
          }};
}

NewJob MakeTurntable(const Json& body, const JobMaterial& material) {
  const auto options = OptionsIn<TurntableOptions>(body);
  if (body.contains("avatar")) return PlanAvatarTurntable(body.at("avatar"), options, material);
  return {"turntable", "", "No verb draws turntables: POST /api/jobs does",
          [options, face = FaceOfRequest(body, material), &material](const fs::path& folder, const Task& task) {
            WriteTurntable(folder, material.display, face, options, task);
            return Json::object();
          }};
}

using Plan = NewJob (*)(const Json& body, const JobMaterial& material);

const std::map<std::string, Plan, std::less<>>& Plans() {
  static const std::map<std::string, Plan, std::less<>> plans = {
      {"landmarks", FindLandmarks}, {"avatar", PlanAvatar}, {"head", PlanHead},
      {"drawing", ReadDrawing},     {"mesh", WriteMesh},    {"turntable", MakeTurntable}};
  return plans;
}

/// @throws UsageError unless it is an object with these keys alone.
void CheckKeys(const Json& object, const std::set<std::string>& keys, const char* what) {
  if (!object.is_object()) throw UsageError(fmt::format("{} is no object", what));
  for (const auto& [key, value] : object.items())
    if (!keys.contains(key)) {
      const std::string nearest = NearestWord(key, keys);
      throw UsageError(fmt::format("{} has no '{}'{}", what, key.substr(0, 40),
                                   nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
    }
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
  static const std::set<std::string> keys = {"do",     "upload",    "session", "face",  "shape",
                                             "format", "landmarks", "options", "avatar"};
  static const std::set<std::string> avatar_keys = {"upload", "session", "landmarks", "options"};
  CheckKeys(body, keys, "a job");
  if (body.contains("avatar")) CheckKeys(body.at("avatar"), avatar_keys, "an avatar");
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
  properties["avatar"] = {{"type", "object"},
                          {"description",
                           "of a mesh or a turntable: the head that a job `avatar` with this upload or session, "
                           "landmarks and options makes"}};
  properties["options"]["oneOf"] = {SchemaOf<AvatarJobOptions>(), SchemaOf<HeadJobOptions>(),
                                    SchemaOf<TurntableOptions>()};
  return {{"type", "object"}, {"properties", std::move(properties)}, {"required", {"do"}}};
}

}  // namespace daumier::studio
