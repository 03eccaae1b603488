#include "systems/portrait/avatar.h"
#include "cli/avatar_drawing.h"
#include "cli/avatar_keys.h"
#include "cli/avatar_stages.h"
#include "cli/head_arguments.h"
#include "cli/head_hair.h"
#include "cli/system_table.h"
#include "cli/verb.h"
#include "cli/weights_model.h"
#include "core/error.h"
#include "core/log.h"
#include "core/output_place.h"
#include "core/stopwatch.h"
#include "core/task.h"
#include "fitting/exaggerated_face.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "systems/deform/open_code_model.h"
#include "systems/picture_content.h"
#include "systems/portrait/picture_hair.h"
#include "systems/portrait/portrait_system.h"
#include "systems/predict_inputs.h"
#include "systems/shipped_weights.h"
#include "systems/sketch/run_folder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct AvatarArguments {
  fs::path input, landmarks, mask, stages;
  std::string weights = "portrait", device = "cpu", kind = "auto", style;
  double caricature = 0;
  HairArguments hair;
  HeadArguments head;
  ConfigArguments config;
  const CLI::App* command = nullptr;  ///< That has the options.
};

/// All that key=value may set.
struct AvatarVerbConfig : portrait::AvatarConfig {
  PaletteOptions palette;

  template <class V>
  void Visit(V&& visit) {
    portrait::AvatarConfig::Visit(visit);
    visit("palette", palette, Table{}, "Colours of the head of a drawing.");
  }
};

AvatarVerbConfig ConfigOf(const AvatarArguments& arguments) {
  Json config = arguments.config.Load();
  const auto set = [&](const char* table, const char* key, const std::string& flag, const std::string& value) {
    if (value.empty()) return;
    if (config.contains(table) && config[table].is_object() && config[table].contains(key))
      throw UsageError(fmt::format("both {} and {}.{} are given: leave one out", flag, table, key));
    config[table][key] = value;
  };
  if (!std::isfinite(arguments.caricature))
    throw UsageError(fmt::format("--caricature {}: expected a number from 0 to 2", arguments.caricature));
  set("face", "landmarks", "--landmarks", arguments.landmarks.string());
  set("face", "mask", "--mask", arguments.mask.string());
  set("avatar", "style", "--style", arguments.style);
  const auto parsed = ParseOptions<AvatarVerbConfig>(config, arguments.config.Where());
  CheckStyleKeys(config, parsed.avatar.style);
  return parsed;
}

/// The picture of a portrait; nothing of a drawing by lines: by --as, its format, or what the picture shows.
std::optional<render::Image> ReadPortrait(const AvatarArguments& arguments) {
  const auto reads = [&](std::string_view task) { return systems::IsInputFile(SystemNamed(task), arguments.input); };
  const bool is_picture = reads(portrait::kPortraitSystem);
  if (arguments.kind == "drawing" || !is_picture) {
    if (arguments.kind != "portrait" && reads(sketch::kSystem)) return std::nullopt;
    if (is_picture) return render::ReadImage(arguments.input);
    throw UsageError(fmt::format(
        "{} is no picture{}", arguments.input.string(),
        reads(sketch::kSystem) ? ", but a drawing: leave out --as portrait" : " and no drawing that is read here"));
  }
  render::Image picture = render::ReadImage(arguments.input);
  if (arguments.kind == "portrait" || systems::LineDrawings().suits(picture) <= 0) return picture;
  log::Info("{} is read as a line drawing, by its content (--as portrait reads it as a portrait)",
            arguments.input.string());
  return std::nullopt;
}

/// --caricature as a change of faces; none without it.
portrait::FaceEdit CaricatureOf(double strength) {
  if (strength == 0) return {};
  return [strength](const geometry::Points& neutral) {
    const deform::OpenedModel opened = deform::OpenCodeModel(deform::ShippedModel());
    fitting::ExaggeratedFace face = fitting::Exaggerate(*opened.model, neutral, strength, opened.expression);
    if (face.radius > opened.model->usual_radius())
      log::Warn(
          "--caricature {}: the face is farther from the mean than the model's own caricatures ({:.1f} of at most "
          "{:.1f}), "
          "and may fold at chin and neck; a smaller share is safer",
          strength, face.radius, opened.model->usual_radius());
    return face.vertices;
  };
}

/// What an avatar was made into, and how.
struct MadeAvatar {
  RigContent content;
  std::vector<AvatarStage> stages;
  Json milliseconds, facts;
};

