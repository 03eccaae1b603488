#include "systems/portrait/avatar.h"
#include "cli/head_arguments.h"
#include "cli/system_table.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "core/weights_folder.h"
#include "faces/face_model_file.h"
#include "render/sheet.h"
#include "systems/picture_content.h"
#include "systems/portrait/portrait_system.h"
#include "systems/predict_inputs.h"
#include "systems/shipped_weights.h"
#include "systems/sketch/run_folder.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct AvatarArguments {
  fs::path portrait;
  std::string weights = "portrait", device = "cpu";
  HeadArguments head;
  ConfigArguments config;
};

faces::FaceModel FaceModelOf(const fs::path& weights, const portrait::PortraitRunFolder& run) {
  const fs::path folder = WeightsNextTo(weights, "face-" + run.model.face_template.source);
  if (!IsWeightsFolder(folder))
    throw Error(fmt::format("{}: there is no face model of '{}' with its expressions (expected shipped weights in {})",
                            weights.string(), run.model.face_template.source, folder.string()));
  return faces::ReadFaceModelWeights(folder, run.model.face_template.source);
}

/// For what is drawn with lines, of which a portrait's network makes a poor face.
std::string HintForDrawings(const fs::path& drawing) {
  return fmt::format(
      "A drawing becomes a head by `daumier predict {} --out DIR` and `daumier rig DIR/{} --out HEAD.glb`",
      drawing.string(), drawing.stem().string() + ".obj");
}

/// @throws UsageError naming a file that only drawings are read from.
void RefuseDrawing(const fs::path& file) {
  const auto reads = [&](std::string_view task) { return systems::IsInputFile(SystemNamed(task), file); };
  if (reads(sketch::kSystem) && !reads(portrait::kPortraitSystem))
    throw UsageError(fmt::format("{} is a drawing, and no picture. {}", file.string(), HintForDrawings(file)));
}

void MakeAvatar(const AvatarArguments& arguments) {
  const Stopwatch watch;
  const auto config = ParseOptions<portrait::AvatarConfig>(arguments.config.Load(), arguments.config.Where());
  const RigFiles files = CheckedHeadFiles(arguments.head, {arguments.portrait});
  const std::optional<rig::WeightsClip> clip = ReadHeadClip(arguments.head);
  RefuseDrawing(arguments.portrait);
  const render::Image picture = render::ReadImage(arguments.portrait);
  if (systems::LineDrawings().suits(picture) > 0)
    log::Warn("{} looks like a line drawing. {}", arguments.portrait.string(), HintForDrawings(arguments.portrait));
  const std::vector<fs::path> places = systems::WeightsPlaces();
  const fs::path weights = systems::WeightsNamed(arguments.weights, systems::ListWeights(places), places);
  auto predictor = portrait::OpenPortraits(weights, ParseDevice(arguments.device), ToJson(config.face));
  const faces::FaceModel model = FaceModelOf(weights, predictor->run());
  const portrait::AvatarMaker maker(std::move(predictor), model, config.avatar);
  for (const std::string& warning : maker.warnings()) log::Warn("{}", warning);
  portrait::Avatar avatar = maker.Make(picture);
  for (const std::string& warning : avatar.face.warnings) log::Warn("{}: {}", arguments.portrait.string(), warning);
  Json result = WriteHeadFiles(
      arguments.head, files, clip,
      {.head = std::move(avatar.head), .texture = avatar.texture, .clip = {}, .stages = avatar.face.pictures});
  result["milliseconds"] = {{"face", avatar.times.face},
                            {"targets", avatar.times.targets},
                            {"head", avatar.times.head},
                            {"texture", avatar.times.texture}};
  result["skin"] = {
      {"seen", avatar.painted.seen}, {"mirrored", avatar.painted.mirrored}, {"filled", avatar.painted.filled}};
  result["seconds"] = watch.seconds();
  PrintResult(result, arguments.head.as_json);
}

}  // namespace

Verb AvatarVerb() {
  return {"avatar", "A portrait to a textured head with eyes, teeth and 52 expressions (.glb)",
          [](CLI::App& command) {
            auto arguments = std::make_shared<AvatarArguments>();
            command
                .add_option("portrait", arguments->portrait,
                            "Picture of a face (PNG, JPEG): a cartoon, a caricature or a photograph; of several faces "
                            "that of highest confidence is taken")
                ->required()
                ->check(CLI::ExistingFile);
            command.add_option("overrides", arguments->config.overrides,
                               "key=value: face.landmarks=FILE, avatar.texture.size=2048 and others, see below");
            command
                .add_option("--weights", arguments->weights,
                            "Shipped weights of the task `portrait`, by name or folder")
                ->capture_default_str();
            command.add_option("--device", arguments->device, "cpu or cuda")->capture_default_str();
            AddHeadArguments(command, arguments->head);
            command.footer("Options:\n" + HelpText<portrait::AvatarConfig>());
            return [arguments] { MakeAvatar(*arguments); };
          },
          /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
