#include "faces/controls/control_table.h"

namespace daumier::faces {
namespace {

using enum FaceControl::Sides;
using enum Motion::Kind;

SoftRegion Around(std::vector<Anchor> path, geometry::Vector3 radii, std::vector<Ramp> ramps = {}) {
  return {std::move(path), radii, std::move(ramps)};
}

const geometry::Vector3 kUp{0, 1, 0}, kDown{0, -1, 0};

// Left side, +x.
const std::vector<Anchor> kEye = {{{42}}, {{43, 44}}, {{45}}, {{46, 47}}};
const Anchor kEyeCentre{{42, 43, 44, 45, 46, 47}};
const std::vector<Anchor> kBrow = {{{22}}, {{23}}, {{24}}, {{25}}, {{26}}};
const std::vector<Anchor> kNose = {{{28}}, {{29}}, {{30}}, {{31}}, {{33}}, {{35}}};
const std::vector<Anchor> kMouthLoop = {{{48}}, {{50}}, {{52}}, {{54}}, {{56}}, {{58}}, {{48}}};
const Anchor kMouthCentre{{48, 54}};
const Anchor kNoseBase{{31, 35}};
// The line between the lips, from right to left.
const std::vector<Anchor> kUpperSeam = {{{48}}, {{60}}, {{61}}, {{62}}, {{63}}, {{64}}, {{54}}};
const std::vector<Anchor> kLowerSeam = {{{48}}, {{60}}, {{67}}, {{66}}, {{65}}, {{64}}, {{54}}};

}  // namespace

std::vector<FaceControl> EyeControls() {
  return {
      {"eye_bags",
       "eyes",
       kPaired,
       Around({{{42, 47}, {0, -0.12, 0}}, {{46, 47}, {0, -0.15, 0}}, {{45, 46}, {0, -0.12, 0}}}, {0.09, 0.06, 0.15}),
       {kMove, {0, -0.01, 0.030}}},
      {"eye_height", "eyes", kPaired, Around(kEye, {0.14, 0.12, 0.25}), {kScale, {0, 0.17, 0.03}}, kEyeCentre},
      {"eye_slant", "eyes", kPaired, Around(kEye, {0.16, 0.14, 0.25}), {kTurn, {0, 0, 0.10}}, kEyeCentre},
      {"eye_size", "eyes", kPaired, Around(kEye, {0.20, 0.18, 0.30}), {kScale, {0.12, 0.12, 0.06}}, kEyeCentre},
      {"eye_depth", "eyes", kPaired, Around(kEye, {0.17, 0.15, 0.30}), {kMove, {0, 0, -0.035}}},
      {"eye_spacing", "eyes", kPaired, Around(kEye, {0.20, 0.20, 0.35}), {kMove, {0.040, 0, 0}}},
      {"eye_level", "eyes", kPaired, Around(kEye, {0.24, 0.22, 0.35}), {kMove, {0, 0.045, 0}}},
      {"brow_ridge",
       "brows",
       kPaired,
       Around({{{22}, {0, -0.02, 0}}, {{23}}, {{24}}, {{25}, {0, -0.02, 0}}}, {0.14, 0.11, 0.30}),
       {kMove, {0, -0.008, 0.040}}},
      {"brow_slant", "brows", kPaired, Around(kBrow, {0.16, 0.12, 0.25}), {kTurn, {0, 0, 0.12}}, {{23, 24}}},
      {"brow_height", "brows", kPaired, Around(kBrow, {0.18, 0.16, 0.30}), {kMove, {0, 0.038, 0}}},
  };
}

std::vector<FaceControl> NoseControls() {
  return {
      {"nose_hump", "nose", kMiddle, Around({{{28}}, {{28, 29}}}, {0.10, 0.09, 0.20}), {kMove, {0, 0, 0.030}}},
      {"nose_wings",
       "nose",
       kPaired,
       Around({{{35}, {0.01, 0.02, 0}}}, {0.09, 0.10, 0.14}),
       {kMove, {0.022, 0.006, 0.006}}},
      {"nose_tip",
       "nose",
       kMiddle,
       Around({{{30}}, {{30, 33}}}, {0.13, 0.13, 0.16}),
       {kScale, {0.13, 0.13, 0.10}},
       {{30, 33}, {0, 0, -0.06}}},
      {"nose_bridge",
       "nose",
       kMiddle,
       Around({{{27}, {0, 0.03, 0}}, {{27, 28}}, {{28}}}, {0.11, 0.12, 0.25}),
       {kMove, {0, 0, 0.032}}},
      {"nose_tip_angle",
       "nose",
       kMiddle,
       Around({{{30}}, {{31, 30}}, {{35, 30}}, {{33}}}, {0.15, 0.15, 0.18}),
       {kTurn, {-0.15, 0, 0}},
       {{29}, {0, 0, -0.10}}},
      {"nose_width", "nose", kMiddle, Around(kNose, {0.18, 0.13, 0.25}), {kScale, {0.14, 0, 0}}, kNoseBase},
      {"nose_length",
       "nose",
       kMiddle,
       Around({{{28}}, {{30}}, {{33}}, {{48}}, {{51}}, {{54}}}, {0.26, 0.20, 0.40},
              {{{{{27}, {0, -0.04, 0}}}, kDown, 0.55}}),
       {kMove, {0, -0.062, 0.008}}},
      {"nose_projection",
       "nose",
       kMiddle,
       Around({{{29}}, {{30}}, {{30, 33}}, {{31, 33}}, {{33, 35}}}, {0.17, 0.15, 0.25}),
       {kMove, {0, 0, 0.060}}},
      {"nose_bend", "nose", kSideways, Around({{{29}}, {{30}}, {{33}}}, {0.18, 0.17, 0.25}), {kMove, {0.040, 0, 0}}},
  };
}

std::vector<FaceControl> MouthControls() {
  return {
      {"philtrum", "mouth", kMiddle, Around({{{33, 51}}, {{33, 51, 51}}}, {0.06, 0.08, 0.20}), {kMove, {0, 0, -0.015}}},
      {"upper_lip",
       "mouth",
       kMiddle,
       Around({{{49}}, {{50}}, {{51}}, {{52}}, {{53}}}, {0.11, 0.09, 0.20}, {{kUpperSeam, kUp, 0.09}}),
       {kMove, {0, 0.014, 0.014}}},
      {"lower_lip",
       "mouth",
       kMiddle,
       Around({{{55}}, {{56}}, {{57}}, {{58}}, {{59}}}, {0.11, 0.09, 0.20}, {{kLowerSeam, kDown, 0.09}}),
       {kMove, {0, -0.014, 0.014}}},
      {"mouth_corners",
       "mouth",
       kPaired,
       Around({{{54}}, {{54, 54, 53, 55}}}, {0.13, 0.12, 0.25}),
       {kMove, {0.006, 0.032, 0}}},
      {"mouth_height",
       "mouth",
       kMiddle,
       Around(kMouthLoop, {0.20, 0.13, 0.30}),
       {kScale, {0, 0.13, 0.02}},
       kMouthCentre},
      {"mouth_width", "mouth", kMiddle, Around(kMouthLoop, {0.20, 0.16, 0.35}), {kScale, {0.14, 0, 0}}, kMouthCentre},
      {"mouth_protrusion", "mouth", kMiddle, Around(kMouthLoop, {0.17, 0.15, 0.35}), {kMove, {0, 0, 0.045}}},
      {"mouth_level", "mouth", kMiddle, Around(kMouthLoop, {0.24, 0.20, 0.35}), {kMove, {0, -0.045, 0}}},
  };
}

}  // namespace daumier::faces