MadeAvatar OfDrawing(const AvatarArguments& arguments, const AvatarVerbConfig& config) {
  if (!arguments.landmarks.empty() || !arguments.mask.empty() || !arguments.style.empty())
    throw UsageError(fmt::format("--landmarks, --mask and --style are for portraits, and {} is read as a drawing",
                                 arguments.input.string()));
  if (arguments.command->count("--weights") > 0)
    throw UsageError(
        fmt::format("--weights: is of portraits, and {} is read as a drawing. Leave it out", arguments.input.string()));
  CheckDrawingKeys(arguments.config.Load(), arguments.input.string());
  if (arguments.hair.style == "auto")
    throw UsageError("--hair auto reads the hair of portraits; name that of a drawing's head (--hair short)");
  DrawnHead drawn = MakeDrawnHead(arguments.input, config.palette, config.avatar.texture.size,
                                  CaricatureOf(arguments.caricature), ParseDevice(arguments.device));
  if (const auto looks = HairLooks(arguments.hair)) AddHair(*drawn.face_template, drawn.neutral, *looks, drawn.head);
  MadeAvatar made{.content = {.head = std::move(drawn.head), .texture = drawn.texture, .clip = {}},
                  .stages = {{"drawing", drawn.stages.front().image}, {"texture", *drawn.texture}},
                  .milliseconds = std::move(drawn.milliseconds),
                  .facts = std::move(drawn.facts)};
  made.content.stages = std::move(drawn.stages);
  return made;
}

/// The avatar; errors name the picture, and its style.
portrait::Avatar MakeNamed(const AvatarArguments& arguments, const std::string& style,
                           const portrait::AvatarMaker& maker, const render::Image& picture) {
  try {
    return maker.Make(picture, CaricatureOf(arguments.caricature));
  } catch (const Cancelled&) {
    throw;
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw Error(fmt::format(
        "{}: {}{}", arguments.input.string(), error.what(),
        style == "none" ? "" : fmt::format(". This is the picture in the style {}; try it without --style", style)));
  }
}

MadeAvatar OfPortrait(const AvatarArguments& arguments, const AvatarVerbConfig& config, const render::Image& picture) {
  CheckPortraitKeys(arguments.config.Load(), arguments.input.string());
  const Stopwatch watch;
  const std::vector<fs::path> places = systems::WeightsPlaces();
  const fs::path weights = systems::WeightsNamed(arguments.weights, systems::ListWeights(places), places);
  const faces::FaceModel model = FaceModelOfWeights(weights);
  const auto open = [&] {
    return portrait::OpenPortraits(weights, ParseDevice(arguments.device), ToJson(config.face));
  };
  const portrait::AvatarMaker maker(open, model, config.avatar);
  for (const std::string& warning : maker.warnings()) log::Warn("{}", warning);
  MadeAvatar made;
  made.milliseconds["open"] = 1e3 * watch.seconds();
  portrait::Avatar avatar = MakeNamed(arguments, config.avatar.style, maker, picture);
  for (const std::string& warning : avatar.face.warnings) log::Warn("{}: {}", arguments.input.string(), warning);
  if (arguments.hair.style != "none") {
    const auto looks = HairLooks(arguments.hair, portrait::LooksOf(portrait::FindShownHair(
                                                     avatar.picture, *avatar.found.mask, avatar.found.landmarks)));
    AddHair(model.face_template, avatar.neutral, *looks, avatar.head);
    made.facts["hair"] = faces::kHairStyleNames[size_t(looks->hair)];
  }
  made.milliseconds.update({{"style", avatar.times.style},
                            {"face", avatar.times.face},
                            {"targets", avatar.times.targets},
                            {"head", avatar.times.head},
                            {"texture", avatar.times.texture}});
  if (avatar.painted.seen == 0)
    log::Warn(
        "{}: nothing of the face's skin is seen in the picture: are the landmarks and the mask those of this picture?",
        arguments.input.string());
  made.facts["skin"] = {
      {"seen", avatar.painted.seen}, {"mirrored", avatar.painted.mirrored}, {"filled", avatar.painted.filled}};
  made.stages.push_back({"picture", render::ToRgb(picture)});
  if (config.avatar.style != "none") made.stages.push_back({"style", avatar.picture});
  for (const render::SheetCell& cell : avatar.face.pictures)
    if (cell.caption != "input") made.stages.push_back({cell.caption, cell.image});
  made.stages.push_back({"texture", *avatar.texture});
  made.stages.push_back({"texture_sources", avatar.painted.sources});
  made.content = {.head = std::move(avatar.head), .texture = avatar.texture, .clip = {}};
  made.content.stages = std::move(avatar.face.pictures);
  return made;
}

