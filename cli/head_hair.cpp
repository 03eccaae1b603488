#include "cli/head_hair.h"

#include "core/error.h"
#include "core/log.h"
#include "faces/appearance/hair_mass.h"
#include "render/svg_color.h"

#include <utility>
#include <vector>

namespace daumier::cli {

void AddHairArguments(CLI::App& command, HairFrom from, HairArguments& arguments) {
  std::vector<std::string> words = {"none"};
  if (from == HairFrom::kNameOrPicture) words.emplace_back("auto");
  words.insert(words.end(), faces::kHairStyleNames.begin(), faces::kHairStyleNames.end());
  command
      .add_option("--hair", arguments.style,
                  from == HairFrom::kNameOrPicture
                      ? "Hair as a surface of its own, the node Hair: by the picture (auto), or by name"
                      : "Hair as a surface of its own, the node Hair")
      ->check(CLI::IsMember(words))
      ->capture_default_str();
  command.add_option("--hair-colour", arguments.colour,
                     "Its colour, as #40281a or a name of CSS; without it that of the picture, or brown");
}

void CheckHair(const HairArguments& arguments) {
  if (arguments.colour.empty()) return;
  if (!render::ParseSvgColor(arguments.colour))
    throw UsageError(fmt::format("--hair-colour {}: is no colour (expected #40281a, rgb(64, 40, 26) or a name of CSS)",
                                 arguments.colour));
  if (arguments.style == "none")
    throw UsageError(fmt::format(
        "--hair-colour {}: there is no hair to colour. Add --hair NAME (--hair short), or leave --hair-colour out",
        arguments.colour));
}

std::optional<faces::Looks> HairLooks(const HairArguments& arguments, const std::optional<faces::Looks>& shown) {
  CheckHair(arguments);
  if (arguments.style == "none") return std::nullopt;
  faces::Looks looks = shown.value_or(faces::Looks());
  if (arguments.style != "auto") looks.hair = faces::HairStyleNamed(arguments.style);
  if (arguments.colour.empty()) return looks;
  looks.hair_colour = render::ParseSvgColor(arguments.colour)->rgb.cast<float>();
  if (looks.hair == faces::HairStyle::kBald)
    log::Warn("--hair-colour {}: has no effect, the head is bald. Name hair with --hair (--hair short)",
              arguments.colour);
  return looks;
}

void AddHair(const faces::FaceTemplate& face_template, const geometry::Points& neutral, const faces::Looks& looks,
             rig::RiggedHead& head) {
  if (looks.hair == faces::HairStyle::kBald) return;
  faces::HairMass hair = faces::HairMaker(face_template).Make(neutral, looks);
  head.attachments.push_back({"Hair", std::move(hair.mesh), std::move(hair.colours)});
}

}  // namespace daumier::cli
