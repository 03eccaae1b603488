#pragma once
#include "faces/appearance/looks.h"
#include "faces/face_model.h"
#include "rig/rigged_head.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace daumier::cli {

/// --hair and --hair-colour.
struct HairArguments {
  std::string style = "none", colour;
};

/// Where hair may come from besides its name.
enum class HairFrom { kName, kNameOrPicture };

void AddHairArguments(CLI::App& command, HairFrom from, HairArguments& arguments);

/// @throws UsageError if the colour is none, or is given without hair.
void CheckHair(const HairArguments& arguments);

/// The looks of the arguments; nothing of "none". `shown`: as a picture shows hair, for "auto". Warns of a colour for a bald
/// head. @throws UsageError as CheckHair.
std::optional<faces::Looks> HairLooks(const HairArguments& arguments, const std::optional<faces::Looks>& shown = {});

/// Adds hair to a head as the attachment "Hair"; nothing where it is bald. neutral: of the template, cm, in the head's frame.
void AddHair(const faces::FaceTemplate& face_template, const geometry::Points& neutral, const faces::Looks& looks,
             rig::RiggedHead& head);

}  // namespace daumier::cli
