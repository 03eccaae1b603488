#include "studio/head_jobs.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/obj.h"
#include "render/svg.h"
#include "studio/head_files.h"
#include "studio/job_requests.h"
#include "studio/verb_run.h"
#include "systems/portrait/landmark_files.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kFaceFile[] = "face.obj", kHeadFile[] = "head.glb", kStages[] = "stages", kDrawing[] = "drawing.svg",
               kLandmarksFile[] = "landmarks.pts";
/// A head that is made on the way to another file is not a result.
constexpr char kHeadFolder[] = ".head";

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

/// A head that is to be made.
struct HeadPlan {
  const char* what;
  VerbRun run;
  HeadSources sources;
  fs::path program;

  /// Makes the head in `folder`. Returns what the verb printed.
  Json Make(const fs::path& folder, const fs::path& scratch, const Task& task) const {
    for (const fs::path& file : sources.copied) CopyInto(folder, file);
    if (sources.write) sources.write(folder);
    return ParseJson(run.Run(program, folder, scratch, task), "the result");
  }
  NewJob Job() const {
    return {what, run.CommandLine(), "", [plan = *this](const fs::path& folder, const Task& task) {
              return plan.Make(folder, folder / kJobScratch, task);
            }};
  }
};

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
HeadPlan RigFace(const geometry::Points& face, const HeadJobOptions& options, const JobMaterial& material,
                 const char* what) {
  if (options.hair == "auto")
    throw UsageError("hair 'auto' reads the hair of a picture. Name that of a face without one, for example 'short'");
  VerbRun run({"rig", kFaceFile, "--out", kHeadFile});
  HeadSources sources{.copied = {}, .write = [face, &material](const fs::path& folder) {
                        WriteFace(folder / kFaceFile, face, material);
                      }};
  AddHeadOptions(run, options, material, sources);
  return {what, std::move(run), std::move(sources), material.program};
}

/// Of a session that still is a drawing the drawing is read; of one whose face was changed since, that face is rigged.
HeadPlan PlanOfAvatar(const Json& body, const JobMaterial& material) {
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
  return {"avatar", std::move(run), std::move(sources), material.program};
}

/// Options of a head that WriteHeadMesh and RiggedHeadPictures read back.
Json ForReading(Json avatar) {
  Json& options = avatar["options"];
  if (!options.is_object()) options = Json::object();
  options["names"] = "arkit";
  options["vrm"] = options["print"] = false;
  return avatar;
}

/// Makes the avatar, then `finish` of its file in the job's folder.
NewJob AfterAvatar(const char* what, const Json& avatar, const char* note, const JobMaterial& material,
                   std::function<void(const fs::path& head, const fs::path& folder, const Task& task)> finish) {
  HeadPlan plan = PlanOfAvatar(ForReading(avatar), material);
  std::string command = plan.run.CommandLine();
  return {what, std::move(command), note,
          [plan = std::move(plan), finish = std::move(finish)](const fs::path& folder, const Task& task) {
            const fs::path made = folder / kHeadFolder;
            MakeDirectory(made);
            plan.Make(made, folder / kJobScratch, task);
            finish(made / kHeadFile, folder, task);
            return Json::object();
          }};
}

}  // namespace

void WriteFace(const fs::path& file, const geometry::Points& face, const JobMaterial& material) {
  geometry::WriteObj(file, faces::SurfaceMesh(material.shaper.face_template(), face));
}

NewJob PlanHead(const Json& body, const JobMaterial& material) {
  return RigFace(FaceOfRequest(body, material), OptionsIn<HeadJobOptions>(body), material, "head").Job();
}

NewJob PlanAvatar(const Json& body, const JobMaterial& material) {
  return PlanOfAvatar(body, material).Job();
}

NewJob PlanAvatarMesh(const Json& avatar, const std::string& format, const JobMaterial& material) {
  constexpr char kNote[] = "The command makes the head. No verb writes its mesh as OBJ or PLY";
  return AfterAvatar("mesh", avatar, kNote, material,
                     [format](const fs::path& head, const fs::path& folder, const Task&) {
                       WriteHeadMesh(folder / ("avatar." + format), gltf::ReadHead(head));
                     });
}

NewJob PlanAvatarTurntable(const Json& avatar, const TurntableOptions& options, const JobMaterial& material) {
  constexpr char kNote[] = "The command makes the head. No verb draws turntables";
  return AfterAvatar("turntable", avatar, kNote, material,
                     [options](const fs::path& head, const fs::path& folder, const Task& task) {
                       WriteHeadTurntable(folder, gltf::ReadHead(head), options, task);
                     });
}

}  // namespace daumier::studio
