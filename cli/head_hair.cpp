#include "cli/head_hair.h"

#include "core/error.h"
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

std::optional<faces::Looks> HairLooks(const HairArguments& arguments, const std::optional<faces::Looks>& shown) {
  faces::Looks looks = shown.value_or(faces::Looks());
  if (!arguments.colour.empty()) {
    const auto colour = render::ParseSvgColor(arguments.colour);
    if (!colour)
      throw UsageError(fmt::format(
          "--hair-colour {}: is no colour (expected #40281a, rgb(64, 40, 26) or a name of CSS)", arguments.colour));
    looks.hair_colour = colour->rgb.cast<float>();
  }
  if (arguments.style == "none") return std::nullopt;
  if (arguments.style != "auto") looks.hair = faces::HairStyleNamed(arguments.style);
  return looks;
}

void AddHair(const faces::FaceTemplate& face_template, const geometry::Points& neutral, const faces::Looks& looks,
             rig::RiggedHead& head) {
  if (looks.hair == faces::HairStyle::kBald) return;
  faces::HairMass hair = faces::HairMaker(face_template).Make(neutral, looks);
  head.attachments.push_back({"Hair", std::move(hair.mesh), std::move(hair.colours)});
}

}  // namespace daumier::cli
