// Avatars of pictures as `daumier avatar` makes them, a sheet each: picture, aligned face, texture, and the painted head from
// the front, from both sides, with closed eyes and with an open mouth.
//   avatar_sheets WEIGHTS OUT PICTURE... [face.KEY=VALUE avatar.KEY=VALUE ...]      OUT/NAME.png; shares and milliseconds are printed
// WEIGHTS: weights/portrait, with the face model next to it.
#include "core/config.h"
#include "core/options.h"
#include "core/weights_folder.h"
#include "faces/face_model_file.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "reports/rigged_head.h"
#include "systems/portrait/avatar.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 360;

render::Image SheetOf(const portrait::Avatar& avatar) {
  std::vector<render::SheetCell> cells;
  for (const auto& picture : avatar.face.pictures)
    if (picture.caption == "input" || picture.caption == "parsing" || picture.caption == "overlay")
      cells.push_back({picture.image, picture.caption});
  cells.push_back({render::Resize(*avatar.texture, kSide, kSide), "texture"});
  const reports::RiggedHeadPictures pictures(avatar.head, avatar.texture);
  const auto add = [&](const char* caption, std::initializer_list<std::pair<std::string_view, float>> weights,
                       double yaw) {
    cells.push_back({pictures.Draw(rig::PoseNamed(avatar.head.targets.names, weights), kSide, yaw), caption});
  };
  add("front", {}, 0);
  add("30 degrees", {}, 30);
  add("-30 degrees", {}, -30);
  add("eyes closed", {{"eyeBlinkLeft", 1.0F}, {"eyeBlinkRight", 1.0F}}, 0);
  add("mouth open", {{"jawOpen", 0.7F}}, 0);
  add("behind", {}, 130);
  return render::MakeSheet(cells, 5);
}

void MakeSheets(const fs::path& weights, const fs::path& out, const std::vector<std::string>& rest) {
  std::vector<fs::path> pictures;
  std::vector<std::string> overrides;
  for (const std::string& argument : rest)
    argument.find('=') == std::string::npos ? pictures.emplace_back(argument)
                                            : fs::path(overrides.emplace_back(argument));
  const auto options = ParseOptions<portrait::AvatarConfig>(LoadConfig({}, overrides), "arguments");
  std::unique_ptr<const portrait::PortraitPredictor> predictor =
      portrait::OpenPortraits(weights, Device(), ToJson(options.face));
  const std::string source = predictor->run().model.face_template.source;
  const faces::FaceModel model = faces::ReadFaceModelWeights(WeightsNextTo(weights, "face-" + source), source);
  const portrait::AvatarMaker maker([&] { return std::move(predictor); }, model, options.avatar);
  fs::create_directories(out);
  for (const fs::path& picture : pictures) {
    try {
      const portrait::Avatar avatar = maker.Make(render::ReadImage(picture));
      render::WriteImage(out / (picture.stem().string() + ".png"), SheetOf(avatar));
      std::printf("%s seen %.2f mirrored %.2f face %.0f targets %.0f head %.0f texture %.0f\n", picture.stem().c_str(),
                  avatar.painted.seen, avatar.painted.mirrored, avatar.times.face, avatar.times.targets,
                  avatar.times.head, avatar.times.texture);
    } catch (const Error& error) {
      std::printf("%s: %s\n", picture.stem().c_str(), error.what());
    }
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace daumier

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 3) {
    std::fputs("usage: avatar_sheets WEIGHTS OUT PICTURE... [face.KEY=VALUE avatar.KEY=VALUE ...]\n", stderr);
    return 2;
  }
  try {
    daumier::MakeSheets(arguments[0], arguments[1], {arguments.begin() + 2, arguments.end()});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
