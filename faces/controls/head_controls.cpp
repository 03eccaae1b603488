#include "faces/controls/control_table.h"

namespace daumier::faces {
namespace {

using enum FaceControl::Sides;
using enum Motion::Kind;

const geometry::Vector3 kAbove{0, 1, 0}, kBelow{0, -1, 0}, kBehind{0, 0, -1};

/// All of the head above or below an anchor, fading in over a width.
SoftRegion HeadBeyond(Anchor from, const geometry::Vector3& direction, double width) {
  return {.ramps = {{{std::move(from)}, direction, width}}};
}

SoftRegion Near(std::vector<Anchor> path, geometry::Vector3 radii, std::vector<Ramp> ramps = {}) {
  return {std::move(path), radii, std::move(ramps)};
}

SoftRegion LeftEar() {
  return {.ramps = {{{{{27}, {0.3, 0, 0}}}, {1, 0, 0}, 0.3}}, .annotated = "ears"};
}

const Anchor kEarRoot{{16}, {0.03, -0.20, -0.12}};
const Anchor kChin{{8}};
const Anchor kBrowLine{{21, 22}};
const Anchor kNoseFoot{{33}};

}  // namespace

std::vector<FaceControl> CheekAndChinControls() {
  return {
      {"chin_cleft", "chin", kMiddle, Near({{{8, 8, 57}}, {{8, 57}}}, {0.045, 0.09, 0.20}), {kMove, {0, 0, -0.020}}},
      {"double_chin",
       "chin",
       kMiddle,
       Near({{{6}, {0.08, -0.10, -0.22}}, {{8}, {0, -0.10, -0.30}}, {{10}, {-0.08, -0.10, -0.22}}}, {0.22, 0.18, 0.28}),
       {kMove, {0, -0.060, 0.020}}},
      {"chin_point", "chin", kMiddle, Near({{{8}, {0, -0.04, 0}}}, {0.20, 0.16, 0.30}), {kMove, {0, -0.045, 0.010}}},
      {"chin_width",
       "chin",
       kMiddle,
       Near({{{6}}, {{7}}, {{8}}, {{9}}, {{10}}}, {0.18, 0.20, 0.35}),
       {kScale, {0.14, 0, 0}},
       kChin},
      {"chin_protrusion",
       "chin",
       kMiddle,
       Near({{{7}}, {{8}}, {{9}}, {{8, 57}}}, {0.26, 0.20, 0.40}),
       {kMove, {0, 0, 0.065}}},
      {"chin_length",
       "chin",
       kMiddle,
       Near({{{6}}, {{7}}, {{8}}, {{9}}, {{10}}}, {0.30, 0.28, 0.45}),
       {kMove, {0, -0.080, 0}}},
      {"chin_shift", "chin", kSideways, Near({{{6}}, {{8}}, {{10}}}, {0.30, 0.28, 0.45}), {kMove, {0.045, 0, 0}}},
      {"cheekbones",
       "cheeks",
       kPaired,
       Near({{{45, 46, 35}, {0.08, -0.08, 0}}, {{45, 14}, {0, -0.04, 0}}}, {0.17, 0.12, 0.30}),
       {kMove, {0.020, 0, 0.028}}},
      {"cheek_hollows",
       "cheeks",
       kPaired,
       Near({{{35, 54, 14}, {0.02, 0, 0}}, {{54, 13}, {0, 0.05, 0}}}, {0.17, 0.20, 0.30}),
       {kMove, {-0.010, 0, -0.040}}},
      {"cheek_fullness",
       "cheeks",
       kPaired,
       Near({{{13, 54}, {0, 0.08, 0.05}}, {{13, 54, 35}, {0.05, 0, 0}}}, {0.24, 0.24, 0.45}),
       {kMove, {0.050, -0.010, 0.030}}},
      {"temples",
       "head",
       kPaired,
       Near({{{26, 16}, {0.02, 0.16, 0}}, {{16}, {0, 0.40, 0.10}}}, {0.26, 0.24, 0.34}),
       {kMove, {0.045, 0, 0}}},
      {"temple_height",
       "head",
       kPaired,
       Near({{{16}, {0, 0.36, 0.05}}, {{16}, {-0.05, 0.40, -0.50}}}, {0.50, 0.34, 0.50}),
       {kMove, {0, 0.080, 0}}},
      {"jaw_angle",
       "jaw",
       kPaired,
       Near({{{13}, {0, 0, -0.08}}, {{12}}}, {0.22, 0.22, 0.40}),
       {kMove, {0.020, -0.070, 0}}},
      {"jaw_width", "jaw", kPaired, Near({{{14}}, {{13}}, {{12}}, {{11}}}, {0.26, 0.26, 0.50}), {kMove, {0.060, 0, 0}}},
  };
}

std::vector<FaceControl> HeadControls() {
  return {
      {"ear_angle", "ears", kPaired, LeftEar(), {kTurn, {0, -0.20, 0}}, kEarRoot},
      {"ear_size", "ears", kPaired, LeftEar(), {kScale, {0.11, 0.11, 0.11}}, kEarRoot},
      {"ear_level", "ears", kPaired, LeftEar(), {kMove, {0, 0.040, 0}}},
      {"forehead_bulge",
       "forehead",
       kMiddle,
       Near({{{21, 22, kHairlineAnchor}}}, {0.40, 0.28, 0.50}),
       {kMove, {0, 0.010, 0.050}}},
      {"forehead_width",
       "forehead",
       kMiddle,
       Near({{{19, 17, kHairlineAnchor}}, {{21, 22, kHairlineAnchor}}, {{24, 26, kHairlineAnchor}}},
            {0.45, 0.32, 0.70}),
       {kScale, {0.10, 0, 0.03}},
       {{0, 16}}},
      {"forehead_slope", "forehead", kMiddle, HeadBeyond(kBrowLine, kAbove, 1.0), {kMove, {0, 0, -0.110}}},
      {"forehead_height", "forehead", kMiddle, HeadBeyond(kBrowLine, kAbove, 0.6), {kMove, {0, 0.065, 0}}},
      {"skull_height", "head", kMiddle, HeadBeyond(kBrowLine, kAbove, 0.9), {kScale, {0, 0.110, 0}}, kBrowLine},
      {"skull_width", "head", kMiddle, HeadBeyond({{0, 16}}, kAbove, 1.0), {kScale, {0.10, 0, 0}}, {{0, 16}}},
      {"skull_depth", "head", kMiddle, HeadBeyond({{0, 16}, {0, 0, -0.1}}, kBehind, 1.1), {kMove, {0, 0, -0.120}}},
      {"neck_width",
       "neck",
       kMiddle,
       {.ramps = {{{kChin}, kBelow, 0.35}, {{{{8}, {0, 0, -0.15}}}, kBehind, 0.3}}},
       {kScale, {0.12, 0, 0.08}},
       {{4, 12}, {0, 0, -0.5}}},
      {"neck_forward",
       "neck",
       kMiddle,
       {.ramps = {{{kChin}, kBelow, 0.45}, {{{{8}, {0, 0, -0.25}}}, kBehind, 0.3}}},
       {kMove, {0, 0, 0.100}}},
      {"face_length", "proportions", kMiddle, HeadBeyond({{27}}, kBelow, 0.80), {kMove, {0, -0.090, 0}}},
      {"face_taper", "proportions", kMiddle, HeadBeyond({{28}}, kBelow, 1.0), {kScale, {-0.12, 0, -0.03}}, {{4, 12}}},
      {"profile_bend", "proportions", kMiddle, HeadBeyond({{29}}, kBelow, 1.1), {kTurn, {0.10, 0, 0}}, {{2, 14}}},
      {"face_bend", "proportions", kSideways, HeadBeyond({{28}}, kBelow, 1.0), {kTurn, {0, 0, 0.07}}, {{27}}},
      {"face_twist", "proportions", kSideways, HeadBeyond({{28}}, kBelow, 1.0), {kTurn, {0, 0.08, 0}}, {{0, 16}}},
      {"face_width", "proportions", kMiddle, {}, {kScale, {0.07, 0, 0}}, {{27}}},
      {"face_depth", "proportions", kMiddle, {}, {kScale, {0, 0, 0.08}}, {{0, 16}}},
  };
}

}  // namespace daumier::faces