/// @throws UsageError if the folder of stages may not be written, or other files of this command would be in it.
void CheckStages(const fs::path& stages, const RigFiles& files, const std::vector<fs::path>& inputs) {
  CheckReplacedFolder(stages, kStagesKind, inputs);
  const fs::path folder = fs::weakly_canonical(stages);
  for (const auto& file :
       {std::optional(files.head), std::optional(files.sheet), files.compressed, files.vrm, files.frames}) {
    if (!file) continue;
    const fs::path other = fs::weakly_canonical(*file);
    if (other == folder || other.parent_path() == folder)
      throw UsageError(fmt::format("--stages {}: {} is written there as well. Name a folder of its own",
                                   stages.string(), file->string()));
  }
}

void MakeAvatar(const AvatarArguments& arguments) {
  const Stopwatch watch;
  const AvatarVerbConfig config = ConfigOf(arguments);
  const std::vector<fs::path> inputs = {arguments.input, arguments.landmarks, arguments.mask};
  const RigFiles files = CheckedHeadFiles(arguments.head, inputs);
  if (!arguments.stages.empty()) CheckStages(arguments.stages, files, inputs);
  CheckHair(arguments.hair);
  const std::optional<rig::WeightsClip> clip = ReadHeadClip(arguments.head);
  const std::optional<render::Image> portrait = ReadPortrait(arguments);
  MadeAvatar made = portrait ? OfPortrait(arguments, config, *portrait) : OfDrawing(arguments, config);
  const Stopwatch of_files;
  Json result = WriteHeadFiles(arguments.head, files, clip, std::move(made.content));
  made.milliseconds["files"] = 1e3 * of_files.seconds();
  if (!arguments.stages.empty()) {
    WriteAvatarStages(arguments.stages, made.stages, made.milliseconds);
    result["stages"] = arguments.stages.string();
  }
  if (arguments.caricature > 0) result["caricature"] = arguments.caricature;
  result.update(made.facts);
  result["milliseconds"] = std::move(made.milliseconds);
  result["seconds"] = watch.seconds();
  PrintResult(result, arguments.head.as_json);
}

}  // namespace

Verb AvatarVerb() {
  return {
      "avatar", "A portrait or a drawing to a textured head with eyes, teeth and 52 expressions (.glb)",
      [](CLI::App& command) {
        auto arguments = std::make_shared<AvatarArguments>();
        arguments->command = &command;
        command
            .add_option("portrait", arguments->input,
                        "Picture of a face (PNG, JPEG, ...): a cartoon, a caricature or a photograph; of several faces "
                        "that of highest confidence is taken. Or a line drawing, in any format that `predict` reads")
            ->required()
            ->check(CLI::ExistingFile);
        command.add_option("overrides", arguments->config.overrides,
                           "key=value: avatar.texture.size=2048, palette.skin=#c68863 and others, see below");
        command
            .add_option("--as", arguments->kind,
                        "What the picture is read as: auto (by its content), portrait or drawing")
            ->check(CLI::IsMember({"auto", "portrait", "drawing"}))
            ->capture_default_str();
        command
            .add_option("--landmarks", arguments->landmarks,
                        "File of 68 landmarks in pixels of the picture (.pts, .txt, .json), where those that are found "
                        "are wrong")
            ->check(CLI::ExistingFile);
        command
            .add_option("--mask", arguments->mask,
                        "Picture of what each pixel shows, in place of the parsing: grey classes 0 to 7 as `predict "
                        "--weights landmarks` writes them, or black and white, where white is the head")
            ->check(CLI::ExistingFile);
        command.add_option(
            "--style", arguments->style,
            "What the picture is made into first: none, toon (flat colours and larger eyes), or FILE.onnx, an "
            "image-to-image network");
        command
            .add_option("--caricature", arguments->caricature,
                        "Exaggerate the face's deviation from the mean face by this share, by the shipped deformable "
                        "model; the texture is kept")
            ->check(CLI::Range(0.0, 2.0));
        command.add_option("--stages", arguments->stages,
                           "Folder for a picture of each stage and times.json, milliseconds by stage");
        command
            .add_option("--weights", arguments->weights, "Shipped weights of the task `portrait`, by name or folder")
            ->capture_default_str();
        command.add_option("--device", arguments->device, "cpu or cuda")->capture_default_str();
        AddHairArguments(command, HairFrom::kNameOrPicture, arguments->hair);
        AddHeadArguments(command, arguments->head);
        command.footer("Options:\n" + HelpText<AvatarVerbConfig>());
        return [arguments] { MakeAvatar(*arguments); };
      },
      /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
